#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "interpreter/plot/packed_bytes.h"
#include "interpreter/removal/material_check.h"
#include "interpreter/stock/stock.h"

namespace isocnc::plot {

/// How a stock is cut over time, as a sample of its dexels in a compact form. toolpath-view/src/stock_reader.ts reads
/// it.
///
/// Unsigned numbers of PackedBytes, and signed ones; heights in µm, in
/// the machine frame. First the blank, then the target if there is one,
/// as pictures: runs of dexels, row by row, each with its length and one material. A material is the number of its
/// intervals, then of each, from the highest down, the difference of its top to the top written before in this picture
/// (at first 0; signed) and its length. Then moments, by time: the time since the one before (10 ns), and the number of
/// groups; of each group the line's difference to that of the group before (signed; lines from 0), the number of its
/// runs, and of each run the dexels left out since the run before, its length, 0, and the material of each of its
/// dexels; or 1, and one material for all.
class StockRecording {
 public:
  /// The picture shows at most `max_dexels`.
  StockRecording(const removal::Workpiece& workpiece, const stock::Stock& blank, std::size_t max_dexels);

  /// Notes what has changed since the moment before.
  void take(const stock::Stock& now, double time);
  /// Seconds until the next moment is of interest: more in a longer run, so that there are never too many moments.
  double interval() const { return interval_; }

  std::string_view bytes();

  /// The grid of the picture, frame of the stock.
  const stock::DexelGrid& grid() const { return grid_; }
  bool has_target() const { return has_target_; }

 private:
  /// The material that a dexel has from a moment on.
  struct DexelChange {
    std::uint32_t dexel = 0;
    std::uint32_t line = 0;
    std::uint32_t first = 0;  ///< Of its heights; two for each interval, from the highest down.
    std::uint32_t count = 0;  ///< Intervals.
  };
  struct StockMoment {
    double time = 0;
    std::vector<DexelChange> changes;  ///< By dexel.
  };

  void thin();
  DexelChange change_of(std::uint32_t dexel, std::uint32_t line, const std::vector<stock::HeightInterval>& material);
  void put_picture(const std::vector<std::vector<stock::HeightInterval>>& dexels);
  void put(const StockMoment& moment, double before);
  bool is_same(const DexelChange& a, const DexelChange& b) const;
  void put_material(const DexelChange& change);
  void put_material(const std::vector<stock::HeightInterval>& material);
  void put_interval(std::int64_t top, std::int64_t length);

  stock::Stock shown_;
  stock::DexelGrid grid_;
  int step_ = 1;   ///< Every so many dexels, one is shown.
  int first_ = 0;  ///< The first that is.
  bool has_target_;
  double interval_ = 0.05;
  std::vector<StockMoment> moments_;
  std::vector<std::int64_t> heights_;  ///< µm
  std::int64_t shift_ = 0;             ///< Of the stock's frame in the machine's, upwards; µm.
  std::int64_t last_top_ = 0;
  bool is_packed_ = false;
  PackedBytes bytes_;
};

/// Records how a check cuts its stock, from now on. The recording stays where it is while the check runs.
void record(removal::MaterialCheck& material, std::optional<StockRecording>& recording);

}  // namespace isocnc::plot
