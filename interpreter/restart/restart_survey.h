#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "interpreter/running/runner.h"
#include "interpreter/simulation/machine_course.h"
#include "interpreter/timing/timing.h"

namespace isocnc::restart {

/// The obstacle to a restart before a line.
enum class RestartObstacle : std::uint8_t {
  None,
  NoSuchLine,       ///< The program is shorter.
  ProgramError,     ///< The program does not run to its M02.
  AfterProgramEnd,  ///< M02 comes first.
  JumpedOver,       ///< A taken IF passes over the line.
  Compensation,     ///< G41 or G42 is in force.
  OnContour,        ///< The tool is still offset after G40, and the rest would run differently from there.
  RadiusUnknown,    ///< After G40 the tool is still offset from the contour, by an unknown radius.
  TipUnknown,       ///< A tool without a length has left the machine nobody knows where.
  OffProgram,       ///< A tool change has left the tip off the program, and the rest would run differently from there.
  FrameChangedLow,  ///< The frame has changed with the tool in the cut, and no rapid has followed.
  FaceLooksDown,    ///< The face's Z points down, so it cannot be approached from above.
  ToolPointsUp,     ///< B has turned the tool beyond the horizontal.
  ExactStop,        ///< The next block is a G09, which belongs to the feed move above (I.3.8, D23).
  ArcContinues,     ///< Coordinates without a G continue a G02 or G03, which only an arc brings into force.
  BeyondTravel,     ///< During the approach a joint would leave its travel.
  NotProved,        ///< The trial run of the restart program has not reached the same state.
};

/// Heights and frames on the path of the tip, as the machine makes it: offset from the contour under compensation, and
/// off the program after a tool change.
class TipLog {
 public:
  explicit TipLog(const execution::State& start);

  void add(const running::Event& event, const kinematics::Move& move);
  void add(const running::FrameEvent& frame, const geometry::Vec3& tip);

  /// Converts from the machine frame to the frame in force.
  geometry::Vec3 to_frame(const geometry::Vec3& place) const;
  /// These four have the meaning of the RestartPoint members of the same name.
  double highest() const { return highest_; }
  double highest_in_frame() const { return highest_in_frame_; }
  const Eigen::AlignedBox3d& fed() const { return fed_; }
  bool came_in_feed() const { return came_in_feed_; }
  bool turns() const { return turns_; }  ///< Whether B or C has moved.
  /// The frame has changed with the tool in the cut, and no rapid has followed.
  bool has_changed_low() const { return changed_low_; }

 private:
  running::FrameEvent frame_;
  double highest_ = 0;
  double highest_in_frame_ = 0;
  Eigen::AlignedBox3d fed_;
  bool came_in_feed_ = false;
  bool turns_ = false;
  bool changed_low_ = false;
};

/// The state before a line, and the facts about the path up to it that a restart needs.
struct RestartPoint {
  execution::State state;
  geometry::Pose machine_tip;                   ///< Position of the tip, machine frame.
  geometry::Vec3 tip = geometry::Vec3::Zero();  ///< Position of the tip in the frame in force, mm.
  bool is_beside_contour = false;               ///< Compensation keeps the tool off the program.
  bool is_off_program = false;                  ///< The tip is off the program, by compensation or by a tool change.
  running::Registers registers{};
  std::uint32_t known_registers = 0;  ///< Bit n: Vn was assigned by the program or set at the start.
  std::string face_line;              ///< The G24, G28 or G29 in force as written.
  double highest = 0;                 ///< Maximum height of the tip, home included: Z of the machine frame, mm.
  double highest_in_frame = 0;        ///< Maximum Z of the tip since the last change of frame, in that frame, mm.
  Eigen::AlignedBox3d fed;            ///< Box around the starts and ends of feed moves since then, in that frame.
  bool came_in_feed = false;          ///< The last motion with a length was a feed move: the tool may be in the cut.
  bool waits_at_end = false;          ///< G200 is in force (I.3.12).
  double turning_speed = 0;           ///< Of the spindle while it turns: an S waits for the next M03 or M04 (I.4.2).
  bool turns = false;                 ///< B or C move somewhere in the program.
  bool continues_motion = false;      ///< Coordinates may follow before any motion G.
  std::vector<running::Event> functions;  ///< User M functions up to the line; the last one of each number.
  std::vector<int> assumed;               ///< Registers, or 0 for VGPL, that an IF has read without an assignment.
};

/// One run of a whole program, which finds the lines where it can be restarted and the facts that a restart needs.
class RestartSurvey {
 public:
  /// `line` (from 0) is the line of point().
  RestartSurvey(std::string_view text, const running::RunOptions& options, const timing::TimedMachine& machine,
                std::size_t line);
  RestartSurvey(const RestartSurvey&) = delete;
  RestartSurvey& operator=(const RestartSurvey&) = delete;

  const running::RunResult& run() const { return run_; }
  RestartObstacle obstacle(std::size_t line) const;
  /// The line of the IF or M02 by which a line is not run.
  std::size_t line_of_cause(std::size_t line) const;
  /// Whether the line can be proposed: it has no obstacle and a block with an effect.
  bool is_safe(std::size_t line) const;
  /// Whether the machine is off the program before the line. Only a trial shows whether the rest runs alike from there.
  bool is_off_program(std::size_t line) const { return has(line, kOffProgram); }
  /// Whether the run has an IF that could jump differently.
  bool has_choices() const;
  /// One past the last line the run has reached.
  std::size_t end() const { return traits_.size(); }
  /// The state before `line`. Complete if obstacle() is None or concerns the approach only.
  const RestartPoint& point() const { return point_; }

 private:
  enum Trait : std::uint16_t {
    kReached = 1,
    kCompensated = 2,
    kOffProgram = 4,
    kChangedLow = 8,
    kLooksDown = 16,
    kInArc = 32,
    kStopsExactly = 64,
    kIdle = 128,
    kContinues = 256,
    kNamesMotion = 512,
    kJumps = 1024,
    kPointsUp = 2048,
    kUnknownRadius = 4096,
    kUnknownTip = 8192,
  };

  void look_at(const running::Block& block);
  void take(const running::Event& event);
  void follow(const running::Event& event);
  void find_tip();
  void note(const running::Block& block);
  std::uint16_t traits_of(const running::Block& block) const;
  bool has(std::size_t line, std::uint16_t trait) const;
  bool exact_stop_follows(std::size_t line) const;
  bool continues_motion(std::size_t line) const;

  const std::size_t line_;
  const std::map<execution::ToolCode, double> known_radii_;
  timing::TimedMachine machine_;
  simulation::MachineCourse course_;
  TipLog log_;
  const simulation::MachineCourse::Listeners to_log_;
  running::RunResult run_;
  RestartPoint now_;  // Facts before the line that the run has reached.
  timing::SpindleMotion spindle_;
  double last_speed_ = 0;  // The last S.
  RestartPoint point_;
  std::vector<std::uint16_t> traits_;
  std::vector<std::pair<std::size_t, std::size_t>> jumps_;  // Taken jumps, from an IF to a label.
  bool is_tip_known_ = true;                                // Not after a tool without a length (machine.tools).
  bool is_tip_found_ = false;                               // The tip in now_ is up to date.
  geometry::Vec3 tip_ = geometry::Vec3::Zero();             // The tip in the frame in force.
  bool has_unknown_radius_ = false;                         // The radius of the mounted tool is unknown.
  bool is_beside_by_unknown_ = false;                       // Such a tool is offset from a contour.
  bool changed_low_ = false;  // The frame has changed low before the line that the run has reached.
};

}  // namespace isocnc::restart
