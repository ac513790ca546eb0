#include "interpreter/motion/rounder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "interpreter/kinematics/independent_rapid.h"
#include "interpreter/kinematics/limits.h"
#include "interpreter/kinematics/numbers.h"
#include "interpreter/motion/blend.h"
#include "interpreter/motion/path_times.h"
#include "interpreter/motion/piece.h"
#include "interpreter/motion/rounded_path.h"

namespace isocnc::motion {

/// Maximum angle of the pieces of a curve over which limits are taken, radians. Fine pieces are used where the curve
/// needs more than `kSmallPart` of the acceleration at the programmed feed, coarse pieces elsewhere, since there the
/// feed determines the speed nearly everywhere. Where jerk is not limited, arcs have fine pieces only at their ends,
/// where the speed changes.
static constexpr double kFineTurn = 2.5 * std::numbers::pi / 180;
static constexpr double kCoarseTurn = 10 * std::numbers::pi / 180;
static constexpr double kSmallPart = 0.1;
/// Maximum part of an arc's length on which the speed changes at one end, for that end to be a single span.
static constexpr double kBriefPart = 1.0 / 64;
/// Maximum number of pieces of one element. Rotary axes do not turn far enough in one move to need more.
static constexpr int kMaxPieces = 5'000;
/// Maximum distance between the end of a move and the start of the next that counts as none, mm or degrees.
static constexpr double kSamePlace = 1e-6;

static bool differ(const geometry::Pose& a, const geometry::Pose& b) {
  return (kinematics::coordinates(a) - kinematics::coordinates(b)).cwiseAbs().maxCoeff() > kSamePlace;
}

static Piece whole_piece(const kinematics::Element& element) {
  return {element.path, element.begin, element.end - element.begin, element.tag, element.ends_move};
}

/// Returns the angle by which a curve turns per unit of s, radians.
static double turning(const kinematics::Path& path) {
  if (path.kind == kinematics::PathKind::Circle) return std::abs(path.omega);
  return (std::abs(path.c[1][kinematics::kB]) + std::abs(path.c[1][kinematics::kC])) * std::numbers::pi / 180;
}

/// Returns the maximum of (ds/dt)^2 by the feed, mm^2/s^2.
static double feed_cap(const kinematics::Element& element) {
  return kinematics::square(element.feed / element.max_tip_rate);
}

/// Returns the number of pieces into which a curve is cut, by the curvature of the path of the linear joints.
static int piece_count(const kinematics::Machine& machine, const kinematics::Element& element) {
  const double length = element.end - element.begin;
  const double rate = turning(element.path);
  const kinematics::Coordinates middle = element.path.value_at((element.begin + element.end) / 2);
  const double radius = element.is_arc()
                            ? element.path.c[1].norm()
                            : kinematics::lever(machine.kinematics, middle.head<3>(), element.path.tool_length);
  double weakest = machine.axes[kinematics::kX].acceleration;
  for (const kinematics::MachineAxis axis : {kinematics::kY, kinematics::kZ})
    weakest = std::min(weakest, machine.axes[axis].acceleration);
  const bool is_fine = radius * kinematics::square(rate) * feed_cap(element) > kSmallPart * weakest;
  return kinematics::part_count(length * rate / (is_fine ? kFineTurn : kCoarseTurn), kMaxPieces);
}

/// Returns a circle with the derivatives of the one along which the joints move while B and C rest. Its center differs.
static kinematics::Path joint_circle(const kinematics::Kinematics& kinematics, const kinematics::Path& circle) {
  kinematics::Path result = circle;
  result.is_of_joints = true;
  if (kinematics.kind != kinematics::MachineKind::Table) return result;
  const geometry::Mat3 turn =
      kinematics::turn_to_joints(kinematics, circle.c[0][kinematics::kB], circle.c[0][kinematics::kC]);
  for (std::size_t i = 1; i <= 3; ++i) result.c[i].head<3>() = turn * circle.c[i].head<3>();
  return result;
}

/// Returns the limits of a circle within the length `ramp` of the place where it has this slope. There each joint's
/// slope changes by at most `ramp` times the maximum of its second derivative.
static kinematics::LineLimits ramp_limits(const kinematics::Machine& machine, const kinematics::Path& circle,
                                          const kinematics::Coordinates& slope, double ramp) {
  const kinematics::Coordinates bend =
      kinematics::square(circle.omega) * (circle.c[1].cwiseAbs2() + circle.c[2].cwiseAbs2()).cwiseSqrt();
  return kinematics::line_limits(machine, slope.cwiseAbs() + ramp * bend);
}

/// Returns the derivatives of a circle at the place that follows that of `from` by an angle of this cosine and sine.
static kinematics::Derivatives turned_on(const kinematics::Path& circle, const kinematics::Derivatives& from,
                                         double cosine, double sine) {
  const kinematics::Coordinates along = from.first - circle.c[3];
  return {.first = cosine * along + sine / circle.omega * from.second + circle.c[3],
          .second = cosine * from.second - sine * circle.omega * along};
}

/// Returns the maximum of the tip's speed at ds/dt = 1 on a part of a blend, mm/s or degrees/s.
static double tip_rate(const kinematics::Machine& machine, const Piece& piece, bool only_turns) {
  double max = 0;
  for (const double part : {0.0, 0.5, 1.0}) {
    const kinematics::Coordinates slope =
        piece.path.tip_at(machine.kinematics, piece.begin + part * piece.length).first;
    max = std::max(max, only_turns ? slope.tail<2>().norm() : slope.head<3>().norm());
  }
  // Between these places the slope is a parabola, which deviates from the straight line by at most length^2/8 times its
  // second derivative.
  const kinematics::Coordinates bulge = 6 * kinematics::square(piece.length / 2) / 8 * piece.path.c[3];
  return max + (only_turns ? bulge.tail<2>().norm() : bulge.head<3>().norm());
}

/// Returns the maximum of the speeds of B and C at ds/dt = 1 on a part of a blend, degrees/s.
static double turning_rate(const kinematics::Machine& machine, const Piece& piece) {
  double max = 0;
  for (const double part : {0.0, 0.5, 1.0})
    max = std::max(
        max,
        piece.path.tip_at(machine.kinematics, piece.begin + part * piece.length).first.tail<2>().cwiseAbs().maxCoeff());
  return max + (6 * kinematics::square(piece.length / 2) / 8 * piece.path.c[3]).tail<2>().cwiseAbs().maxCoeff();
}

static TrackOwner owner_of(const kinematics::Element& element, int span_count) {
  return {.tag = element.tag, .ends_move = element.ends_move, .span_count = span_count};
}

/// A rounder with the machine and the place where its path goes.
template <class Out>
class Rounding {
 public:
  Rounding(Rounder& rounder, const kinematics::Machine& machine, Out& out)
      : rounder_(rounder), last_(rounder.last_), machine_(machine), out_(out) {}

  void push(const kinematics::Move& move) {
    if (rounder_.has_end_ && differ(rounder_.end_, move.from)) come_to_rest();
    rounder_.end_ = move.to;
    rounder_.has_end_ = true;
    const bool is_independent = kinematics::moves_independently(machine_, move);
    // The times of one joint whose jerk is not limited are those of its line.
    if (is_independent && (out_.limits_jerk() || kinematics::leaves_line(machine_, move))) return append_rapid(move);
    if (is_independent) come_to_rest();
    kinematics::Move planned = move;
    planned.exact_stop = move.exact_stop || is_independent;
    rounder_.splitter_.take(machine_, planned);
    if (!rounder_.splitter_.has_more() && planned.exact_stop) come_to_rest();
  }

  /// Takes the next element. An element is appended when the next element or a stop determines its end.
  void take(kinematics::Element element) {
    out_.begin_element();
    if (rounder_.has_last_ && out_.limits_jerk()) join_smoothly(element);
    if (rounder_.has_last_ && !out_.limits_jerk()) join(element);
    last_ = element;
    rounder_.has_last_ = true;
    rounder_.known_elements_ = std::min(rounder_.known_elements_ + 1, Rounder::kSettled);
    if (last_.stops) {
      come_to_rest();
    } else {
      out_.end_element();
    }
  }

  void come_to_rest() {
    if (rounder_.has_last_) append(last_);
    rounder_.has_last_ = false;
    rounder_.known_elements_ = Rounder::kSettled;
    out_.come_to_rest(machine_);
  }

 private:
  /// Appends a rapid whose joints move independently.
  void append_rapid(const kinematics::Move& rapid) {
    come_to_rest();
    out_.begin_element();
    const std::vector<kinematics::RapidPart> parts = kinematics::independent_rapid(machine_, rapid);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const kinematics::RapidPart& part = parts[i];
      out_.append_phase({part.path, 0, part.length, rapid.tag, i + 1 == parts.size()},
                        {part.duration, 0, part.speed, part.acceleration, part.jerk});
    }
    out_.end_phases();
  }

  /// Appends the last element, whose end is now known, and the blend with the next one, whose start the blend moves.
  void join(kinematics::Element& next) {
    const Corner corner = motion::corner(machine_, last_, next);
    if (corner.junction == Junction::Stop) return come_to_rest();
    const double depth = corner.blend.length / 2;
    last_.end -= depth;
    next.begin += depth;
    if (corner.junction == Junction::Smooth) return append(last_);
    const auto& c = corner.blend.path.c;
    if (last_.is_arc()) last_.slope_at_end = c[1];
    if (next.is_arc()) next.slope_at_begin = c[1] + corner.blend.length * (2 * c[2] + 3 * corner.blend.length * c[3]);
    last_.joints_at_end = corner.joints_before;
    next.joints_at_begin = corner.joints_after;
    const bool ends_move = std::exchange(last_.ends_move, false);
    append(last_);
    last_.ends_move = ends_move;
    append_corner(corner.blend, last_, next);
  }

  /// Does the same as join() for machines whose jerk is limited, with a blend without steps of the second derivative.
  void join_smoothly(kinematics::Element& next) {
    const SmoothCorner corner = smooth_corner(machine_, last_, next);
    if (corner.junction == Junction::Stop) return come_to_rest();
    const double depth = corner.blend.length / 2;
    last_.end -= depth;
    next.begin += depth;
    if (corner.junction == Junction::Smooth) return append(last_);
    const bool ends_move = std::exchange(last_.ends_move, false);
    append(last_);
    last_.ends_move = ends_move;
    append_corner(corner.blend, last_, next);
  }

  void append(const kinematics::Element& element) {
    if (element.end - element.begin <= kinematics::kNoLength) return;
    if (!element.joints_are_straight) {
      append_curve(element);
    } else if (out_.limits_jerk()) {
      out_.append_smooth(machine_, whole_piece(element), kinematics::square(element.feed));
    } else {
      append_line(element);
    }
  }

  void append_line(const kinematics::Element& element) {
    kinematics::Coordinates slope = element.path.c[1];
    if (element.space == kinematics::Space::Either && machine_.kinematics.kind == kinematics::MachineKind::Table)
      slope.head<3>() = kinematics::turn_to_joints(machine_.kinematics, element.path.c[0][kinematics::kB],
                                                   element.path.c[0][kinematics::kC]) *
                        element.path.c[1].head<3>();
    kinematics::LineLimits limits = kinematics::line_limits(machine_, slope);
    limits.cap = std::min(limits.cap, kinematics::square(element.feed));
    out_.append_line(element.begin, element.end - element.begin, limits);
    out_.append_track(element.path, owner_of(element, 1));
  }

  /// Appends a span of a curve. `cap`: maximum of (ds/dt)^2 by the feed.
  void append_span(double begin, double length, double cap, const kinematics::CurveLimits& limits) {
    out_.append_curve(begin, length, std::min(limits.cap(), cap), limits.bounds(kinematics::Direction::Forward),
                      limits.bounds(kinematics::Direction::Backward));
  }

  void append_curve(const kinematics::Element& element) {
    if (out_.limits_jerk()) return append_smooth_curve(element);
    if (element.is_arc()) return append_arc(element);
    const double length = element.end - element.begin;
    const int count = piece_count(machine_, element);
    double from = element.begin;
    const auto joints_at = [&](double s, const std::optional<kinematics::Derivatives>& known) {
      return known ? *known : element.path.joints_at(machine_.kinematics, s).derivatives();
    };
    kinematics::Derivatives at_from = joints_at(from, element.joints_at_begin);
    for (int i = 1; i <= count; ++i) {
      const double to = element.begin + length * i / count;
      const kinematics::Derivatives at_to = joints_at(to, i == count ? element.joints_at_end : std::nullopt);
      const kinematics::HigherDerivativeBounds higher =
          kinematics::higher_derivative_bounds(machine_.kinematics, element.path, from, to);
      append_span(from, to - from, feed_cap(element),
                  kinematics::CurveLimits(machine_, at_from, at_to, higher, to - from));
      from = to;
      at_from = at_to;
    }
    out_.append_track(element.path, owner_of(element, count));
  }

  void append_smooth_curve(const kinematics::Element& element) {
    const double length = element.end - element.begin;
    const int count = piece_count(machine_, element);
    for (int i = 0; i < count; ++i) {
      const double begin = element.begin + length * i / count;
      const double end = element.begin + length * (i + 1) / count;
      const bool ends_move = element.ends_move && i + 1 == count;
      out_.append_smooth(machine_, {element.path, begin, end - begin, element.tag, ends_move}, feed_cap(element));
    }
  }

  /// Appends a part of a circle in fine pieces. Returns their number.
  int append_fine(const kinematics::Path& circle, double begin, double end, double cap) {
    const int count = kinematics::part_count((end - begin) * turning(circle) / kFineTurn, kMaxPieces);
    const double length = (end - begin) / count;
    const double cosine = std::cos(circle.omega * length);
    const double sine = std::sin(circle.omega * length);
    const kinematics::HigherDerivativeBounds higher =
        kinematics::higher_derivative_bounds(machine_.kinematics, circle, begin, end);
    kinematics::Derivatives from = circle.at(begin).derivatives();
    for (int i = 0; i < count; ++i) {
      const kinematics::Derivatives to = turned_on(circle, from, cosine, sine);
      append_span(begin + i * length, length, cap, kinematics::CurveLimits(machine_, from, to, higher, length));
      from = to;
    }
    return count;
  }

  /// Appends an arc: in fine pieces all along, or, if the axes can hold the feed everywhere, with fine pieces only at
  /// both ends, where the speed reaches the feed and leaves it. From a standstill the feed is reached after the
  /// integral of dx / 2a up to the feed's x, with a = acceleration (1 - fall x). The ends are at least as long as that,
  /// because -ln(1 - p) <= p / sqrt(1 - p).
  void append_arc(const kinematics::Element& element) {
    const kinematics::Path circle = joint_circle(machine_.kinematics, element.path);
    const double length = element.end - element.begin;
    const double cap = feed_cap(element);
    const kinematics::LineLimits anywhere = kinematics::circle_limits(machine_, circle);
    const double ramp =
        cap < anywhere.cap ? cap / (2 * anywhere.acceleration * std::sqrt(1 - anywhere.fall * cap)) : length;
    if (2 * ramp >= length) {
      out_.append_track(element.path, owner_of(element, append_fine(circle, element.begin, element.end, cap)));
      return;
    }
    const bool is_brief = ramp <= kBriefPart * length && ramp * turning(circle) <= kFineTurn;
    const bool as_tip =
        machine_.kinematics.kind != kinematics::MachineKind::Table;  // Tip and joints have equal slopes.
    const auto append_ramp = [&](double begin, double end, double s,
                                 const std::optional<kinematics::Coordinates>& known) {
      if (!is_brief) return append_fine(circle, begin, end, cap);
      const kinematics::Coordinates slope = known && as_tip ? *known : circle.at(s).first;
      const double acceleration = ramp_limits(machine_, circle, slope, ramp).acceleration;
      out_.append_line(begin, end - begin, {cap, acceleration, anywhere.fall});
      return 1;
    };
    const double first = element.begin + ramp;
    const double last = element.end - ramp;
    int count = append_ramp(element.begin, first, element.begin, element.slope_at_begin);
    out_.append_line(first, last - first, {cap, anywhere.acceleration, anywhere.fall});
    count += 1 + append_ramp(last, element.end, element.end, element.slope_at_end);
    out_.append_track(element.path, owner_of(element, count));
  }

  void append_corner(const Blend& blend, const kinematics::Element& before, const kinematics::Element& after) {
    out_.append_level(blend.length, blend.cap);
    out_.append_track(blend.path, {.tag = before.tag,
                                   .ends_move = before.ends_move,
                                   .is_shared = before.tag != after.tag,
                                   .next_tag = after.tag});
  }

  /// Appends a blend in four parts: the second of its three cubics belongs to both moves, half to each.
  void append_corner(const SmoothBlend& blend, const kinematics::Element& before, const kinematics::Element& after) {
    const double third = blend.length / 3;
    const Piece parts[] = {{blend.paths[0], 0, third, before.tag},
                           {blend.paths[1], 0, third / 2, before.tag, before.ends_move},
                           {blend.paths[1], third / 2, third / 2, after.tag},
                           {blend.paths[2], 0, third, after.tag}};
    const double feed = std::min(before.feed, after.feed);
    for (const Piece& part : parts) {
      const double max_tip_rate =
          std::max({before.max_tip_rate, after.max_tip_rate, tip_rate(machine_, part, before.only_turns)});
      const double by_turn = std::isinf(feed) ? feed : machine_.feed_turn / turning_rate(machine_, part);
      out_.append_smooth(machine_, part, kinematics::square(std::min(feed / max_tip_rate, by_turn)));
    }
  }

  Rounder& rounder_;
  kinematics::Element& last_;  ///< The rounder's.
  const kinematics::Machine& machine_;
  Out& out_;
};

Rounder Rounder::anywhere() {
  Rounder rounder;
  rounder.known_elements_ = 0;
  return rounder;
}

template <class Out>
void Rounder::push(const kinematics::Machine& machine, const kinematics::Move& move, Out& out) {
  Rounding(*this, machine, out).push(move);
}

template <class Out>
void Rounder::take_next(const kinematics::Machine& machine, Out& out) {
  Rounding(*this, machine, out).take(splitter_.next(machine));
}

template <class Out>
void Rounder::come_to_rest(const kinematics::Machine& machine, Out& out) {
  Rounding(*this, machine, out).come_to_rest();
}

template void Rounder::push(const kinematics::Machine&, const kinematics::Move&, PathTimes&);
template void Rounder::take_next(const kinematics::Machine&, PathTimes&);
template void Rounder::come_to_rest(const kinematics::Machine&, PathTimes&);
template void Rounder::push(const kinematics::Machine&, const kinematics::Move&, RoundedPath&);
template void Rounder::take_next(const kinematics::Machine&, RoundedPath&);
template void Rounder::come_to_rest(const kinematics::Machine&, RoundedPath&);

}  // namespace isocnc::motion
