#pragma once

#include <array>
#include <cstdint>

#include "interpreter/dialect/codes.h"
#include "interpreter/execution/line_parts.h"
#include "interpreter/execution/setup.h"
#include "interpreter/geometry/frame.h"

namespace isocnc::execution {

/// An axis of the tool tip's pose, in the order of Pose.
enum class Axis : std::uint8_t { X, Y, Z, B, C };
inline constexpr int kAxisCount = 5;

constexpr char letter_of(Axis axis) { return dialect::kAxisLetters[static_cast<std::size_t>(axis)]; }

/// A set of axes, one bit each.
using AxisSet = std::uint8_t;
constexpr AxisSet axis_bit(Axis axis) { return static_cast<AxisSet>(1u << static_cast<unsigned>(axis)); }
inline constexpr AxisSet kLinearAxes = 0b00111;
inline constexpr AxisSet kAllAxes = 0b11111;

/// The axes that some letters name.
constexpr AxisSet axes_of(dialect::LetterSet letters) {
  static_assert(dialect::kLinearLetters == 7u << 23 && dialect::kRotaryLetters == 3u << 1);
  return static_cast<AxisSet>((letters >> 23 & 7u) | (letters >> 1 & 3u) << 3);
}

/// A feed rate as written, and the length of its unit: 25.4 mm under G70. The unit holds for linear axes only; rotary
/// axes alone move in degrees per minute under G70 as well as G71 (I.3.7).
struct ProgrammedFeed {
  double number = 0;  ///< 0 before any F.
  double mm_per_unit = 1;
  bool is_known = true;  ///< Not where paths with different ones join, up to the next F.

  friend bool operator==(const ProgrammedFeed&, const ProgrammedFeed&) = default;
};

/// What the spindle does, as far as the program shows it. Unknown after a tool change, whose effect on the spindle
/// depends on the machine, after an M that cannot be read or a lost letter (D58), and where paths with different
/// directions join.
enum class Spindle : std::uint8_t { Unknown, Stopped, Clockwise, Counterclockwise };

/// The machine state after some block: everything that can affect later blocks. A value: copy it to keep it, compare it
/// to know whether two histories still differ. It holds no line numbers and no text, so an edit elsewhere does not
/// change it. The caller that follows the jumps keeps the registers.
struct State {
  geometry::Pose position;  ///< In the frame in force; 0 for unknown axes.
  AxisSet unknown = 0;      ///< Axes whose position is unknown after an error; checks that depend on them are skipped.
  std::array<std::uint8_t, dialect::kModalGroupCount> in_force = dialect::kDefaultModes;  ///< G number by group.
  std::uint16_t written = 0;  ///< Groups of which a member has been written (D3).
  /// Groups of which the member in force is not known: a G may have lost its letter (D58), or may have been meant as
  /// another that is one slip away.
  std::uint16_t in_doubt = 0;

  geometry::Vec3 workpiece_origin = geometry::Vec3::Zero();  ///< Machine frame (G92).
  geometry::Frame face;                                      ///< In the workpiece frame; identity unless mounted.
  bool face_mounted = false;
  AxisSet workpiece_unknown = 0;    ///< Axes of `workpiece_origin` that are unknown after an error.
  bool face_undefined = false;      ///< The face was mounted by a wrong definition; its axes are unknown.
  bool face_unplaced = false;       ///< The face was mounted at the tip (G28), whose position was unknown.
  bool dismount_tolerated = false;  ///< A G92 has dismounted the face (ISO055); a G27 after it is valid (D29).

  ProgrammedFeed feed_per_minute;      ///< Last F under G94.
  ProgrammedFeed last_feed;            ///< Last F under either mode (D43).
  double spindle_speed = 0;            ///< Revolutions per minute; 0 before any S.
  bool speed_known = true;             ///< Not where paths with different ones join, up to the next S.
  bool speed_given = false;            ///< An S has been given on some path, or may have lost its letter (D58).
  std::uint8_t spindle_function = 5;   ///< Number of the last spindle M: 3, 4 or 5.
  Spindle spindle = Spindle::Stopped;  ///< Unknown where the last spindle M no longer decides.
  ToolCode tool;
  bool tool_known = false;  ///< A tool change has mounted `tool`, on every path.
  bool tool_selected = false;
  bool tool_reported = false;  ///< ISO044 has been reported.
  bool feed_given = false;
  bool feed_reported = false;    ///< ISO066 has been reported, or the missing F may have lost its letter (D58).
  bool feed_on_rapid = false;    ///< On some path the only F so far is on the line of a rapid, which ignores it (D43).
  bool exact_stop_fits = false;  ///< A G09 at the start of the next line would follow a feed move (D23).
  Lack lack;                     ///< What the previous block lacks.
  /// The last T had no M06 (reported), and no motion followed; an M06 without T mounts this tool.
  bool tool_prepared = false;
  bool motion_illegible = false;  ///< The last motion G is illegible, or a cycle of another control (E001).
  bool ended = false;             ///< M02 has been read.

  static constexpr std::uint16_t bit(dialect::ModalGroup group) {
    return static_cast<std::uint16_t>(1u << static_cast<unsigned>(group));
  }
  /// Whether it is not known which G of the group is in force; checks that depend on it are skipped.
  bool is_in_doubt(dialect::ModalGroup group) const { return (in_doubt & bit(group)) != 0; }
  std::uint8_t mode(dialect::ModalGroup group) const { return in_force[static_cast<std::size_t>(group)]; }
  void set_mode(dialect::ModalGroup group, std::uint8_t number) { in_force[static_cast<std::size_t>(group)] = number; }
  void set_mode(const dialect::GCode& code) { set_mode(code.group, static_cast<std::uint8_t>(code.number)); }
  /// The G in force of a group; null only for a motion, which no default provides.
  const dialect::GCode* g(dialect::ModalGroup group) const { return dialect::g_code(mode(group)); }
  const dialect::GCode* motion() const { return g(dialect::ModalGroup::Motion); }
  dialect::GRole compensation() const { return g(dialect::ModalGroup::CutterCompensation)->role; }
  bool is_compensated() const { return compensation() != dialect::GRole::CompensationOff; }
  bool reduces_profile() const { return mode(dialect::ModalGroup::ProfileReduction) == dialect::kProfileReduction; }
  bool incremental() const { return mode(dialect::ModalGroup::Distance) == dialect::kIncremental; }
  bool five_axis() const { return mode(dialect::ModalGroup::Interpolation) == dialect::kFiveAxis; }
  bool inverse_time() const { return mode(dialect::ModalGroup::FeedMode) == dialect::kInverseTime; }
  bool in_inches() const { return mode(dialect::ModalGroup::Units) == dialect::kInches; }
  double mm_per_unit() const { return dialect::mm_per_unit(in_inches()); }
  /// Whether M03 or M04 is in force.
  bool spindle_turns() const { return spindle == Spindle::Clockwise || spindle == Spindle::Counterclockwise; }

  /// Whether the place of the frame in force on the machine is known.
  bool is_frame_known() const {
    const auto frames =
        static_cast<std::uint16_t>(bit(dialect::ModalGroup::Face) | bit(dialect::ModalGroup::Workpiece));
    return workpiece_unknown == 0 && !face_undefined && !face_unplaced && (in_doubt & frames) == 0;
  }
  /// The frame in force, in the machine frame.
  geometry::Frame frame_in_force() const {
    return {.origin = to_machine(geometry::Vec3::Zero()),
            .axes = face_mounted ? face.axes : geometry::Mat3::Identity()};
  }
  /// Transforms a point from the frame in force to the machine frame, mm.
  geometry::Vec3 to_machine(const geometry::Vec3& p) const {
    return workpiece_origin + (face_mounted ? face.to_outer(p) : p);
  }
  geometry::Vec3 direction_to_machine(const geometry::Vec3& d) const { return face_mounted ? face.axes * d : d; }

  friend bool operator==(const State&, const State&) = default;
};

/// The state in which a program starts (D32).
State initial_state(const Setup& setup);

/// The feed that an interpolated motion without F runs at (D43).
ProgrammedFeed feed_in_force(const State& state);

/// Whether all later blocks get the same findings after `a` as after `b`: the states may differ only in the values of
/// feed, spindle and tool, on which no check of the dialect depends, and in `feed_on_rapid`, which selects a message.
bool judged_alike(const State& a, const State& b);

/// Lets `into` stand for both of two states that are judged alike. Where their spindles, tools, spindle speeds or feeds
/// differ, these are unknown after it; the numbers of feed and speed remain those of `into`.
void join(State& into, const State& other);

}  // namespace isocnc::execution
