#include "interpreter/verification/encounter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "interpreter/geometry/frame.h"
#include "interpreter/solids/advance.h"
#include "interpreter/solids/clearance.h"
#include "interpreter/verification/body_distance.h"

// The distance of a pair falls by at most what its points travel. So each pair has a limit of travel up to which it
// needs no look: most stretches cost one comparison for all pairs.

namespace isocnc::verification {

using Eigen::Isometry3d;
using geometry::Vec3;
using solids::AxisPlacement;
using solids::Clearance;
using solids::Placement;

namespace {

constexpr double kNearTolerance = 0.1;  ///< Of the smallest distance of a near miss, mm.

/// Distances that are asked for along a stretch before the rest of it is taken in kPieces pieces.
constexpr int kMaxEvaluations = 50'000;
constexpr int kPieces = 64;

constexpr double kResolution = 0.1;  ///< Of the steps along a contact, mm.

/// Bodies that touch are together until they are farther from one another than this, mm: a motion along an obstacle at
/// the contact distance is one contact.
constexpr double kApart = 1.5 * kContactDistance;

/// A stretch, and where the machine is on it.
class StretchPlaces {
 public:
  StretchPlaces(const motion::Stretch& stretch, const kinematics::Kinematics& kinematics)
      : stretch_(stretch),
        kinematics_(kinematics),
        begin_(stretch.phases[0].from),
        end_(stretch.parameter_at(stretch.start + stretch.duration)),
        bounds_(motion_bounds(kinematics, stretch.path, begin_, end_)) {}

  double begin() const { return begin_; }
  double end() const { return end_; }
  double length() const { return end_ - begin_; }
  const MotionBounds& bounds() const { return bounds_; }
  double time_at(double s) const {
    if (s <= begin_) return stretch_.start;
    return s >= end_ ? stretch_.start + stretch_.duration : stretch_.time_at(s);
  }
  /// Whether parts only shift along a straight line, relative to the machine and to the workpiece.
  bool is_straight_shift() const {
    const kinematics::Path& path = stretch_.path;
    return bounds_.turn == 0 && path.kind == kinematics::PathKind::Polynomial && path.c[2].head<3>().isZero(0) &&
           path.c[3].head<3>().isZero(0);
  }

  /// Whether a part shifts in an obstacle's frame as the coordinates of the path do.
  bool shifts_along_path(const MovingPart& part, const Obstacle& obstacle) const {
    if (bounds_.turn != 0 || !follows_linear_joints(part)) return false;
    if (kinematics_.kind != kinematics::MachineKind::Table) return obstacle.on == Link::Machine;
    return obstacle.on == (stretch_.path.is_of_joints ? Link::Machine : Link::C);
  }
  bool is_shift(const MovingPart& part, const Obstacle& obstacle) const {
    return is_straight_shift() || shifts_along_path(part, obstacle);
  }
  const kinematics::Path& path() const { return stretch_.path; }

  /// Whether proven bounds hold where the stretch leads.
  bool is_in_reach() {
    const auto is_near = [&](double s) { return tip_at(s).head<3>().cwiseAbs().maxCoeff() <= solids::kMaxCoordinate; };
    return is_near(end_) && is_near(begin_);
  }

  /// Where a body of the tool is at `s`, in the frame of an obstacle.
  AxisPlacement tool_at(double s, double offset, const Obstacle& obstacle) {
    const kinematics::Coordinates& tip = tip_at(s);
    const bool turns = kinematics_.kind != kinematics::MachineKind::ThreeAxis;
    if (obstacle.on == kinematics::workpiece_link(kinematics_)) {
      const Vec3 axis =
          turns ? Vec3(geometry::axes_from_angles(tip[kinematics::kB], tip[kinematics::kC]).col(2)) : Vec3(0, 0, 1);
      return {tip.head<3>() + offset * axis - obstacle.shift, axis};
    }
    const kinematics::Coordinates joints = joints_at(s);
    const Isometry3d spindle = link_pose(kinematics_, spindle_link(kinematics_), joints);
    const Isometry3d place = link_pose(kinematics_, obstacle.on, joints).inverse() * spindle;
    const Vec3 axis = place.linear().col(2);
    return {place * Vec3(0, 0, offset - stretch_.path.tool_length) - obstacle.shift, axis};
  }

  /// A point of a link's frame in the frame of the workpiece's link, in which the program counts; at `s`.
  Vec3 on_workpiece(double s, const Vec3& point, Link on) const {
    const Link workpiece = kinematics::workpiece_link(kinematics_);
    return on == workpiece ? point : point_on_link(kinematics_, workpiece, on, joints_at(s), point);
  }

  /// Where another part is at `s`, in the frame of an obstacle.
  Placement body_at(double s, const MovingPart& part, const Obstacle& obstacle) const {
    const kinematics::Coordinates joints = joints_at(s);
    Placement place = link_pose(kinematics_, obstacle.on, joints).inverse() * link_pose(kinematics_, part.on, joints);
    place.translation() = place * part.shift - obstacle.shift;
    return place;
  }

 private:
  /// Whether all three linear joints move a part, as they move the tool.
  bool follows_linear_joints(const MovingPart& part) const {
    if (part.revolved || part.on == Link::Z) return true;
    return (part.on == Link::B || part.on == Link::C) && kinematics_.kind != kinematics::MachineKind::Table;
  }

  const kinematics::Coordinates& tip_at(double s) {
    if (s != tip_s_) {
      tip_ = stretch_.path.tip_at(kinematics_, s).value;
      tip_s_ = s;
    }
    return tip_;
  }
  kinematics::Coordinates joints_at(double s) const { return stretch_.path.joints_at(kinematics_, s).value; }

  const motion::Stretch& stretch_;
  const kinematics::Kinematics& kinematics_;
  double begin_;
  double end_;
  MotionBounds bounds_;
  double tip_s_ = std::numeric_limits<double>::quiet_NaN();
  kinematics::Coordinates tip_ = kinematics::Coordinates::Zero();
};

double highest(const solids::Cuboid& box, const Vec3& n) { return box.highest(n); }
double highest(const solids::Cylinder& cylinder, const Vec3& n) { return cylinder.solid().highest(n); }
double highest(const solids::Mesh& mesh, const Vec3& n) {
  return solids::Cuboid{mesh.bounds().min(), mesh.bounds().max()}.highest(n);
}

/// The largest value of n . p over a shape, of a mesh over the box around it.
double highest(const BodyShape& shape, const Vec3& n) {
  return with_solid(shape, [&](const auto& solid) { return highest(solid, n); });
}

double highest(const BodyShape& shape, const Placement& at, const Vec3& n) {
  return n.dot(at.translation()) + highest(shape, at.linear().transpose() * n);
}

double highest(const solids::RevolvedBody& body, const AxisPlacement& at, const Vec3& n) {
  double result = -std::numeric_limits<double>::infinity();
  for (const solids::BodyPiece& piece : body.pieces())
    result = std::max(result, solids::PlacedFrustum(piece.core, at).highest(n) + piece.rounding);
  return result;
}

/// A plane before an obstacle: n . p is at least `low` for all of its points.
struct SeparatingPlane {
  Vec3 n;
  double low = 0;
};

/// A pair in the course of the stretches.
struct PairCourse {
  const BodyPair* pair = nullptr;
  std::size_t index = 0;
  /// The travel of its group up to which it is proven to stay beyond its limit.
  double free_until = -std::numeric_limits<double>::infinity();
  std::optional<SeparatingPlane> plane;  ///< That has been between both last.
};

/// Pairs whose speeds have the same kind of bound.
struct PairGroup {
  BodyPair widest;                                         ///< Its speed bounds that of all.
  double travel = 0;                                       ///< Sum of that speed along the stretches so far, mm.
  double next = -std::numeric_limits<double>::infinity();  ///< Smallest `free_until`.
  std::vector<PairCourse> pairs;

  void forget() {
    next = -std::numeric_limits<double>::infinity();
    for (PairCourse& course : pairs) course.free_until = next;
  }
  bool takes(const BodyPair& pair) const {
    return (widest.reach_tip < BodyPair::kNever) == (pair.reach_tip < BodyPair::kNever) &&
           (widest.reach_axes > 0) == (pair.reach_axes > 0) && widest.shifts == pair.shifts &&
           widest.swings == pair.swings;
  }
};

class Examination {
 public:
  Examination(const BodyPairs& bodies, const kinematics::Kinematics& kinematics)
      : bodies_(bodies), kinematics_(kinematics) {
    for (std::size_t i = 0; i < bodies.pairs.size(); ++i) {
      const BodyPair& pair = bodies.pairs[i];
      const auto known =
          std::find_if(groups_.begin(), groups_.end(), [&](const PairGroup& group) { return group.takes(pair); });
      PairGroup& group = known == groups_.end() ? groups_.emplace_back() : *known;
      if (group.pairs.empty()) group.widest = pair;
      group.widest.reach_tip = std::max(group.widest.reach_tip, pair.reach_tip);
      group.widest.reach_axes = std::max(group.widest.reach_axes, pair.reach_axes);
      group.pairs.push_back({.pair = &pair, .index = i});
    }
  }

  void take(const motion::Stretch& stretch, std::size_t index) {
    StretchPlaces places(stretch, kinematics_);
    index_ = index;
    if (!places.is_in_reach()) {
      undecided();
      for (PairGroup& group : groups_) group.forget();
      return;
    }
    for (PairGroup& group : groups_) {
      const double before = group.travel;
      group.travel += group.widest.speed(places.bounds()) * places.length();
      if (group.travel <= group.next) continue;
      group.next = std::numeric_limits<double>::infinity();
      for (PairCourse& course : group.pairs) {
        // A bound that is not a number never lets a pair pass.
        if (!(group.travel <= course.free_until)) look_at(places, course, before, group.travel);
        group.next = std::min(group.next, course.free_until);
      }
    }
    std::sort(result_.encounters.begin() + static_cast<std::ptrdiff_t>(sorted_), result_.encounters.end(),
              [](const Encounter& a, const Encounter& b) { return a.pair < b.pair; });
    sorted_ = result_.encounters.size();
  }

  Examined result() { return std::move(result_); }

 private:
  void look_at(StretchPlaces& places, PairCourse& course, double before, double after) {
    const BodyPair& pair = *course.pair;
    const double rate = pair.speed(places.bounds());
    const double travel = rate * places.length();
    const auto distance = [&](double s, double sufficient) { return distance_of(places, pair, s, sufficient); };
    const bool shifts = places.is_shift(bodies_.parts[pair.part], bodies_.obstacles[pair.obstacle]);
    const auto is_beyond_plane = [&] {
      if (!course.plane) return false;
      const PlaneGap gap = plane_gap(places, pair, *course.plane);
      if (!(gap.smallest >= pair.limit)) return false;
      course.free_until = after + gap.at_end - pair.limit;
      return true;
    };
    if (shifts && is_beyond_plane()) return;
    constexpr double kAhead = 8;  // Stretches that one look shall do for.
    const Clearance begin = distance(places.begin(), pair.limit + kAhead * travel);
    if (begin.lower >= pair.limit + travel) {
      course.free_until = before + begin.lower - pair.limit;
      return;
    }
    if (shifts) {
      course.plane = plane_between(pair, begin);
      if (is_beyond_plane()) return;
    }
    const Clearance end = distance(places.end(), pair.limit + kAhead * travel);
    std::optional<Encounter> encounter;
    if (!is_nearest_at_an_end(places, pair, travel, begin, end)) encounter = search(places, course, rate, begin);
    // A motion that stops near an obstacle comes nearest to it there.
    if (pair.reports_near) take_ends(places, course, begin, end, encounter);
    // Where both rest in contact, each stretch belongs to it.
    const double margin = end.lower - pair.limit;
    if (encounter) {
      encounter->ends_apart = margin > 0;
      // To less than kApart so soon after a touch, both have not been apart.
      if (encounter->is_contact() && end.upper <= kApart && rate * (places.end() - last_) <= kNearTolerance)
        encounter->touches.back().to_end = true;
      result_.encounters.push_back(*std::move(encounter));
    }
    course.free_until = margin > 0 ? after + margin : -std::numeric_limits<double>::infinity();
  }

  Clearance distance_of(StretchPlaces& places, const BodyPair& pair, double s, double sufficient) const {
    const Obstacle& obstacle = bodies_.obstacles[pair.obstacle];
    const MovingPart& part = bodies_.parts[pair.part];
    // A search that ended early between bodies that overlap would not show how deep they do.
    const double enough = pair.allowed > 0 ? std::max(0.0, sufficient - pair.allowed) : sufficient;
    if (pair.revolved)
      return pair.counted(verification::distance_of(pair, obstacle, places.tool_at(s, part.offset, obstacle), enough));
    return verification::distance_of(part, obstacle, places.body_at(s, part, obstacle), sufficient);
  }

  /// Whether a tool that shifts along a straight line touches nothing on its way, and comes nowhere nearer than at an
  /// end, within the tolerance of near misses: all that it covers is one convex body for each of its pieces.
  bool is_nearest_at_an_end(StretchPlaces& places, const BodyPair& pair, double travel, const Clearance& begin,
                            const Clearance& end) const {
    const double nearest = std::min(begin.lower, end.lower);
    // A few steps take less time.
    constexpr double kFewSteps = 8;
    if (travel < kFewSteps * (pair.reports_near && nearest < pair.limit ? kNearTolerance : nearest)) return false;
    if (!pair.revolved || pair.allowed > 0 || !places.is_straight_shift() || !(nearest > kContactDistance))
      return false;
    const Obstacle& obstacle = bodies_.obstacles[pair.obstacle];
    const double offset = bodies_.parts[pair.part].offset;
    const solids::AxisPlacement from = places.tool_at(places.begin(), offset, obstacle);
    const Vec3 way = places.tool_at(places.end(), offset, obstacle).origin - from.origin;
    const double needed =
        pair.reports_near ? std::max(kContactDistance, std::min(pair.limit, nearest - kNearTolerance)) : pair.limit;
    return way_clearance_of(pair, obstacle, from, way, needed) >= needed;
  }

  /// Takes the ends of a stretch that are nearer than the limit.
  void take_ends(const StretchPlaces& places, const PairCourse& course, const Clearance& begin, const Clearance& end,
                 std::optional<Encounter>& encounter) const {
    const BodyPair& pair = *course.pair;
    if (!(std::min(begin.upper, end.upper) < pair.limit)) return;
    if (!encounter)
      encounter = {.stretch = index_, .pair = course.index, .distance = std::numeric_limits<double>::infinity()};
    take_nearest(places, pair, places.begin(), begin, *encounter);
    take_nearest(places, pair, places.end(), end, *encounter);
  }

  /// The gap between both bodies along one direction, which bounds their distance wherever it is not negative.
  struct PlaneGap {
    double at_end = 0;
    double smallest = 0;
  };

  /// The plane through the nearest point of an obstacle, or of the box around a mesh, across the shortest way between
  /// both bodies.
  std::optional<SeparatingPlane> plane_between(const BodyPair& pair, const Clearance& nearest) const {
    if (!(nearest.upper > 0 && std::isfinite(nearest.upper))) return {};
    const Vec3 between = nearest.on_obstacle - nearest.on_body;
    const double length = between.norm();
    if (!(length > 0)) return {};
    const Vec3 n = between / length;
    return SeparatingPlane{n, -highest(bodies_.obstacles[pair.obstacle].shape, -n)};
  }

  /// On a straight shift, the gap changes linearly; on another one as the path does.
  PlaneGap plane_gap(StretchPlaces& places, const BodyPair& pair, const SeparatingPlane& plane) const {
    const Obstacle& obstacle = bodies_.obstacles[pair.obstacle];
    const MovingPart& part = bodies_.parts[pair.part];
    const auto gap = [&](double s) {
      const double top = pair.revolved ? highest(*pair.revolved, places.tool_at(s, part.offset, obstacle), plane.n)
                                       : highest(part.body->shape, places.body_at(s, part, obstacle), plane.n);
      return plane.low - top - solids::kRounding;
    };
    if (places.is_straight_shift()) {
      const double at_end = gap(places.end());
      return {at_end, std::min(gap(places.begin()), at_end)};
    }
    const kinematics::Path& path = places.path();
    const auto along = [&](double s) { return plane.n.dot(path.at(s).value.head<3>()); };
    const double start = along(places.begin());
    const double at_begin = gap(places.begin());
    return {at_begin - (along(places.end()) - start),
            at_begin - (highest_along(path, plane.n, places.begin(), places.end()) - start)};
  }

  /// Looks for contacts and for the smallest distance.
  std::optional<Encounter> search(StretchPlaces& places, const PairCourse& course, double rate,
                                  const Clearance& begin) {
    const BodyPair& pair = *course.pair;
    const auto distance = [&](double s, double sufficient) { return distance_of(places, pair, s, sufficient); };
    const auto speed = [rate](double) { return rate; };
    const auto known_at_start = [&](double s, double sufficient) {
      return s == places.begin() ? begin : distance(s, sufficient);
    };
    solids::AdvanceOptions options{.contact = kContactDistance,
                                   .clearance = pair.reports_near ? pair.limit : 0,
                                   .tolerance = kNearTolerance,
                                   .max_evaluations = kMaxEvaluations};
    Encounter encounter{.stretch = index_, .pair = course.index, .distance = std::numeric_limits<double>::infinity()};
    double from = places.begin();
    for (;;) {
      const solids::AdvanceResult found = solids::first_contact(from, places.end(), known_at_start, speed, options);
      if (found.verdict == solids::AdvanceResult::Verdict::Contact) {
        solids::ContactSpan span = follow(places, found.s, distance, speed, rate);
        if (pair.core) look_with_care(places, pair, rate, span);
        // From less than kApart to a touch so soon, both have not been apart.
        const bool from_start =
            !encounter.is_contact() && begin.upper <= kApart && rate * (span.first - places.begin()) <= kNearTolerance;
        const bool lasts = encounter.is_contact() && !were_apart(last_, span.first, distance, rate);
        touch(places, pair, span, lasts, encounter);
        if (from_start) encounter.touches.back().from_start = true;
        last_ = span.last;
        if (!span.is_over || !(span.free > from)) break;
        from = span.free;
        continue;
      }
      if (pair.reports_near && found.nearest < pair.limit && found.nearest < encounter.distance)
        come_near(places, pair, found, encounter);
      if (found.verdict != solids::AdvanceResult::Verdict::Undecided) break;
      undecided();
      if (!(found.s < places.end())) break;
      // What comes after a piece that cannot be decided is examined all the same.
      from =
          std::min(places.end(), std::max(found.s + places.length() / kPieces, std::nextafter(found.s, places.end())));
      options.max_evaluations = std::max(options.max_evaluations - found.evaluations, kMaxEvaluations / kPieces);
    }
    return encounter.distance < std::numeric_limits<double>::infinity() ? std::optional(std::move(encounter))
                                                                        : std::nullopt;
  }

  /// Whether both bodies are apart somewhere between two touches.
  template <class Distance>
  static bool were_apart(double last, double first, Distance& distance, double rate) {
    constexpr int kLooks = 8;
    if (rate * (first - last) < 2 * (kApart - kContactDistance)) return false;
    for (int i = 1; i < kLooks; ++i)
      if (distance(last + (first - last) * i / kLooks, kApart).upper > kApart) return true;
    return false;
  }

  /// A contact that is deeper than the rest of the stretch is long does not end on it.
  template <class Distance, class Speed>
  solids::ContactSpan follow(const StretchPlaces& places, double first, Distance& distance, Speed& speed,
                             double rate) const {
    const Clearance begin = distance(first, solids::kExact);
    const double rest = rate * (places.end() - first);
    if (begin.depth() > rest) {
      const Clearance end = distance(places.end(), solids::kExact);
      solids::ContactSpan span{.first = first, .last = places.end(), .deepest_s = first, .deepest = begin};
      look_inside(span, end, rate, distance);
      if (span.deepest_s > first && span.deepest_s < span.last) refine_depth(span, 2 * kResolution / rate, distance);
      return span;
    }
    solids::ContactSpan span =
        solids::follow_contact(first, places.end(), distance, speed, kContactDistance, kResolution);
    refine_depth(span, (places.end() - first) / solids::kMaxContactSteps + kResolution / rate, distance);
    return span;
  }

  /// Finds the deepest place of a contact that lasts to the end, to within the resolution. Between two places the depth
  /// is at most what both have, and the way between them adds, on average.
  template <class Distance>
  static void look_inside(solids::ContactSpan& span, const Clearance& end, double rate, Distance& distance) {
    struct Interval {
      double from;
      double to;
      double depth_from;
      double depth_to;
      double bound;
    };
    constexpr int kLooks = 64;
    const auto between = [rate](double from, double depth_from, double to, double depth_to) {
      return Interval{from, to, depth_from, depth_to, (depth_from + depth_to + rate * (to - from)) / 2};
    };
    const auto take = [&span](double s, const Clearance& found) {
      if (!(found.upper < span.deepest.upper)) return;
      span.deepest = found;
      span.deepest_s = s;
    };
    std::vector<Interval> open = {between(span.first, span.deepest.depth(), span.last, end.depth())};
    take(span.last, end);
    for (int i = 0; i < kLooks; ++i) {
      const auto widest = std::max_element(open.begin(), open.end(),
                                           [](const Interval& a, const Interval& b) { return a.bound < b.bound; });
      if (!(widest->bound > span.deepest.depth() + kResolution)) return;
      const Interval each = *widest;
      const double middle = each.from + (each.to - each.from) / 2;
      const Clearance found = distance(middle, solids::kExact);
      take(middle, found);
      *widest = between(each.from, each.depth_from, middle, found.depth());
      open.push_back(between(middle, found.depth(), each.to, each.depth_to));
    }
  }

  /// Between two steps the depth may be larger: looks around the deepest one, where it nearly always has one maximum.
  template <class Distance>
  static void refine_depth(solids::ContactSpan& span, double step, Distance& distance) {
    constexpr int kRounds = 16;
    double from = std::max(span.first, span.deepest_s - step);
    double to = std::min(span.last, span.deepest_s + step);
    for (int i = 0; i < kRounds && from < to; ++i) {
      const double third = (to - from) / 3;
      const Clearance left = distance(from + third, solids::kExact);
      const Clearance right = distance(to - third, solids::kExact);
      const bool is_left = left.upper < right.upper;
      if (const Clearance& deeper = is_left ? left : right; deeper.upper < span.deepest.upper) {
        span.deepest = deeper;
        span.deepest_s = is_left ? from + third : to - third;
      }
      (is_left ? to : from) = is_left ? to - third : from + third;
    }
  }

  /// How deep a cutter is in the core of the target takes long to know with care: at the deepest place of a contact,
  /// and in some others if it is long.
  void look_with_care(StretchPlaces& places, const BodyPair& pair, double rate, solids::ContactSpan& span) const {
    constexpr double kFarApart = 2;  // mm
    constexpr double kMaxLooks = 8;
    const double offset = bodies_.parts[pair.part].offset;
    const auto look_at = [&](double s) {
      const Clearance found = deepest_of(pair, places.tool_at(s, offset, bodies_.obstacles[pair.obstacle]));
      if (!(found.upper < span.deepest.upper)) return;
      span.deepest = found;
      span.deepest_s = s;
    };
    look_at(span.deepest_s);
    const double length = span.last - span.first;
    const int looks = static_cast<int>(std::min(kMaxLooks, rate * length / kFarApart));
    for (int i = 1; i <= looks; ++i) look_at(span.first + length * i / (looks + 1));
    if (looks == 0) return;
    const double step = length / (looks + 1) / 3;
    for (const double s : {span.deepest_s - step, span.deepest_s + step}) look_at(std::clamp(s, span.first, span.last));
  }

  /// `lasts`: the touch before goes on.
  void touch(const StretchPlaces& places, const BodyPair& pair, const solids::ContactSpan& span, bool lasts,
             Encounter& encounter) const {
    const Obstacle& obstacle = bodies_.obstacles[pair.obstacle];
    if (!lasts)
      encounter.touches.push_back(
          {.first = places.time_at(span.first), .distance = std::numeric_limits<double>::infinity()});
    Touch& touch = encounter.touches.back();
    touch.last = places.time_at(span.last);
    touch.to_end = !span.is_over;
    if (const double nearest = span.deepest.upper - pair.slack; nearest < touch.distance) {
      touch.distance = nearest;
      touch.deepest_time = places.time_at(span.deepest_s);
      touch.point = places.on_workpiece(span.deepest_s, span.deepest.on_obstacle + obstacle.shift, obstacle.on);
    }
    take_nearest(places, pair, span.deepest_s, span.deepest, encounter);
  }

  void come_near(const StretchPlaces& places, const BodyPair& pair, const solids::AdvanceResult& found,
                 Encounter& encounter) const {
    take_nearest(places, pair, found.nearest_s, found.clearance, encounter);
  }

  void take_nearest(const StretchPlaces& places, const BodyPair& pair, double s, const Clearance& clearance,
                    Encounter& encounter) const {
    const Obstacle& obstacle = bodies_.obstacles[pair.obstacle];
    const double nearest = clearance.upper - pair.slack;
    if (!(nearest < encounter.distance - solids::kRounding)) return;
    encounter.distance = nearest;
    encounter.nearest_time = places.time_at(s);
    encounter.point = places.on_workpiece(s, clearance.on_obstacle + obstacle.shift, obstacle.on);
  }

  void undecided() {
    if (result_.undecided.empty() || result_.undecided.back() != index_) result_.undecided.push_back(index_);
  }

  const BodyPairs& bodies_;
  const kinematics::Kinematics& kinematics_;
  std::vector<PairGroup> groups_;
  Examined result_;
  std::size_t index_ = 0;
  std::size_t sorted_ = 0;
  double last_ = 0;  ///< Parameter up to which the last touch has lasted.
};

}  // namespace

Examined examine(std::span<const motion::Stretch> stretches, const BodyPairs& bodies,
                 const kinematics::Kinematics& kinematics) {
  Examination examination(bodies, kinematics);
  for (std::size_t i = 0; i < stretches.size(); ++i) examination.take(stretches[i], i);
  return examination.result();
}

}  // namespace isocnc::verification
