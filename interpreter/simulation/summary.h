#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/running/runner.h"
#include "interpreter/simulation/compensation.h"
#include "interpreter/simulation/frame_extents.h"
#include "interpreter/simulation/timing.h"

namespace isocnc::simulation {

/// What time is spent on. The first three as in execution::MoveKind.
enum class Work : std::uint8_t { Rapid, Feed, Arc, Dwell, ToolChange, Spindle, Function, Channel };
inline constexpr std::size_t kWorkCount = 8;

/// Seconds, by Work.
using Times = std::array<double, kWorkCount>;

/// What was done with one tool, from its M06s to the next ones.
struct ToolShare {
  std::optional<execution::ToolCode> tool;  ///< None: before the first M06.
  Times times{};                            ///< Its own M06 included.
  double feed_mm = 0;
  double rapid_mm = 0;
};

/// A joint that would leave its travel.
struct TravelBreach {
  std::uint64_t line = 0;  ///< Where it first does so, from 0.
  double farthest = 0;     ///< mm or degrees.
  double limit = 0;
};

/// What a program may ask more of than the machine can.
enum class Limit : std::uint8_t {
  Feed,          ///< mm/min. The machine goes as fast as it can.
  RotarySpeed,   ///< Of B or C in feed moves, degrees/min. The same.
  SpindleSpeed,  ///< rev/min.
};
inline constexpr std::size_t kLimitCount = 3;

struct Excess {
  std::uint64_t line = 0;  ///< Where it is first asked for, from 0.
  double maximum = 0;      ///< That is asked for anywhere.
};

/// What a run adds up to.
class Summary {
 public:
  explicit Summary(const TimedMachine& machine);

  void add(const TimedEvent& timed);
  /// `joints` are those at the end.
  void finish(const running::RunResult& result, double seconds, const motion::Coordinates& joints,
              const std::vector<RunWarning>& warnings);

  std::string text(dialect::Language language) const;
  /// One line; `error` is null or what stopped the program.
  std::string json(std::string_view file, dialect::Language language) const;

 private:
  static constexpr std::size_t kNoShare = static_cast<std::size_t>(-1);

  struct Travelled {
    std::size_t count = 0;
    double mm = 0;
  };

  ToolShare& share();
  void mount(std::optional<execution::ToolCode> tool);
  void spend(Work work, double seconds);
  void add_move(const running::MoveEvent& move, const motion::Move& real, std::uint64_t line);
  void look_at_travel(const motion::Move& real, std::uint64_t line);
  void look_at_speeds(const motion::Move& real, double length, std::uint64_t line);
  void ask_for(Limit limit, double value, std::uint64_t line);
  double limit_of(Limit limit) const;
  /// Where the tip is at the end, as the program has it.
  geometry::Pose final_pose() const;

  const TimedMachine& machine_;
  std::array<Travelled, 3> moves_;  ///< By MoveKind.
  std::optional<std::array<geometry::Range, execution::kAxisCount>> extents_;
  FrameLog frames_;
  Times times_{};
  std::vector<ToolShare> tools_;                                                 ///< In the order of their first use.
  std::size_t share_ = kNoShare;                                                 ///< Of the tool that is mounted.
  std::array<std::optional<TravelBreach>, 2 * execution::kAxisCount> breaches_;  ///< Below and above each axis.
  bool checks_travel_;
  std::array<std::optional<Excess>, kLimitCount> excesses_;
  running::RunResult result_;
  double seconds_ = 0;
  motion::Coordinates joints_ = motion::Coordinates::Zero();
  std::vector<RunWarning> warnings_;
  std::optional<geometry::Pose> reached_;  ///< By the last motion; compensation may end beside the contour.
};

}  // namespace isocnc::simulation
