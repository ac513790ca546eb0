#include "interpreter/motion/travel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/motion/element.h"

namespace isocnc::motion {

/// Between grid points this far apart a joint has one peak at most, radians of B, C and the arc together.
static constexpr double kGridTurn = 3 * std::numbers::pi / 180;
static constexpr int kPeakSteps = 60;
/// More than rotary axes turn in one move.
static constexpr int kMostGridPoints = 10'000;

/// The joints along a move, by the part of the way gone.
class JointWay {
 public:
  JointWay(const Machine& machine, const Move& move)
      : machine_(machine),
        way_(move.is_arc ? programmed_circle(move) : programmed_line(machine, move, move.from, move.to)) {
    turned_[kB] = move.to.b - move.from.b;
    turned_[kC] = move.to.c - move.from.c;
  }

  Coordinates at(double part) const {
    Coordinates there = way_.path.at(part * way_.length).value;
    if (is_arc()) there += part * turned_;
    return way_.path.is_of_joints ? there : inverse(machine_.kinematics, there, way_.path.tool_length);
  }

  bool is_straight() const {
    const bool turns = turned_.squaredNorm() > 0 && machine_.kinematics.kind != MachineKind::ThreeAxis;
    return !is_arc() && (way_.path.is_of_joints || !turns);
  }

  int grid() const {
    const double turn = std::abs(way_.path.omega) * way_.length + turned_.cwiseAbs().sum() * std::numbers::pi / 180;
    return std::max(2, part_count(turn / kGridTurn, kMostGridPoints));
  }

 private:
  bool is_arc() const { return way_.path.kind == PathKind::Circle; }

  const Machine& machine_;
  ProgrammedPath way_;
  Coordinates turned_ = Coordinates::Zero();
};

/// Where between two parts of the way a joint goes farthest in the direction of `sign`.
static double farthest(const JointWay& way, int axis, double sign, double low, double high) {
  for (int i = 0; i < kPeakSteps; ++i) {
    const double third = (high - low) / 3;
    if (sign * way.at(low + third)[axis] > sign * way.at(high - third)[axis]) {
      high -= third;
    } else {
      low += third;
    }
  }
  return (low + high) / 2;
}

/// Where a joint goes farthest: beside the grid's peaks, its ends included.
static double farthest(const JointWay& way, const std::vector<Coordinates>& grid, int axis, double sign) {
  const std::size_t last = grid.size() - 1;
  const auto part = [&](std::size_t i) { return static_cast<double>(i) / static_cast<double>(last); };
  double best = 0;
  const auto consider = [&](double candidate) {
    if (sign * way.at(candidate)[axis] > sign * way.at(best)[axis]) best = candidate;
  };
  consider(1);
  for (std::size_t i = 0; i <= last; ++i) {
    const auto is_below = [&](std::size_t k) { return sign * grid[k][axis] <= sign * grid[i][axis]; };
    const bool is_peak = (i == 0 || is_below(i - 1)) && (i == last || is_below(i + 1));
    if (is_peak) consider(farthest(way, axis, sign, i == 0 ? 0 : part(i - 1), i == last ? 1 : part(i + 1)));
  }
  return best;
}

/// Reports what passes a limit, where `find(axis, sign)` says that a joint goes farthest.
template <typename Find>
static std::vector<Overtravel> beyond(const Machine& machine, const JointWay& way, Find&& find) {
  std::vector<Overtravel> found;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const AxisLimits& limits = machine.axes[static_cast<std::size_t>(axis)];
    for (const double sign : {-1.0, 1.0}) {
      const double limit = sign < 0 ? limits.least : limits.most;
      if (std::isinf(limit)) continue;
      const double part = find(axis, sign);
      const double position = way.at(part)[axis];
      if (sign * (position - limit) > 0) found.push_back({static_cast<Axis>(axis), part, position, limit});
    }
  }
  return found;
}

std::vector<Overtravel> overtravels(const Machine& machine, const Move& move) {
  const JointWay way(machine, move);
  if (way.is_straight()) {
    const Coordinates change = way.at(1) - way.at(0);
    return beyond(machine, way, [&](int axis, double sign) { return sign * change[axis] > 0 ? 1.0 : 0.0; });
  }
  std::vector<Coordinates> grid;
  const int count = way.grid();
  for (int i = 0; i <= count; ++i) grid.push_back(way.at(static_cast<double>(i) / count));
  return beyond(machine, way, [&](int axis, double sign) { return farthest(way, grid, axis, sign); });
}

}  // namespace isocnc::motion
