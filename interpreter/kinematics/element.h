#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/kinematics/path.h"

namespace isocnc::kinematics {

/// The space in which a path is given and its corners are rounded.
enum class Space : std::uint8_t {
  Either,  ///< Tip or joints: B and C rest, so a line of the tip is a line of the joints.
  Joints,  ///< Positions of the joints X, Y, Z, B, C.
  Tip,     ///< Pose of the tip in the machine frame.
};

/// A part of one move's path that is a single line, or at most one turn of an arc. Moves are cut into elements; then
/// corners between elements are rounded.
struct Element {
  Path path;
  double begin = 0;      ///< Path parameter s at the start; a blend with the previous element increases it.
  double end = 0;        ///< Path parameter s at the end; a blend with the next element decreases it.
  double length = 0;     ///< Range of s before any rounding, mm or degrees.
  double curvature = 0;  ///< Curvature of an arc, 1/mm; 0 for lines.
  Space space = Space::Either;
  bool joints_are_straight = true;                        ///< Whether all joints move linearly in s.
  bool only_turns = false;                                ///< Whether B and C alone move, so that s counts degrees.
  double feed = std::numeric_limits<double>::infinity();  ///< Maximum speed along the path, mm/s or degrees/s.
  double max_tip_rate = 1;                                ///< Maximum length of the tip's path per unit of s.
  /// First derivative of the blend's path where it meets a rounded end of an arc; absent at ends without a blend.
  std::optional<Coordinates> slope_at_begin;
  std::optional<Coordinates> slope_at_end;
  /// Derivatives of the joints where a blend of the tip meets the rounded end of a line; absent at other ends.
  std::optional<Derivatives> joints_at_begin;
  std::optional<Derivatives> joints_at_end;
  std::uint64_t tag = 0;   ///< Move::tag of the move.
  bool ends_move = false;  ///< Whether this is the last element of its move.
  bool stops = false;      ///< Whether the machine stops exactly at the element's end (G09).

  bool is_arc() const { return path.kind == PathKind::Circle; }
};

/// The path of a whole move, before it is cut into elements and rounded.
struct ProgrammedPath {
  Path path;                ///< The curve; s runs from 0 to `length`.
  double length = 0;        ///< Range of s, mm, or degrees if `only_turns`.
  bool only_turns = false;  ///< Whether B and C alone move, so that s counts degrees.
};

/// Returns whether a move swings the tip off its line: B or C turn, and every joint moves linearly to its end position.
bool swings(const Machine& machine, const Move& move);

/// Returns the line of a move from one pose to another, in the space of the tip or of the joints as the move asks for.
/// `length` is 0 if the poses are equal.
ProgrammedPath programmed_line(const Machine& machine, const Move& move, const geometry::Pose& from,
                               const geometry::Pose& to);

/// Returns the circle or helix of an arc, with B and C at the values of the arc's start.
ProgrammedPath programmed_circle(const Move& move);

/// Rounds `parts` up to an integer from 1 to `max`. Any number is accepted, since programs may hold any coordinates.
int part_count(double parts, int max);

/// Returns the number of lines that an arc is split into (Move::splits_arcs); 1 for every other move.
int segment_count(const Machine& machine, const Move& move);

/// Cuts a move into elements, one at a time: a thread of a thousand turns takes no more memory than a line.
class Splitter {
 public:
  /// Starts with a new move.
  void take(const Machine& machine, const Move& move);
  bool has_more() const { return index_ < count_; }
  /// Returns the next element. Requires has_more().
  Element next(const Machine& machine);

 private:
  static Element line(const Machine& machine, const ProgrammedPath& line);
  Element chord(const Machine& machine) const;
  Element arc() const;

  Move move_;
  ProgrammedPath whole_;  ///< Path of the whole move.
  int count_ = 0;         ///< Number of the move's elements.
  int index_ = 0;         ///< Number of elements returned so far.
};

}  // namespace isocnc::kinematics
