#include "interpreter/kinematics/travel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "interpreter/geometry/cubic.h"
#include "interpreter/geometry/helix.h"
#include "interpreter/kinematics/element.h"
#include "interpreter/kinematics/independent_rapid.h"

namespace isocnc::kinematics {

using geometry::Range;
using geometry::Vec3;

/// Distance of grid points between which a joint has at most one peak, radians of B, C and the arc together.
static constexpr double kGridTurn = 3 * std::numbers::pi / 180;
/// Search for a peak: maximum number of steps, and the part of the path that is narrow enough.
static constexpr int kPeakSteps = 60;
static constexpr double kPeakWidth = 1e-12;
/// Maximum number of grid points. Rotary axes do not turn far enough in one move to need more.
static constexpr int kMaxGridPoints = 10'000;

/// Minimum number of grid points of a part of a rapid that turns, on which the joints are polynomials.
static constexpr int kPolynomialGrid = 8;

/// A place on a path, and its derivative by the path parameter.
template <typename Vector>
struct ValueAndSlope {
  Vector value;
  Vector slope;
};

/// The path of a move, or of a part of a rapid, as a function of the part of it that is traveled, 0 to 1.
class MovePath {
 public:
  MovePath(const Machine& machine, const RapidPart& part)
      : machine_(machine), path_{part.path, part.length}, minimum_grid_(kPolynomialGrid) {
    turned_.tail<2>() = (part.path.at(part.length).value - part.path.at(0).value).tail<2>();
  }
  MovePath(const Machine& machine, const Move& move)
      : machine_(machine),
        path_(move.is_arc ? programmed_circle(move) : programmed_line(machine, move, move.from, move.to)) {
    turned_[kB] = move.to.b - move.from.b;
    turned_[kC] = move.to.c - move.from.c;
  }

  Coordinates joints(double part) const {
    Coordinates there = path_.path.at(part * path_.length).value;
    if (is_arc()) there += part * turned_;
    return path().is_of_joints ? there : inverse(machine_.kinematics, there, path().tool_length);
  }
  /// Position and slope of the joints, which takes several times as long.
  ValueAndSlope<Coordinates> joints_place(double part) const {
    Jet there = path_.path.at(part * path_.length);
    if (is_arc()) there.value += part * turned_;
    if (is_arc() && path_.length > 0) there.first += turned_ / path_.length;
    if (!path().is_of_joints) there = inverse(machine_.kinematics, there, path().tool_length);
    return {there.value, there.first};
  }
  /// Position and slope of the tip.
  ValueAndSlope<Vec3> tip_place(double part) const {
    const Jet there = path().tip_at(machine_.kinematics, part * path_.length);
    return {there.value.head<3>(), there.first.head<3>()};
  }

  Vec3 tip(double part) const { return tip_place(part).value; }
  /// Returns the speed of the tip if the whole path takes one second, mm/s.
  double tip_speed(double part) const { return path_.length * tip_place(part).slope.norm(); }

  const Path& path() const { return path_.path; }
  bool is_arc() const { return path().kind == PathKind::Circle; }
  /// Whether B or C turn the tool or the workpiece.
  bool turns() const { return turned_.squaredNorm() > 0 && machine_.kinematics.kind != MachineKind::ThreeAxis; }
  bool has_straight_joints() const { return !is_arc() && (path().is_of_joints || !turns()); }
  /// Of a part of a rapid.
  bool has_straight_tip() const { return !turns() && path().c[2].isZero(0) && path().c[3].isZero(0); }

  /// Returns the number of parts of a grid that is fine enough to have at most one peak between neighboring points.
  int grid() const {
    const double turn = std::abs(path().omega) * path_.length + turned_.cwiseAbs().sum() * std::numbers::pi / 180;
    return std::max(minimum_grid_, part_count(turn / kGridTurn, kMaxGridPoints));
  }

 private:
  const Machine& machine_;
  ProgrammedPath path_;
  Coordinates turned_ = Coordinates::Zero();
  int minimum_grid_ = 2;
};

/// Returns the values of `at` at the points of a grid from 0 to 1.
template <typename At>
static auto on_grid(int count, At&& at) {
  std::vector<decltype(at(0.0))> grid;
  for (int i = 0; i <= count; ++i) grid.push_back(at(static_cast<double>(i) / count));
  return grid;
}

/// Returns the part of the path between two others at which a coordinate's slope is 0. `low_slope` and `high_slope` are
/// the slopes there, of which the first is positive and the second negative. False position: the slope of the end that
/// stays is halved, or else that end would stay for ever.
template <typename Slope>
static double level_between(Slope&& slope, double low, double low_slope, double high, double high_slope) {
  for (int i = 0; i < kPeakSteps && high - low > kPeakWidth; ++i) {
    const double part = low + (high - low) * low_slope / (low_slope - high_slope);
    const double found = slope(part);
    if (found == 0) return part;
    if (found > 0) {
      low = part;
      low_slope = found;
      high_slope /= 2;
    } else {
      high = part;
      high_slope = found;
      low_slope /= 2;
    }
  }
  return (low + high) / 2;
}

/// Returns the part of the path at which a coordinate is farthest in the direction of `sign`: next to one of the grid's
/// peaks, or at an end of the path.
template <typename At, typename Point>
static double farthest(At&& at, const std::vector<Point>& grid, int axis, double sign) {
  const std::size_t last = grid.size() - 1;
  const auto part = [&](std::size_t i) { return static_cast<double>(i) / static_cast<double>(last); };
  const auto value = [&](std::size_t i) { return sign * grid[i].value[axis]; };
  const auto slope = [&](std::size_t i) { return sign * grid[i].slope[axis]; };
  double best = 0;
  double best_value = value(0);
  const auto consider = [&](double candidate, double reached) {
    if (reached > best_value) best = candidate;
    best_value = std::max(best_value, reached);
  };
  consider(1, value(last));
  for (std::size_t i = 0; i <= last; ++i) {
    const bool is_peak = (i == 0 || value(i - 1) <= value(i)) && (i == last || value(i + 1) <= value(i));
    if (!is_peak) continue;
    consider(part(i), value(i));
    // The peak is on the side to which the coordinate still rises.
    if (slope(i) == 0 || (i == 0 && slope(i) < 0) || (i == last && slope(i) > 0)) continue;
    const std::size_t low = slope(i) > 0 ? i : i - 1;
    if (!(slope(low) > 0 && slope(low + 1) < 0)) continue;
    const double found = level_between([&](double there) { return sign * at(there).slope[axis]; }, part(low),
                                       slope(low), part(low + 1), slope(low + 1));
    consider(found, sign * at(found).value[axis]);
  }
  return best;
}

/// Returns the joints that leave their range. `find(axis, sign)` returns the place where a joint is farthest in that
/// direction.
template <typename Find>
static std::vector<Overtravel> beyond(const Machine& machine, const MovePath& path, Find&& find) {
  std::vector<Overtravel> found;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const AxisLimits& limits = machine.axes[static_cast<std::size_t>(axis)];
    for (const double sign : {-1.0, 1.0}) {
      const double limit = sign < 0 ? limits.minimum : limits.maximum;
      if (std::isinf(limit)) continue;
      const double part = find(axis, sign);
      const double position = path.joints(part)[axis];
      if (sign * (position - limit) > kTravelSlack)
        found.push_back({static_cast<MachineAxis>(axis), part, position, limit});
    }
  }
  return found;
}

std::vector<Overtravel> overtravels(const Machine& machine, const Move& move) {
  const MovePath path(machine, move);
  if (path.has_straight_joints()) {
    const Coordinates change = path.joints(1) - path.joints(0);
    return beyond(machine, path, [&](int axis, double sign) { return sign * change[axis] > 0 ? 1.0 : 0.0; });
  }
  const auto at = [&](double part) { return path.joints_place(part); };
  const std::vector<ValueAndSlope<Coordinates>> grid = on_grid(path.grid(), at);
  return beyond(machine, path, [&](int axis, double sign) { return farthest(at, grid, axis, sign); });
}

/// Integrates the tip's speed by Simpson's rule. The speed is smooth except where the tip reverses on a path of joints.
static double integrated_length(const MovePath& path) {
  constexpr int kPanelsPerPoint = 4;
  const int panels = std::max(64, kPanelsPerPoint * path.grid());
  double sum = path.tip_speed(0) + path.tip_speed(1);
  for (int i = 1; i < panels; ++i) sum += (i % 2 == 1 ? 4 : 2) * path.tip_speed(static_cast<double>(i) / panels);
  return sum / (3 * panels);
}

static std::array<Range, 3> extents(const Vec3& from, const Vec3& to) {
  const Vec3 low = from.cwiseMin(to);
  const Vec3 high = from.cwiseMax(to);
  return {Range{low.x(), high.x()}, Range{low.y(), high.y()}, Range{low.z(), high.z()}};
}

static geometry::Helix helix_of(const Move& arc) {
  return geometry::helix(arc.from.tip, arc.to.tip, arc.center, arc.normal, arc.sweep_deg);
}

static std::array<Range, 3> arc_extents(const geometry::Helix& helix, const geometry::Frame& frame) {
  const geometry::Mat3 to_frame = frame.axes.inverse();
  return geometry::wave_ranges(to_frame * (helix.center - frame.origin), to_frame * helix.out, to_frame * helix.side,
                               to_frame * helix.rise / helix.sweep, {helix.sweep, helix.cosine, helix.sine});
}

static TipTravel arc_travel(const Machine& machine, const Move& arc) {
  const geometry::Helix helix = helix_of(arc);
  const double length = helix.length();
  const bool leans = helix.rise.cross(arc.normal).norm() > 1e-9 * length;
  return {leans ? integrated_length(MovePath(machine, arc)) : length, helix.extents()};
}

static std::array<Range, 3> swing_extents(const MovePath& path, const geometry::Frame& frame) {
  const geometry::Mat3 to_frame = frame.axes.inverse();
  const auto at = [&](double part) {
    const ValueAndSlope<Vec3> tip = path.tip_place(part);
    return ValueAndSlope<Vec3>{frame.to_inner(tip.value), to_frame * tip.slope};
  };
  const std::vector<ValueAndSlope<Vec3>> grid = on_grid(path.grid(), at);
  const auto end = [&](int axis, double sign) { return at(farthest(at, grid, axis, sign)).value[axis]; };
  return {Range{end(0, -1), end(0, 1)}, Range{end(1, -1), end(1, 1)}, Range{end(2, -1), end(2, 1)}};
}

/// The integral of a function by Simpson's rule, on halves of the range where it is not yet within the tolerance.
template <class Function>
static double integral(Function&& function, double from, double to, double tolerance) {
  constexpr int kMaxHalvings = 16;
  struct Panel {
    double from, to;
    double at_from, at_middle, at_to;
    double tolerance;
    int halvings;

    double area() const { return (to - from) / 6 * (at_from + 4 * at_middle + at_to); }
  };
  const auto panel = [&](double begin, double end, double at_begin, double at_end, double allowed, int halvings) {
    return Panel{begin, end, at_begin, function((begin + end) / 2), at_end, allowed, halvings};
  };
  std::vector<Panel> open = {panel(from, to, function(from), function(to), tolerance, 0)};
  double sum = 0;
  while (!open.empty()) {
    const Panel whole = open.back();
    open.pop_back();
    const double middle = (whole.from + whole.to) / 2;
    const auto half = [&](double begin, double end, double at_begin, double at_end) {
      return panel(begin, end, at_begin, at_end, whole.tolerance / 2, whole.halvings + 1);
    };
    const Panel first = half(whole.from, middle, whole.at_from, whole.at_middle);
    const Panel second = half(middle, whole.to, whole.at_middle, whole.at_to);
    const double difference = first.area() + second.area() - whole.area();
    if (whole.halvings == kMaxHalvings || std::abs(difference) <= 15 * whole.tolerance) {
      sum += first.area() + second.area() + difference / 15;
    } else {
      open.push_back(first);
      open.push_back(second);
    }
  }
  return sum;
}

/// The range from 0 to 1 of the polynomial of third degree with these values at 0, 1/3, 2/3 and 1.
static Range range_through(const std::array<double, 4>& values) {
  const auto [p, q, r, s] = values;
  const double first = (-11 * p + 18 * q - 9 * r + 2 * s) / 2;
  const double second = 9 * (2 * p - 5 * q + 4 * r - s) / 2;
  const double third = 9 * (-p + 3 * q - 3 * r + s) / 2;
  return geometry::cubic_range({p, first, second, third}, 0, 1);
}

/// Returns the extents of the tip in a rapid whose joints move independently.
static std::array<Range, 3> rapid_extents(const Machine& machine, const Move& rapid,
                                          const std::vector<RapidPart>& parts, const geometry::Frame& frame) {
  std::array<Range, 3> all = extents(frame.to_inner(rapid.from.tip), frame.to_inner(rapid.to.tip));
  for (const RapidPart& part : parts) {
    const MovePath path(machine, part);
    std::array<Range, 3> found;
    if (path.turns()) {
      found = swing_extents(path, frame);
    } else if (path.has_straight_tip()) {
      found = extents(frame.to_inner(path.tip(0)), frame.to_inner(path.tip(1)));
    } else {
      std::array<Vec3, 4> points;
      for (std::size_t i = 0; i < points.size(); ++i) points[i] = frame.to_inner(path.tip(static_cast<double>(i) / 3));
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        found[static_cast<std::size_t>(axis)] =
            range_through({points[0][axis], points[1][axis], points[2][axis], points[3][axis]});
    }
    for (std::size_t axis = 0; axis < all.size(); ++axis) all[axis].include(found[axis]);
  }
  return all;
}

static double rapid_length(const Machine& machine, const std::vector<RapidPart>& parts) {
  constexpr double kAccuracy = 1e-7;  // mm
  double length = 0;
  for (const RapidPart& part : parts) {
    const MovePath path(machine, part);
    if (path.has_straight_tip()) {
      length += (path.tip(1) - path.tip(0)).norm();
      continue;
    }
    const int panels = path.turns() ? path.grid() : 1;
    for (int i = 0; i < panels; ++i)
      length += integral([&](double at) { return path.tip_speed(at); }, static_cast<double>(i) / panels,
                         static_cast<double>(i + 1) / panels, kAccuracy / panels);
  }
  return length;
}

/// Returns whether the tip moves along a line. This holds for most moves, and is decided without a MovePath.
static bool goes_straight(const Machine& machine, const Move& move) {
  return !move.is_arc && !swings(machine, move) && !leaves_line(machine, move);
}

TipTravel tip_travel(const Machine& machine, const Move& move) {
  if (goes_straight(machine, move)) return {(move.to.tip - move.from.tip).norm(), extents(move.from.tip, move.to.tip)};
  if (move.is_arc) return arc_travel(machine, move);
  if (leaves_line(machine, move)) {
    const std::vector<RapidPart> parts = independent_rapid(machine, move);
    return {rapid_length(machine, parts), rapid_extents(machine, move, parts, {})};
  }
  const MovePath path(machine, move);
  return {integrated_length(path), swing_extents(path, {})};
}

std::array<Range, 3> tip_extents(const Machine& machine, const Move& move, const geometry::Frame& frame) {
  if (goes_straight(machine, move)) return extents(frame.to_inner(move.from.tip), frame.to_inner(move.to.tip));
  if (leaves_line(machine, move)) return rapid_extents(machine, move, independent_rapid(machine, move), frame);
  return move.is_arc ? arc_extents(helix_of(move), frame) : swing_extents(MovePath(machine, move), frame);
}

}  // namespace isocnc::kinematics
