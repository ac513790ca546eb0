#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "interpreter/running/runner.h"

namespace isocnc::running {

/// What stands in the way of a restart before a line.
enum class Obstacle : std::uint8_t {
  None,
  NoSuchLine,       ///< The program is shorter.
  ProgramError,     ///< The program does not run to its M02.
  BehindEnd,        ///< M02 comes first.
  JumpedOver,       ///< A taken IF passes over the line.
  Compensation,     ///< G41 or G42 is in force.
  OnContour,        ///< G40 has been written, and the tool is still where the compensation has led it.
  FrameChangedLow,  ///< The frame has changed with the tool in the cut, and no rapid has followed.
  FaceLooksDown,    ///< The face's Z points down: there is no way to it from above.
  ToolPointsUp,     ///< B has turned the tool beyond the horizontal.
  ExactStop,        ///< A G09 comes next, which belongs to the feed move above (I.3.8, D23).
  ArcContinues,     ///< Coordinates without a G go on with a G02 or G03, which nothing but an arc brings into force.
  BeyondTravel,     ///< On the way there a joint would leave its travel.
  NotProved,        ///< The trial run of the restart program has not come to the same state.
};

/// The machine before a line, and what the way there tells of how to come back.
struct RestartPoint {
  execution::State state;
  Registers registers{};
  std::uint32_t known_registers = 0;  ///< Bit n: Vn was assigned by the program, or set at the start.
  std::string face_line;              ///< The G24, G28 or G29 in force as written.
  double highest = 0;                 ///< The highest that the tip has been, home included: Z of the machine frame, mm.
  double highest_in_frame = 0;        ///< Since the frame in force is so: its Z, mm.
  Eigen::AlignedBox3d fed;            ///< Where feed moves have begun and ended since then, in that frame.
  bool waits_at_end = false;          ///< G200 (I.3.12).
  bool turns = false;                 ///< B or C move somewhere in the program.
  bool continues_motion = false;      ///< Coordinates may come before any motion G.
  std::vector<Event> functions;       ///< The user's M functions on the way; of each number the last.
  std::vector<int> assumed;           ///< Registers, or 0 for VGPL, that an IF has asked for and nobody has assigned.
};

/// One run over a whole program: where it could be taken up again, and what that takes.
class RestartSurvey {
 public:
  /// `line` (from 0) is the one whose point is kept.
  RestartSurvey(std::string_view text, const RunOptions& options, std::uint64_t line);

  const RunResult& run() const { return run_; }
  Obstacle obstacle(std::uint64_t line) const;
  /// The line of the IF, or of the M02, by which a line is not run.
  std::uint64_t line_of_cause(std::uint64_t line) const;
  /// Whether it is a line to propose: without an obstacle, and with something to do.
  bool is_safe(std::uint64_t line) const;
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
    kOnContour = 4,
    kChangedLow = 8,
    kLooksDown = 16,
    kInArc = 32,
    kStopsExactly = 64,
    kIdle = 128,
    kContinues = 256,
    kNamesMotion = 512,
    kJumps = 1024,
    kPointsUp = 2048,
  };

  void look_at(const Block& block);
  void follow(const execution::State& before, const execution::State& after);
  void note(const Block& block);
  std::uint16_t traits_of(const Block& block) const;
  bool has(std::uint64_t line, std::uint16_t trait) const;
  bool exact_stop_follows(std::uint64_t line) const;
  bool continues_motion(std::uint64_t line) const;

  const std::uint64_t line_;
  RunResult run_;
  RestartPoint now_;  // Of the line that the run has come to.
  RestartPoint point_;
  std::vector<std::uint16_t> traits_;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> jumps_;  // Taken: from an IF to a label.
  bool compensated_ = false;                                    // The tool may be off the programmed contour.
  bool changed_low_ = false;
};

}  // namespace isocnc::running
