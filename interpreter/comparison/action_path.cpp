#include "interpreter/comparison/action_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace isocnc::comparison {

using geometry::Pose;
using geometry::Vec3;

static constexpr double kFullTurn = 2 * std::numbers::pi;
/// Maximum number of chords of a motion.
static constexpr double kMaxChords = 4096;
/// Maximum number of distances between a point and a line, from one chain to another one.
static constexpr std::size_t kMaxDistances = 20'000'000;

/// Search for the nearest place of a rapid whose joints move independently: places on a grid, then steps between two.
static constexpr int kLooks = 64;
static constexpr int kNarrowings = 40;

static double between(double from, double to, double part) { return from + part * (to - from); }

ActionPath::ActionPath(const RecordedRun& run, const MachineAction& motion)
    : run_(run), motion_(motion), is_arc_(motion.arc != MachineAction::kNone) {
  if (motion.is_by_joints) {
    if (motion.tool != MachineAction::kNone) tool_length_ = run.tools[motion.tool].length;
    const kinematics::Move rapid{
        .from = motion.from, .to = motion.to, .controls_tool_point = false, .tool_length = tool_length_};
    from_joints_ = kinematics::inverse(kinematics(), kinematics::coordinates(motion.from), tool_length_);
    along_joints_ = kinematics::inverse(kinematics(), kinematics::coordinates(motion.to), tool_length_) - from_joints_;
    if (kinematics::moves_independently(run.machine, rapid)) parts_ = kinematics::independent_rapid(run.machine, rapid);
  }
  if (!is_arc_) return;
  const ActionArc& arc = run.arcs[motion.arc];
  helix_ = geometry::helix(motion.from.tip, motion.to.tip, arc.center, arc.normal, arc.sweep_deg);
}

kinematics::Coordinates ActionPath::joints(double part) const {
  if (parts_.empty()) return from_joints_ + part * along_joints_;
  double left = 0;
  for (const kinematics::RapidPart& each : parts_) left += part * each.length;
  std::size_t i = 0;
  while (i + 1 < parts_.size() && left > parts_[i].length) left -= parts_[i++].length;
  return parts_[i].path.joints_at(kinematics(), std::min(left, parts_[i].length)).value;
}

double ActionPath::nearest_in_joints(const kinematics::Coordinates& there, double from_part) const {
  const auto distance = [&](double part) { return (joints(part) - there).squaredNorm(); };
  const double step = (1 - from_part) / kLooks;
  double best = from_part;
  for (int i = 1; i <= kLooks; ++i)
    if (distance(from_part + i * step) < distance(best)) best = from_part + i * step;
  double low = std::max(from_part, best - step);
  double high = std::min(1.0, best + step);
  for (int i = 0; i < kNarrowings; ++i) {
    const double third = (high - low) / 3;
    if (distance(low + third) > distance(high - third)) {
      low += third;
    } else {
      high -= third;
    }
  }
  return (low + high) / 2;
}

Pose ActionPath::at(double part) const {
  if (motion_.is_by_joints) return kinematics::pose(kinematics::forward(kinematics(), joints(part), tool_length_));
  Pose pose{motion_.from.tip + part * (motion_.to.tip - motion_.from.tip), between(motion_.from.b, motion_.to.b, part),
            between(motion_.from.c, motion_.to.c, part)};
  if (!is_arc_) return pose;
  const double angle = part * helix_.sweep;
  pose.tip = helix_.center + std::cos(angle) * helix_.out + std::sin(angle) * helix_.side + part * helix_.rise;
  return pose;
}

std::optional<double> ActionPath::nearest(const Pose& pose, double from_part) const {
  const Vec3& point = pose.tip;
  if (motion_.is_by_joints) {
    const kinematics::Coordinates there =
        kinematics::inverse(kinematics(), kinematics::coordinates(pose), tool_length_);
    if (!parts_.empty()) return nearest_in_joints(there, from_part);
    return std::clamp(along_joints_.dot(there - from_joints_) / along_joints_.squaredNorm(), from_part, 1.0);
  }
  if (!is_arc_) {
    const Vec3 along = motion_.to.tip - motion_.from.tip;
    const double square = along.squaredNorm();
    if (!(square > 0)) return std::nullopt;
    return std::clamp(along.dot(point - motion_.from.tip) / square, from_part, 1.0);
  }
  // The angle depends on the rise alone where the arc's ends are not equally far from its center; a second look settles
  // it.
  double part = from_part;
  for (int look = 0; look < 2; ++look) {
    const Vec3 there = point - helix_.center - part * helix_.rise;
    double angle = std::atan2(there.dot(helix_.side), there.dot(helix_.out));
    const double middle = from_part * helix_.sweep;
    // The first turn that is not more than a bit before the place from which on it counts.
    while (angle < middle - std::numbers::pi / 2) angle += kFullTurn;
    part = std::clamp(angle / helix_.sweep, from_part, 1.0);
  }
  return part;
}

double ActionPath::length() const {
  if (is_arc_) return std::hypot(helix_.sweep * helix_.out.norm(), helix_.rise.norm());
  return (motion_.to.tip - motion_.from.tip).norm();
}

std::vector<Vec3> chain_of(const RecordedRun& run, std::span<const MachineAction> actions, double deviation) {
  std::vector<Vec3> chain;
  for (const MachineAction& action : actions) {
    if (!action.is_motion()) continue;
    if (chain.empty()) chain.push_back(action.from.tip);
    const ActionPath path(run, action);
    double chords = 1;
    if (action.arc != MachineAction::kNone) {
      const ActionArc& arc = run.arcs[action.arc];
      const double radius = (action.from.tip - arc.center).norm();
      const double step = 2 * std::acos(std::max(0.5, 1 - deviation / std::max(radius, deviation)));
      chords = std::abs(arc.sweep_deg) / 360 * kFullTurn / step;
    } else if (action.is_by_joints) {
      chords = 256;
    }
    const int count = static_cast<int>(std::clamp(std::ceil(chords), 1.0, kMaxChords));
    for (int i = 1; i < count; ++i) chain.push_back(path.at(static_cast<double>(i) / count).tip);
    chain.push_back(action.to.tip);
  }
  return chain;
}

namespace {

/// Finds how far the points of a chain are at most from another chain.
class FarthestPoint {
 public:
  FarthestPoint(std::span<const Vec3> other, double accuracy, std::size_t& left)
      : other_(other), accuracy_(accuracy), left_(left) {}

  bool look_at(std::span<const Vec3> chain) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      if (!look_at(chain[i], chain[i + 1])) return false;
    return true;
  }
  double farthest() const { return farthest_; }

 private:
  struct ChainPart {
    Vec3 from;
    Vec3 to;
  };

  static double square_of(const Vec3& point, const Vec3& from, const Vec3& along, double length) {
    const Vec3 there = point - from;
    const double part = length > 0 ? std::clamp(along.dot(there) / length, 0.0, 1.0) : 0;
    return (there - part * along).squaredNorm();
  }

  /// How far both ends of a part are from the chain, and how far any of its points can be: the distance from one line
  /// is greatest at an end.
  struct Distances {
    double from = std::numeric_limits<double>::infinity();
    double to = std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
  };
  Distances distances(const ChainPart& part) {
    Distances squares;
    for (std::size_t i = 0; i + 1 < other_.size(); ++i) {
      const Vec3 along = other_[i + 1] - other_[i];
      const double length = along.squaredNorm();
      const double from = square_of(part.from, other_[i], along, length);
      const double to = square_of(part.to, other_[i], along, length);
      squares.from = std::min(squares.from, from);
      squares.to = std::min(squares.to, to);
      squares.maximum = std::min(squares.maximum, std::max(from, to));
    }
    left_ -= std::min(left_, other_.size());
    return {std::sqrt(squares.from), std::sqrt(squares.to), std::sqrt(squares.maximum)};
  }

  /// Divides a part until it can hold no point that is farther.
  bool look_at(const Vec3& from, const Vec3& to) {
    parts_.assign(1, {from, to});
    while (!parts_.empty()) {
      const ChainPart part = parts_.back();
      parts_.pop_back();
      const Distances far = distances(part);
      farthest_ = std::max({farthest_, far.from, far.to});
      if (left_ == 0) return false;
      // The distance changes at most as fast as the point, too.
      const double by_length = (far.from + far.to + (part.to - part.from).norm()) / 2;
      if (std::min(far.maximum, by_length) <= farthest_ + accuracy_) continue;
      const Vec3 middle = (part.from + part.to) / 2;
      parts_.push_back({part.from, middle});
      parts_.push_back({middle, part.to});
    }
    return true;
  }

  std::span<const Vec3> other_;
  double accuracy_;
  double farthest_ = 0;
  std::size_t& left_;  ///< How many distances may be computed.
  std::vector<ChainPart> parts_;
};

}  // namespace

std::optional<double> distance_from(std::span<const Vec3> chain, std::span<const Vec3> other, double accuracy,
                                    std::size_t* left) {
  if (chain.empty() || other.empty()) return std::nullopt;
  const std::size_t allowed = std::min(kMaxDistances, left == nullptr ? kMaxDistances : *left);
  std::size_t rest = allowed;
  FarthestPoint farthest(other, accuracy, rest);
  const bool is_known = farthest.look_at(chain);
  if (left != nullptr) *left -= allowed - rest;
  return is_known ? std::optional(farthest.farthest()) : std::nullopt;
}

std::optional<double> distance_of(std::span<const Vec3> a, std::span<const Vec3> b, double accuracy,
                                  std::size_t* left) {
  const std::optional<double> from_a = distance_from(a, b, accuracy, left);
  const std::optional<double> from_b = from_a ? distance_from(b, a, accuracy, left) : std::nullopt;
  if (!from_b) return std::nullopt;
  return std::max(*from_a, *from_b);
}

namespace {

/// How far B and C of a pose are from those of the nearest place on a path, and how far that is.
struct NearestTurn {
  double distance = std::numeric_limits<double>::infinity();  ///< mm.
  double degrees = std::numeric_limits<double>::infinity();
};

NearestTurn nearest_turn(const Pose& pose, const MachineAction& motion) {
  const Vec3 along = motion.to.tip - motion.from.tip;
  const Eigen::Vector2d turn{motion.to.b - motion.from.b, motion.to.c - motion.from.c};
  const Eigen::Vector2d from_start{pose.b - motion.from.b, pose.c - motion.from.c};
  const bool goes = !along.isZero(0);
  const double square = goes ? along.squaredNorm() : turn.squaredNorm();
  const double ahead = goes ? along.dot(pose.tip - motion.from.tip) : turn.dot(from_start);
  const double part = square > 0 ? std::clamp(ahead / square, 0.0, 1.0) : 0;
  return {(motion.from.tip + part * along - pose.tip).norm(), (from_start - part * turn).cwiseAbs().maxCoeff()};
}

double turn_from(std::span<const MachineAction> motions, std::span<const MachineAction> others, const Vec3& shift) {
  constexpr double kAsNear = 0.001;  // mm. The place where a path turns belongs to several motions.
  double farthest = 0;
  for (const MachineAction& motion : motions) {
    if (!motion.is_motion()) continue;
    for (Pose pose : {motion.from, motion.to}) {
      pose.tip += shift;
      NearestTurn nearest;
      for (const MachineAction& other : others) {
        if (!other.is_motion()) continue;
        const NearestTurn next = nearest_turn(pose, other);
        if (next.distance > nearest.distance + kAsNear) continue;
        const bool is_nearer = next.distance < nearest.distance - kAsNear;
        nearest.degrees = is_nearer ? next.degrees : std::min(nearest.degrees, next.degrees);
        nearest.distance = std::min(nearest.distance, next.distance);
      }
      if (nearest.degrees < std::numeric_limits<double>::infinity()) farthest = std::max(farthest, nearest.degrees);
    }
  }
  return farthest;
}

}  // namespace

std::optional<double> turn_between(std::span<const MachineAction> a, std::span<const MachineAction> b,
                                   const Vec3& shift, std::size_t* left) {
  const std::size_t wanted = 4 * a.size() * b.size();
  if (wanted > std::min(kMaxDistances, left == nullptr ? kMaxDistances : *left)) return std::nullopt;
  if (left != nullptr) *left -= wanted;
  return std::max(turn_from(a, b, shift), turn_from(b, a, -shift));
}

namespace {

/// A part of a line, from 0 to 1.
struct LinePart {
  double from = 1;
  double to = 0;

  bool is_empty() const { return from > to; }
};

/// The part of a line that is at most `distance` from a point.
LinePart near_part(const Vec3& point, const Vec3& from, const Vec3& to, double distance) {
  const Vec3 along = to - from;
  const Vec3 there = point - from;
  const double square = along.squaredNorm();
  if (!(square > 0)) return there.norm() <= distance ? LinePart{0, 1} : LinePart{};
  const double middle = along.dot(there) / square;
  const double rest = distance * distance - (there - middle * along).squaredNorm();
  if (rest < 0) return {};
  const double half = std::sqrt(rest / square);
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

/// The part of a line that is reached from its neighbors: from the line across all of it, from the one before it what
/// lies ahead.
LinePart reached(const LinePart& near, const LinePart& across, const LinePart& before) {
  if (near.is_empty() || (across.is_empty() && before.is_empty())) return {};
  return across.is_empty() ? LinePart{std::max(before.from, near.from), near.to} : near;
}

}  // namespace

bool goes_along(std::span<const Vec3> a, std::span<const Vec3> b, double distance) {
  if (a.size() < 2 || b.size() < 2) return false;
  if ((a.front() - b.front()).norm() > distance || (a.back() - b.back()).norm() > distance) return false;
  // Of each line of b what can be reached while a stands at the present point; at the first one nothing yet.
  std::vector<LinePart> of_b(b.size() - 1);
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    // Of the line of a what can be reached while b stands at the present point; at its first one, the start of a alone:
    // while one of them stands at its start, the other one passes through the corners between its lines.
    LinePart of_a = i == 0 ? LinePart{0, 0} : LinePart{};
    for (std::size_t k = 0; k + 1 < b.size(); ++k) {
      const LinePart before = of_b[k];
      of_b[k] = reached(near_part(a[i + 1], b[k], b[k + 1], distance), of_a, before);
      of_a = reached(near_part(b[k + 1], a[i], a[i + 1], distance), before, of_a);
    }
  }
  return !of_b.back().is_empty() && of_b.back().to == 1;
}

}  // namespace isocnc::comparison
