#pragma once

#include <optional>
#include <span>

#include "interpreter/execution/state.h"
#include "interpreter/geometry/arc.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::execution {

enum class MoveKind : std::uint8_t { Rapid, Feed, Arc };

/// One motion of the tool tip, in the frame in force when it runs.
struct ProgrammedMove {
  MoveKind kind = MoveKind::Rapid;
  geometry::Pose from;  ///< Frame in force; mm, degrees.
  geometry::Pose to;
  geometry::Vec3 center = geometry::Vec3::Zero();  ///< Arcs: frame in force; along the normal, the start's coordinate.
  geometry::Vec3 normal =
      geometry::Vec3::Zero();  ///< Arcs: unit, frame in force; in oblique frames along the axes' cross product.
  double radius = 0;           ///< Arcs: distance of the center from the start, mm.
  double sweep_deg = 0;        ///< Arcs: positive counterclockwise about the normal (G03).
  int normal_axis = 2;         ///< Arcs: the coordinate that rises along a helix: 2 in G17, 1 in G18, 0 in G19.
  AxisSet placed = 0;          ///< Axes whose end is given; the others are omitted, or relative to the start (G91).
  double feed = 0;             ///< mm/min (degrees/min when only rotary axes move), or 1/min in G93; 0 for rapids.
  bool inverse_time = false;
};

class Arguments;
struct Plane;

/// An arc whose circle is given by its center, as the control reads it.
struct CenteredArc {
  const Plane& plane;
  const geometry::ArcGiven& given;
  geometry::PlanePoint start;   ///< In the frame in force, mm.
  bool start_is_known = false;  ///< Always under G90.
  bool incremental = false;     ///< G91 is in force.
  double mm_per_unit = 1;       ///< Length of a program unit, mm.
  const geometry::Circle& circle;
  const Arguments& arguments;

  syntax::Span centers() const;  ///< Of I, J and K. Looked for when it is asked for: few arcs show it.
};

/// A parameter of a user M (I.4.4).
struct FunctionParameter {
  int number = 0;
  double value = 0;
};

/// A step of a block, for callers that remember more of earlier blocks than State does.
enum class BlockStep : std::uint8_t {
  LostLetter,           ///< A number whose letter is lost: it may have been any word (D58).
  SpindleSpeed,         ///< An S.
  SpindleStart,         ///< M03 or M04.
  SpindleStop,          ///< M05 while the spindle turns.
  RepeatedStop,         ///< M05 while the spindle stands, or may stand.
  UserFunction,         ///< An M of the user.
  IllegibleFunction,    ///< An M whose number cannot be read: it may have been any M.
  ToolMounted,          ///< A tool change to a tool.
  ToolLost,             ///< A tool change to no tool, or to one that cannot be read.
  FeedMove,             ///< G01, G02 or G03 under G94; its F comes after it.
  Feed,                 ///< An F under G94 that takes effect.
  InverseTimeFeedMove,  ///< G01, G02 or G03 under G93; its F comes after it.
  InverseTimeFeed,      ///< An F under G93 that takes effect.
  FeedMode,             ///< G93 or G94, which may be in force already.
  InterpolationMode,    ///< G48 or G49, which may be in force already.
  IllegibleMotion,      ///< Coordinates after a motion G that cannot be read (D57).
  CompensationOn,       ///< G41 or G42 while neither is in force.
  CompensationOff,      ///< G40.
  CompensatedMotion,    ///< A motion in the plane under G41 or G42; at the end of its block.
};
inline constexpr std::size_t kBlockStepCount = static_cast<std::size_t>(BlockStep::CompensatedMotion) + 1;

/// Receives the effects and the findings of a block, in the order in which they occur. A checker uses the findings
/// only; a simulator moves a machine.
class Sink {
 public:
  /// With `wants_effects` false, motions are not computed, and move() and function() are not called.
  explicit Sink(bool wants_effects) : wants_effects_(wants_effects) {}
  virtual ~Sink() = default;

  bool wants_effects() const { return wants_effects_; }
  virtual void report(const syntax::Finding& finding) = 0;

  /// A step of the block; `before` is the state before it.
  virtual void step(BlockStep, const State& /*before*/) {}
  /// `state` is the one in which the motion runs: its frame, modes and spindle.
  virtual void move(const ProgrammedMove&, const State&) {}
  /// An arc whose circle is given by its center, correct or not. Not called for the plain arcs of a PlainRun.
  virtual void centered_arc(const CenteredArc&) {}
  virtual void dwell(double) {}  ///< Seconds.
  virtual void spindle_speed(double) {}
  virtual void function(int, std::span<const FunctionParameter>) {}
  virtual void tool_change(ToolCode) {}
  virtual void frame_changed(const State&) {}
  virtual void exact_stop() {}
  virtual void signal(const dialect::GCode&) {}  ///< A G whose effect has no data.
  virtual void assign(int, double) {}            ///< Register 1 to 30; NaN: the value could not be read.
  virtual void end() {}

 private:
  bool wants_effects_;
};

}  // namespace isocnc::execution
