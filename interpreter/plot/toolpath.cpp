#include "interpreter/plot/toolpath.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace isocnc::plot {

using geometry::Pose;
using geometry::Vec3;

/// Maximum number of points left out in a row; checking them again costs time. They include the middles of the
/// planner's pieces, so that the path is also accurate between the ends.
static constexpr std::size_t kMaxSkipped = 64;
/// Maximum turn of a part of a curve, also of B and C, degrees; its middle then shows how far it bends.
static constexpr double kPartDeg = 10;
/// Maximum number of halvings of such a part.
static constexpr int kMaxHalvings = 10;
static constexpr int kMaxParts = 1'000;

Toolpath::Toolpath(const timing::TimedMachine& machine, const Pose& home,
                   std::function<void(const ToolpathStep&)> on_step)
    : machine_(machine), on_step_(std::move(on_step)), points_{{.pose = home}} {
  tolerance_.across = machine.motion.chord_tolerance;
}

static Pose between(const Pose& a, const Pose& b, double part) {
  return {a.tip + part * (b.tip - a.tip), a.b + part * (b.b - a.b), a.c + part * (b.c - a.c)};
}

/// The part of the path covered after a part of the time.
static double way(double part, double speed0, double speed1) {
  const double sum = speed0 + speed1;
  return sum > 0 ? part * (2 * speed0 + part * (speed1 - speed0)) / sum : part;
}

static double turned(const Pose& a, const Pose& b) { return std::max(std::abs(a.b - b.b), std::abs(a.c - b.c)); }

static double distance_from_line(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 line = to - from;
  const double square = line.squaredNorm();
  const double part = square > 0 ? std::clamp((point - from).dot(line) / square, 0.0, 1.0) : 0;
  return (from + part * line - point).norm();
}

/// Whether a motion at a constant acceleration fits the speeds at its ends.
static bool fits_speeds(const ToolpathPoint& from, const ToolpathPoint& to, double tolerance) {
  const double length = (to.pose.tip - from.pose.tip).norm();
  const double turn = std::hypot(to.pose.b - from.pose.b, to.pose.c - from.pose.c);
  return std::abs((from.speed + to.speed) / 2 * (to.time - from.time) - (length > 0 ? length : turn)) <= tolerance;
}

/// Whether the straight path passes `point`, in position and time.
bool Toolpath::leads_by(const ToolpathPoint& point, const ToolpathPoint& from, const ToolpathPoint& to) const {
  const double part = (point.time - from.time) / (to.time - from.time);
  const Pose expected = between(from.pose, to.pose, way(part, from.speed, to.speed));
  return turned(expected, point.pose) <= tolerance_.turned &&
         (expected.tip - point.pose.tip).norm() <= tolerance_.along / 2 &&
         distance_from_line(point.pose.tip, from.pose.tip, to.pose.tip) <= tolerance_.across / 2;
}

/// Whether all skipped points may be left out.
bool Toolpath::may_skip_to(const ToolpathPoint& point) const {
  const ToolpathPoint& from = points_.back();
  return fits_speeds(from, point, tolerance_.along / 2) &&
         std::all_of(skipped_.begin(), skipped_.end(),
                     [&](const ToolpathPoint& skipped) { return leads_by(skipped, from, point); });
}

void Toolpath::go_to(const ToolpathPoint& point) {
  if (!skipped_.empty() && (skipped_.size() >= kMaxSkipped || !may_skip_to(point))) keep_last();
  skipped_.push_back(point);
}

void Toolpath::keep_last() {
  if (skipped_.empty()) return;
  points_.push_back(skipped_.back());
  skipped_.clear();
}

/// Speed of the tip, or of B and C if it rests.
static double speed_along(const kinematics::Coordinates& slope) {
  const double linear = slope.head<3>().norm();
  return linear > 0 ? linear : slope.tail<2>().norm();
}

ToolpathPoint Toolpath::point_at(const kinematics::Path& path, const motion::Phase& phase, double start,
                                 double time) const {
  const motion::Phase now = phase.after(time);
  const kinematics::Jet jet = path.tip_at(machine_.motion.kinematics, now.from);
  return {kinematics::pose(jet.value), start + time, std::max(0.0, now.speed) * speed_along(jet.first)};
}

static bool is_straight(const kinematics::Path& path) {
  return path.kind == kinematics::PathKind::Polynomial && !path.is_of_joints && path.c[2].isZero(0) &&
         path.c[3].isZero(0);
}

/// Adds the curve from a point already added to a later one.
void Toolpath::add_curve(const kinematics::Path& path, const motion::Phase& phase, double start, double from, double to,
                         int depth) {
  const ToolpathPoint begin = point_at(path, phase, start, from);
  const ToolpathPoint end = point_at(path, phase, start, to);
  const ToolpathPoint middle = point_at(path, phase, start, (from + to) / 2);
  if (depth == 0 || leads_by(middle, begin, end)) {
    go_to(middle);
    return go_to(end);
  }
  add_curve(path, phase, start, from, (from + to) / 2, depth - 1);
  add_curve(path, phase, start, (from + to) / 2, to, depth - 1);
}

/// Angle of the circle, degrees.
static double turn_of_circle(const kinematics::Path& path, const motion::Phase& phase) {
  if (path.kind != kinematics::PathKind::Circle) return 0;
  return std::abs(path.omega) * (phase.after(phase.duration).from - phase.from) * 180 / std::numbers::pi;
}

void Toolpath::add(const motion::Stretch& stretch) {
  double start = stretch.start;
  if (points_.size() == 1 && skipped_.empty()) {
    points_.front().time = start;
    points_.front().speed = point_at(stretch.path, stretch.phases[0], start, 0).speed;
  }
  for (int i = 0; i < stretch.phase_count; ++i) {
    const motion::Phase& phase = stretch.phases[static_cast<std::size_t>(i)];
    if (is_straight(stretch.path) && phase.jerk == 0) {
      go_to(point_at(stretch.path, phase, start, phase.duration / 2));
      go_to(point_at(stretch.path, phase, start, phase.duration));
    } else {
      const double turn = std::max(turned(point_at(stretch.path, phase, start, 0).pose,
                                          point_at(stretch.path, phase, start, phase.duration).pose),
                                   turn_of_circle(stretch.path, phase));
      const int parts = kinematics::part_count(turn / kPartDeg, kMaxParts);
      for (int part = 0; part < parts; ++part)
        add_curve(stretch.path, phase, start, phase.duration * part / parts, phase.duration * (part + 1) / parts,
                  kMaxHalvings);
    }
    start += phase.duration;
  }
}

static StepKind kind_of(execution::MoveKind kind) {
  static constexpr StepKind kKinds[] = {StepKind::Rapid, StepKind::Feed, StepKind::Arc};
  return kKinds[static_cast<std::size_t>(kind)];
}

void Toolpath::add(const timing::TimedEvent& timed) {
  geometry::Pose end = points_.front().pose;
  if (const auto* const tool = std::get_if<running::ToolEvent>(&timed.event.what)) end = mount(tool->tool);
  if (const auto* const frame = std::get_if<running::FrameEvent>(&timed.event.what))
    add_frame(*frame, timed.event.line);
  if (const auto* const move = std::get_if<running::MoveEvent>(&timed.event.what))
    return add_step(timed, kind_of(move->kind), running::feed_of(*move));
  if (timed.duration > 0) {
    points_.front().time = timed.start;
    points_.front().speed = 0;
    const ToolpathPoint still = {.pose = points_.front().pose, .time = timed.start + timed.duration};
    go_to(still);
    keep_last();
    if (!(end == still.pose)) go_to({.pose = end, .time = still.time});
    add_step(timed, StepKind::Wait, 0);
  }
  points_.front().pose = end;
}

/// Ends a step with the points since the last one.
void Toolpath::add_step(const timing::TimedEvent& timed, StepKind kind, double feed) {
  keep_last();
  if (points_.size() == 1) points_.front().time = timed.start;
  on_step_({.line = timed.event.line, .kind = kind, .tool = tool_, .feed = feed, .points = points_});
  points_ = {points_.back()};
}

/// Mounts a tool while the joints stand still, and returns the new position of the tip.
Pose Toolpath::mount(execution::ToolCode tool) {
  const kinematics::Kinematics& kinematics = machine_.motion.kinematics;
  const kinematics::Coordinates joints = kinematics::inverse(kinematics, kinematics::coordinates(points_.front().pose),
                                                             std::exchange(tool_length_, machine_.tool_length(tool)));
  const auto known = std::find(tools_.begin(), tools_.end(), tool);
  tool_ = static_cast<std::size_t>(known - tools_.begin());
  if (known == tools_.end()) tools_.emplace_back(tool);
  return kinematics::pose(kinematics::forward(kinematics, joints, tool_length_));
}

void Toolpath::add_frame(const running::FrameEvent& event, std::size_t line) {
  const geometry::Frame& frame = event.in_force;
  const bool is_known =
      std::any_of(frames_.begin(), frames_.end(), [&](const ToolpathFrame& known) { return known.frame == frame; });
  if (!is_known && frames_.size() < kMaxFrames) frames_.push_back({frame, line});
}

}  // namespace isocnc::plot
