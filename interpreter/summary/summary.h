#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/kinematics/made_move.h"
#include "interpreter/running/runner.h"
#include "interpreter/simulation/compensation.h"
#include "interpreter/simulation/programmed_speeds.h"
#include "interpreter/summary/frame_extents.h"
#include "interpreter/timing/timing.h"

namespace isocnc::summary {

/// Kinds of activity that take time. The first three have the order of execution::MoveKind.
enum class Work : std::uint8_t { Rapid, Feed, Arc, Dwell, ToolChange, Spindle, Function, Channel };
inline constexpr std::size_t kWorkCount = 8;

/// Seconds, by Work.
using Times = std::array<double, kWorkCount>;

/// The work done with one tool, over all its uses.
struct ToolShare {
  std::optional<execution::ToolCode> tool;  ///< None: before the first M06.
  Times times{};                            ///< Includes the M06 of this tool.
  double feed_mm = 0;
  double rapid_mm = 0;
};

/// `1 h 02 min 03.4 s`, `2 min 03.4 s`, `3.4 s`: the same in both languages.
std::string shown_time(double seconds);

/// A joint that would leave its travel.
struct TravelBreach {
  std::size_t line = 0;  ///< Line of the first breach, from 0.
  double farthest = 0;   ///< mm or degrees.
  double limit = 0;
};

struct Excess {
  std::size_t line = 0;  ///< First line that exceeds the limit, from 0.
  double maximum = 0;    ///< Maximum value in the program.
};

/// Totals of a run.
class Summary {
 public:
  explicit Summary(const timing::TimedMachine& machine);

  void add(const timing::TimedEvent& timed);
  /// The same, where others ask the motion as well. `made` is that of the event; null if it has none.
  void add(const timing::TimedEvent& timed, kinematics::MadeMove* made);
  /// `joints` are the positions at the end.
  void finish(const running::RunResult& result, double seconds, const kinematics::Coordinates& joints,
              const std::vector<simulation::RunWarning>& warnings);

  std::string text(dialect::Language language) const;
  /// One line of JSON; its `error` is null or the error that stopped the program.
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
  void add_move(const running::MoveEvent& move, kinematics::MadeMove& made, std::size_t line);
  void look_at_travel(kinematics::MadeMove& made, std::size_t line);
  void look_at_speeds(kinematics::MadeMove& made, std::size_t line);
  void ask_for(simulation::Limit limit, double value, std::size_t line);
  /// Programmed tip position at the end.
  geometry::Pose final_pose() const;

  const timing::TimedMachine& machine_;
  std::array<Travelled, 3> moves_;  ///< By MoveKind.
  std::optional<std::array<geometry::Range, execution::kAxisCount>> extents_;
  FrameLog frames_;
  Times times_{};
  std::vector<ToolShare> tools_;  ///< In the order of their first use.
  std::size_t share_ = kNoShare;  ///< Index of the mounted tool in tools_.
  std::array<std::optional<TravelBreach>, 2 * execution::kAxisCount>
      breaches_;  ///< Two per axis: below its minimum and above its maximum.
  bool checks_travel_;
  std::array<std::optional<Excess>, simulation::kLimitCount> excesses_;
  running::RunResult result_;
  bool has_inches_ = false;  ///< Some block is under G70.
  double seconds_ = 0;
  kinematics::Coordinates joints_ = kinematics::Coordinates::Zero();
  std::vector<simulation::RunWarning> warnings_;
  std::optional<geometry::Pose>
      reached_;  ///< End of the last motion; under compensation it may differ from the programmed end.
};

}  // namespace isocnc::summary
