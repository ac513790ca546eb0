#pragma once

#include <array>
#include <cstdint>

#include "interpreter/dialect/codes.h"
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

/// A feed rate as written, and what a unit of it is worth: mm per inch under G70, which holds for linear axes only;
/// rotary axes alone move in degrees per minute under either (I.3.7).
struct Feed {
  double number = 0;  ///< 0 before any F.
  double mm_per_unit = 1;

  friend bool operator==(const Feed&, const Feed&) = default;
};

/// All that a program has brought about up to some point, and that anything later can depend on. A value: copy it to
/// keep it, compare it to know whether two histories still differ. It knows neither lines nor text, so an edit
/// elsewhere does not change it. Registers are with who follows the jumps.
struct State {
  // What is certain on every path that has led here; where paths join, what they share. Only lint rules ask.
  using Knowledge = std::uint16_t;
  static constexpr Knowledge kNoSpeed = 1;              ///< No S so far.
  static constexpr Knowledge kClockwise = 2;            ///< M03 is in force.
  static constexpr Knowledge kCounterclockwise = 4;     ///< M04 is in force.
  static constexpr Knowledge kStopped = 8;              ///< M05 has stopped the spindle, and no feed move followed.
  static constexpr Knowledge kFeedOfInverseTime = 16;   ///< The last F was given in G93; no feed move in G94 followed.
  static constexpr Knowledge kUncut = 32;               ///< The tool has made no feed move, nor has an M used it.
  static constexpr Knowledge kToolKnown = 64;           ///< `tool` is what a tool change has mounted.
  static constexpr Knowledge kCompensationWaits = 128;  ///< G41 or G42 has been written, and no motion followed.
  /// Nothing has started the spindle: no M03 or M04, nor an M of the shop's. The first feed move ends it.
  static constexpr Knowledge kNotStarted = 256;
  static constexpr Knowledge kCutNotStarted = 512;  ///< Nor had anything when that feed move came, and no S was given.

  geometry::Pose position;  ///< In the frame in force. What is unknown reads 0.
  AxisSet unknown = 0;      ///< Axes whose position an error has left open: nothing that depends on them is checked.
  std::array<std::uint8_t, dialect::kModalGroupCount> in_force = dialect::kDefaultModes;  ///< G number by group.
  std::uint16_t written = 0;  ///< Groups of which a member has been written (D3).

  geometry::Vec3 workpiece_origin = geometry::Vec3::Zero();  ///< Machine frame (G92).
  geometry::Frame face;                                      ///< In the workpiece frame; identity unless mounted.
  bool face_mounted = false;
  AxisSet workpiece_unknown = 0;    ///< Axes of `workpiece_origin` that an error has left open.
  bool face_undefined = false;      ///< Mounted by a definition in error: its axes are not known.
  bool face_unplaced = false;       ///< Mounted where the tip was (G28), which was not known.
  bool dismount_tolerated = false;  ///< A G92 has dismounted it in error (ISO055): a G27 that follows is right (D29).

  Feed feed_per_minute;      ///< Last F under G94.
  Feed last_feed;            ///< Last F under either mode (D43).
  double spindle_speed = 0;  ///< Revolutions per minute; 0 before any S.
  std::uint8_t spindle = 5;  ///< 3, 4 or 5, as the last M said.
  ToolCode tool;
  bool tool_selected = false;
  bool tool_reported = false;  ///< ISO044 has been said.
  bool feed_given = false;
  bool feed_reported = false;    ///< ISO066 has been said.
  bool exact_stop_fits = false;  ///< A G09 at the start of the next line would follow a feed move (D23).
  bool expects_tool = false;     ///< The line before ended in an M06 without T (reported): a T that follows is its.
  bool tool_prepared = false;    ///< A T without M06 (reported), and no motion since: an M06 without T changes to it.
  bool motion_illegible =
      false;           ///< No motion G is in force, but one that cannot be read, or a cycle of others (E001).
  bool ended = false;  ///< M02 has been read.

  Knowledge knowledge = kNoSpeed | kNotStarted;

  bool knows(Knowledge any_of) const { return (knowledge & any_of) != 0; }
  void learn(Knowledge what) { knowledge |= what; }
  void forget(Knowledge what) { knowledge &= static_cast<Knowledge>(~what); }
  std::uint8_t mode(dialect::ModalGroup group) const { return in_force[static_cast<std::size_t>(group)]; }
  void set_mode(dialect::ModalGroup group, std::uint8_t number) { in_force[static_cast<std::size_t>(group)] = number; }
  bool incremental() const { return mode(dialect::ModalGroup::Distance) == 91; }
  bool five_axis() const { return mode(dialect::ModalGroup::Interpolation) == 49; }
  bool inverse_time() const { return mode(dialect::ModalGroup::FeedMode) == 93; }
  double mm_per_unit() const { return mode(dialect::ModalGroup::Units) == 70 ? 25.4 : 1.0; }

  /// Whether it is known where the frame in force lies on the machine.
  bool is_frame_known() const { return workpiece_unknown == 0 && !face_undefined && !face_unplaced; }
  /// From the frame in force to the machine frame, mm.
  geometry::Vec3 to_machine(const geometry::Vec3& p) const {
    return workpiece_origin + (face_mounted ? face.to_outer(p) : p);
  }
  geometry::Vec3 direction_to_machine(const geometry::Vec3& d) const { return face_mounted ? face.axes * d : d; }

  friend bool operator==(const State&, const State&) = default;
};

/// The state in which a program starts (D32).
State initial_state(const Setup& setup);

/// The feed that an interpolated motion without F runs at (D43).
Feed feed_in_force(const State& state);

/// Whether nothing that comes later can be judged differently after `a` than after `b`: equal but for the values of
/// feed, spindle speed and tool, on which no check of the dialect depends, and for what is only known (`knowledge`).
bool judged_alike(const State& a, const State& b);

}  // namespace isocnc::execution
