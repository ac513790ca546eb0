#include "tests/kinematics/moves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>

#include "interpreter/kinematics/kinematics.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::kinematics {

using geometry::Pose;
using geometry::Vec3;

Machine uniform_machine(double speed, double acceleration) {
  Machine machine;
  for (AxisLimits& axis : machine.axes) {
    axis.speed = speed;
    axis.acceleration = acceleration;
  }
  return machine;
}

Machine with_jerk(Machine machine, double jerk) {
  for (const MachineAxis axis : {kX, kY, kZ}) machine.axes[axis].jerk = jerk;
  for (const MachineAxis axis : {kB, kC}) machine.axes[axis].jerk = jerk / 3;
  return machine;
}

Move line(const Vec3& from, const Vec3& to, Feed feed) {
  Move move;
  move.from.tip = from;
  move.to.tip = to;
  move.feed = feed;
  return move;
}

static Vec3 turned(const Vec3& vector, const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * kRadians, axis) * vector;
}

Move arc_xy(const Vec3& from, const Vec3& center, double sweep_deg, double rise, Feed feed) {
  Move move = line(from, center + turned(from - center, Vec3::UnitZ(), sweep_deg) + rise * Vec3::UnitZ(), feed);
  move.is_arc = true;
  move.center = center;
  move.normal = Vec3::UnitZ();
  move.sweep_deg = sweep_deg;
  return move;
}

static Vec3 on_arc(const Move& move, double part) {
  const Vec3 out = move.from.tip - move.center;
  const Vec3 off = move.to.tip - (move.center + turned(out, move.normal, move.sweep_deg));
  return move.center + turned(out, move.normal, part * move.sweep_deg) + part * off;
}

Pose programmed(const Machine& machine, const Move& move, double part) {
  const Coordinates from = coordinates(move.from);
  const Coordinates to = coordinates(move.to);
  Pose result = pose(from + part * (to - from));
  if (move.is_arc) {
    result.tip = on_arc(move, part);
  } else if (!move.controls_tool_point) {
    const Coordinates first = inverse(machine.kinematics, from, move.tool_length);
    const Coordinates last = inverse(machine.kinematics, to, move.tool_length);
    result = pose(forward(machine.kinematics, Coordinates(first + part * (last - first)), move.tool_length));
  }
  return result;
}

double distance(const Machine& machine, const Move& move, const Vec3& point) {
  const auto off = [&](double part) { return (programmed(machine, move, part).tip - point).norm(); };
  if (!move.is_arc && (move.controls_tool_point || (move.from.b == move.to.b && move.from.c == move.to.c))) {
    const Vec3 way = move.to.tip - move.from.tip;
    const double square = way.squaredNorm();
    return off(square > 0 ? std::clamp((point - move.from.tip).dot(way) / square, 0.0, 1.0) : 0);
  }
  constexpr int kGrid = 48;
  std::array<double, kGrid + 1> grid;
  for (std::size_t i = 0; i < grid.size(); ++i) grid[i] = off(static_cast<double>(i) / kGrid);
  double minimum = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const bool is_valley = (i == 0 || grid[i] <= grid[i - 1]) && (i == kGrid || grid[i] <= grid[i + 1]);
    if (!is_valley) continue;
    double low = std::max(0.0, (static_cast<double>(i) - 1) / kGrid);
    double high = std::min(1.0, (static_cast<double>(i) + 1) / kGrid);
    for (int step = 0; step < 30; ++step) {
      const double third = (high - low) / 3;
      if (off(low + third) < off(high - third)) {
        high -= third;
      } else {
        low += third;
      }
    }
    minimum = std::min(minimum, off((low + high) / 2));
  }
  return minimum;
}

namespace {

/// Draws moves; the position goes along.
class Drawer {
 public:
  explicit Drawer(std::uint64_t seed) : random_(seed) {}

  Move draw() {
    Move move;
    move.from = pose_;
    move.to = pose_;
    move.tag = tag_++;
    move.tool_length = 80;
    move.feed = feed();
    move.exact_stop = chance(0.05);
    switch (below(10)) {
      case 0:
        turn(move);
        move.feed = kRapid;
        move.controls_tool_point = false;
        [[fallthrough]];
      case 1:
        move.to.tip += vector(chance(0.2) ? 0 : 50);
        break;
      case 2:
      case 3:
        turn(move);
        move.to.tip += vector(chance(0.2) ? 0 : 10);
        break;
      case 4:
      case 5:
        arc(move);
        break;
      default:
        move.to.tip += vector(std::pow(10, between(-2.5, 2)));
    }
    pose_ = move.to;
    return move;
  }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  int below(int end) { return std::uniform_int_distribution<>(0, end - 1)(random_); }
  bool chance(double part) { return between(0, 1) < part; }
  Vec3 vector(double size) { return size * Vec3(between(-1, 1), between(-1, 1), between(-1, 1)); }
  Vec3 direction() { return vector(1).normalized(); }

  Feed feed() {
    if (chance(0.2)) return kRapid;
    if (chance(0.2)) return duration(between(0.05, 2));
    return speed(std::pow(10, between(0.5, 3)));
  }

  void turn(Move& move) {
    move.from = pose_;
    move.to = pose_;
    const double size = std::pow(10, between(-1, 1.8));
    move.to.b = std::clamp(pose_.b + between(-size, size), -120.0, 120.0);
    move.to.c = std::clamp(pose_.c + between(-size, size), -360.0, 360.0);
  }

  void arc(Move& move) {
    move.is_arc = true;
    move.normal = direction();
    const Vec3 out = move.normal.cross(direction()).normalized() * std::pow(10, between(-1, 2));
    move.center = move.from.tip + out;
    move.sweep_deg = chance(0.2) ? (chance(0.5) ? 360 : -360) : between(-360, 360);
    const double rise = chance(0.5) ? 0 : between(-5, 5);
    move.to = move.from;
    move.to.tip = move.center + turned(-out, move.normal, move.sweep_deg) + rise * move.normal;
    if (chance(0.3)) move.to.tip += vector(0.005);  // As by the decimals of a program.
    move.splits_arcs = chance(0.3);
    if (move.splits_arcs && chance(0.5)) move.to.b = std::clamp(move.to.b + between(-5, 5), -120.0, 120.0);
  }

  std::mt19937_64 random_;
  Pose pose_;
  std::uint64_t tag_ = 0;
};

}  // namespace

std::vector<Move> random_moves(std::uint64_t seed, int count) {
  Drawer drawer(seed);
  std::vector<Move> moves;
  for (int i = 0; i < count; ++i) {
    Move move = drawer.draw();
    if (!move.is_arc && move.to == move.from) continue;
    moves.push_back(move);
  }
  for (std::size_t i = 0; i < moves.size(); ++i) moves[i].tag = i;
  return moves;
}

}  // namespace isocnc::kinematics
