#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "interpreter/motion/machine.h"
#include "interpreter/motion/move.h"
#include "interpreter/motion/path.h"

namespace isocnc::motion {

/// In which space a path is given and rounded.
enum class Space : std::uint8_t {
  Either,  ///< B and C rest: what is straight for the tip is so for the joints.
  Joints,
  Tip,
};

/// A line or a turn at most: what moves are made of before their corners are rounded.
struct Element {
  Path path;
  double begin = 0;  ///< Of the path's parameter; grows where the corner before is rounded.
  double end = 0;
  double length = 0;     ///< Before any rounding.
  double curvature = 0;  ///< Of the path, 1/mm.
  Space space = Space::Either;
  bool joints_are_straight = true;
  bool only_turns = false;                                ///< s counts degrees.
  double feed = std::numeric_limits<double>::infinity();  ///< Most speed of the tip, or of B and C; per second.
  double max_tip_rate = 1;                                ///< Most length of the tip's way per unit of s.
  /// The path's first derivative at an end that is rounded, as the corner knows it; of arcs.
  std::optional<Coordinates> slope_at_begin;
  std::optional<Coordinates> slope_at_end;
  std::uint64_t tag = 0;
  bool ends_move = false;
  bool stops = false;  ///< At its end.
};

/// The whole of a move's path, before it is cut or rounded: s from 0 to `length`.
struct ProgrammedPath {
  Path path;
  double length = 0;
  bool only_turns = false;  ///< s counts degrees.
};

/// Whether a line's joints go straight to their end, while B and C swing the tip.
bool swings(const Machine& machine, const Move& move);

/// A line of the tip or of the joints, as the move asks for. `length` is 0 where it goes nowhere.
ProgrammedPath programmed_line(const Machine& machine, const Move& move, const geometry::Pose& from,
                               const geometry::Pose& to);

/// An arc's circle, on which B and C rest.
ProgrammedPath programmed_circle(const Move& move);

/// Into so many parts, at least 1 and at most `most`, whatever the number: programs may hold any coordinates.
int part_count(double parts, int max);

/// Into how many lines an arc becomes, where it becomes lines (Move::splits_arcs); 1 for all other moves.
int segment_count(const Machine& machine, const Move& move);

/// Cuts a move into elements, one at a time, so that a thread of a thousand turns takes no more memory than a line.
class Splitter {
 public:
  void take(const Machine& machine, const Move& move);
  bool has_more() const { return index_ < count_; }
  /// Only while has_more().
  Element next(const Machine& machine);

 private:
  static Element line(const Machine& machine, const ProgrammedPath& line);
  Element chord(const Machine& machine) const;
  Element arc() const;

  Move move_;
  ProgrammedPath whole_;
  int count_ = 0;
  int index_ = 0;
};

}  // namespace isocnc::motion
