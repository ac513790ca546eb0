#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/running/runner.h"
#include "interpreter/running/timing.h"

namespace isocnc::running {

/// What was done with one tool, from its M06s to the next ones.
struct ToolShare {
  std::optional<execution::ToolCode> tool;  ///< None: before the first M06.
  double seconds = 0;                       ///< Its own M06 included.
  double feed_mm = 0;
  double rapid_mm = 0;
};

/// A joint that would leave its travel.
struct TravelBreach {
  std::uint64_t line = 0;  ///< Where it first does so, from 0.
  double farthest = 0;     ///< mm or degrees.
  double limit = 0;
};

/// What a run adds up to.
class Summary {
 public:
  explicit Summary(const TimedMachine& machine);

  void add(const TimedEvent& timed);
  /// Looks whether the joints stay within their travel.
  void add(const motion::Move& move, std::uint64_t line);
  void finish(const RunResult& result, double seconds);

  std::string text(dialect::Language language) const;
  /// One line; `error` is null or what stopped the program.
  std::string json(std::string_view file, dialect::Language language) const;

 private:
  static constexpr std::size_t kNoShare = static_cast<std::size_t>(-1);

  struct Travelled {
    std::size_t count = 0;
    double mm = 0;
    double seconds = 0;
  };

  ToolShare& share();
  void mount(std::optional<execution::ToolCode> tool);
  void add_move(const MoveEvent& move, double seconds);

  const TimedMachine& machine_;
  std::array<Travelled, 3> moves_;  ///< By MoveKind.
  std::optional<std::array<geometry::Range, execution::kAxisCount>> extents_;
  std::vector<ToolShare> tools_;                                                 ///< In the order of their first use.
  std::size_t share_ = kNoShare;                                                 ///< Of the tool that is mounted.
  std::array<std::optional<TravelBreach>, 2 * execution::kAxisCount> breaches_;  ///< Below and above each axis.
  bool checks_travel_;
  RunResult result_;
  double seconds_ = 0;
};

}  // namespace isocnc::running
