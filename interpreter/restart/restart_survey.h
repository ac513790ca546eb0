#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "interpreter/running/runner.h"
#include "interpreter/simulation/machine_course.h"

namespace isocnc::restart {

/// What stands in the way of a restart before a line.
enum class Obstacle : std::uint8_t {
  None,
  NoSuchLine,       ///< The program is shorter.
  ProgramError,     ///< The program does not run to its M02.
  AfterProgramEnd,  ///< M02 comes first.
  JumpedOver,       ///< A taken IF passes over the line.
  Compensation,     ///< G41 or G42 is in force.
  OnContour,        ///< G40 has left the tool beside the contour, and from there the rest would run differently.
  RadiusUnknown,    ///< The same, and how far beside is not known.
  OffProgram,       ///< A tool change has left the tip off the program, and from there the rest would run differently.
  FrameChangedLow,  ///< The frame has changed with the tool in the cut, and no rapid has followed.
  FaceLooksDown,    ///< The face's Z points down: there is no way to it from above.
  ToolPointsUp,     ///< B has turned the tool beyond the horizontal.
  ExactStop,        ///< A G09 comes next, which belongs to the feed move above (I.3.8, D23).
  ArcContinues,     ///< Coordinates without a G go on with a G02 or G03, which nothing but an arc brings into force.
  BeyondTravel,     ///< On the way there a joint would leave its travel.
  NotProved,        ///< The trial run of the restart program has not come to the same state.
};

/// Heights and frames on the path of the tip, as the machine makes it: beside the contour under compensation, and off
/// the program after a tool change.
class TipLog {
 public:
  explicit TipLog(const execution::State& start);

  void add(const running::Event& event, const motion::Move& move);
  void add(const running::FrameEvent& frame, const geometry::Vec3& tip);

  /// From the machine frame to the frame in force.
  geometry::Vec3 to_frame(const geometry::Vec3& place) const;
  double highest() const { return highest_; }                    ///< As in RestartPoint.
  double highest_in_frame() const { return highest_in_frame_; }  ///< As in RestartPoint.
  const Eigen::AlignedBox3d& fed() const { return fed_; }        ///< As in RestartPoint.
  bool came_in_feed() const { return came_in_feed_; }            ///< As in RestartPoint.
  bool turns() const { return turns_; }                          ///< B or C have moved.
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

/// The machine before a line, and what the way there tells of how to come back.
struct RestartPoint {
  execution::State state;
  geometry::Pose machine_tip;                   ///< Where the tip stands, machine frame.
  geometry::Vec3 tip = geometry::Vec3::Zero();  ///< The same in the frame in force, mm.
  bool is_beside_contour = false;               ///< Compensation has led the tool off the program, and not yet back.
  bool is_off_program = false;                  ///< For this reason or by a tool change the tip is elsewhere.
  running::Registers registers{};
  std::uint32_t known_registers = 0;  ///< Bit n: Vn was assigned by the program, or set at the start.
  std::string face_line;              ///< The G24, G28 or G29 in force as written.
  double highest = 0;                 ///< The highest that the tip has been, home included: Z of the machine frame, mm.
  double highest_in_frame = 0;        ///< Since the frame in force is so: its Z, mm.
  Eigen::AlignedBox3d fed;            ///< Where feed moves have begun and ended since then, in that frame.
  bool came_in_feed = false;      ///< The last motion that led anywhere was a feed move: the tool may be in the cut.
  bool waits_at_end = false;      ///< G200 (I.3.12).
  bool turns = false;             ///< B or C move somewhere in the program.
  bool continues_motion = false;  ///< Coordinates may come before any motion G.
  std::vector<running::Event> functions;  ///< The user's M functions on the way; of each number the last.
  std::vector<int> assumed;  ///< Registers, or 0 for VGPL, that an IF has asked for and nobody has assigned.
};

/// One run over a whole program: where it could be taken up again, and what that takes.
class RestartSurvey {
 public:
  /// `line` (from 0) is the one whose point is kept.
  RestartSurvey(std::string_view text, const running::RunOptions& options, const simulation::TimedMachine& machine,
                std::uint64_t line);
  RestartSurvey(const RestartSurvey&) = delete;
  RestartSurvey& operator=(const RestartSurvey&) = delete;

  const running::RunResult& run() const { return run_; }
  Obstacle obstacle(std::uint64_t line) const;
  /// The line of the IF, or of the M02, by which a line is not run.
  std::uint64_t line_of_cause(std::uint64_t line) const;
  /// Whether it is a line to propose: without an obstacle, and with something to do.
  bool is_safe(std::uint64_t line) const;
  /// Whether the machine is not where the program has it: whether the rest is the same from there shows when it is run.
  bool is_off_program(std::uint64_t line) const { return has(line, kOffProgram); }
  /// Whether an IF on the way could send the run elsewhere.
  bool has_choices() const;
  /// Lines that the run has come to lie before this one.
  std::uint64_t end() const { return traits_.size(); }
  /// Where obstacle() is None, or something that only concerns the way.
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
  };

  void look_at(const running::Block& block);
  void take(const running::Event& event);
  void follow(const running::Event& event);
  void find_tip();
  void note(const running::Block& block);
  std::uint16_t traits_of(const running::Block& block) const;
  bool has(std::uint64_t line, std::uint16_t trait) const;
  bool exact_stop_follows(std::uint64_t line) const;
  bool continues_motion(std::uint64_t line) const;

  const std::uint64_t line_;
  const std::map<execution::ToolCode, double> known_radii_;
  simulation::TimedMachine machine_;
  simulation::MachineCourse course_;
  TipLog log_;
  const simulation::MachineCourse::Listeners to_log_;
  running::RunResult run_;
  RestartPoint now_;  // Of the line that the run has come to.
  RestartPoint point_;
  std::vector<std::uint16_t> traits_;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> jumps_;  // Taken: from an IF to a label.
  bool is_tip_found_ = false;                                   // now_ knows where the tip is.
  geometry::Vec3 tip_ = geometry::Vec3::Zero();                 // In the frame in force.
  bool has_unknown_radius_ = false;                             // The tool that is mounted.
  bool is_beside_by_unknown_ = false;                           // Such a tool has been led beside a contour.
  bool changed_low_ = false;                                    // Before the line that the run has come to.
};

}  // namespace isocnc::restart
