#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "interpreter/plot/packed_bytes.h"
#include "interpreter/plot/picture.h"

namespace isocnc::plot {

/// The way of the tool tip in few bytes, each step and point by how much it differs from the one before: what
/// toolpath-view/src/toolpath.ts reads, in the page of isorun --plot and in an editor.
class PathRecording {
 public:
  /// Both must outlive it. Of the subject its program and page are not asked for.
  PathRecording(const PlotSubject& subject, const simulation::TimedMachine& machine);

  void add(const ToolpathStep& step);

  std::string_view steps() const { return steps_.bytes(); }
  std::string_view points() const { return points_.bytes(); }
  std::string_view turns() const { return turns_.bytes(); }  ///< Of B and C, where they turn.
  /// What is neither path nor program text, as JSON.
  std::string facts(const Toolpath& path, const running::RunResult& result) const;

 private:
  /// Whole units of what is written: µm, 0.0001 degrees, 0.001 mm/s, 0.001 mm/min.
  struct Place {
    std::array<std::int64_t, 3> tip{};
    std::int64_t b = 0;
    std::int64_t c = 0;
    std::int64_t speed = 0;
  };

  static Place place(const ToolpathPoint& point);
  void add(const Place& place, double time);

  const PlotSubject& subject_;
  const simulation::TimedMachine& machine_;
  PackedBytes steps_;
  PackedBytes points_;
  PackedBytes turns_;
  Place home_;
  Place last_;
  /// Times are told in units of 10 ns since the one before, not since the start: so a second more at the begin changes
  /// one number.
  double last_time_ = 0;
  std::uint64_t last_line_ = 0;
  std::uint64_t last_tool_ = 0;
  std::int64_t last_feed_ = 0;
  std::uint64_t points_since_turn_ = 0;
};

}  // namespace isocnc::plot
