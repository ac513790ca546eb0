#include "interpreter/kinematics/path.h"

#include <algorithm>
#include <cmath>

#include "interpreter/geometry/frame.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::kinematics {

Path Path::line(const Coordinates& from, const Coordinates& slope) {
  Path path;
  path.c[0] = from;
  path.c[1] = slope;
  return path;
}

static Jet polynomial_at(const Path& path, double s) {
  const auto& c = path.c;
  return {c[0] + s * (c[1] + s * (c[2] + s * c[3])), c[1] + s * (2 * c[2] + 3 * s * c[3]), 2 * c[2] + 6 * s * c[3]};
}

/// Of a circle, on which B and C rest.
static Jet circle_at(const Path& path, double s) {
  // Most are asked for at their start.
  const auto [sine, cosine] = s == 0 ? geometry::SineCosine{} : geometry::sine_and_cosine(path.omega * s / kRadians);
  const auto c1 = path.c[1].head<3>();
  const auto c2 = path.c[2].head<3>();
  const auto c3 = path.c[3].head<3>();
  const geometry::Vec3 out = cosine * c1 + sine * c2;
  const geometry::Vec3 along = cosine * c2 - sine * c1;
  Jet jet{.value = path.c[0]};
  jet.value.head<3>() += out + s * c3;
  jet.first.head<3>() = path.omega * along + c3;
  jet.second.head<3>() = -path.omega * path.omega * out;
  return jet;
}

Jet Path::at(double s) const { return kind == PathKind::Polynomial ? polynomial_at(*this, s) : circle_at(*this, s); }

Coordinates Path::value_at(double s) const {
  return kind == PathKind::Polynomial ? Coordinates(c[0] + s * (c[1] + s * (c[2] + s * c[3])))
                                      : circle_at(*this, s).value;
}

Jet Path::tip_at(const Kinematics& kinematics, double s) const {
  return is_of_joints ? forward(kinematics, at(s), tool_length) : at(s);
}

Jet Path::joints_at(const Kinematics& kinematics, double s) const {
  return is_of_joints ? at(s) : inverse(kinematics, at(s), tool_length);
}

/// Upper bounds of the norms of a vector and of its first four derivatives.
using Norms = std::array<double, 5>;

static double linear_norm(const Coordinates& c) { return c.head<3>().norm(); }

static Norms tip_norms(const Path& path, double length) {
  const auto& c = path.c;
  if (path.kind == PathKind::Circle) {
    const double radius = linear_norm(c[1]);
    const double omega = std::abs(path.omega);
    return {0, radius * omega + linear_norm(c[3]), radius * omega * omega, radius * std::pow(omega, 3),
            radius * std::pow(omega, 4)};
  }
  return {0, linear_norm(c[1]) + 2 * length * linear_norm(c[2]) + 3 * length * length * linear_norm(c[3]),
          2 * linear_norm(c[2]) + 6 * length * linear_norm(c[3]), 6 * linear_norm(c[3]), 0};
}

/// Returns bounds for a unit vector that B and C turn: those of cos f(s), where f is a polynomial up to the third
/// degree.
static Norms turning_norms(const Path& path, double length) {
  if (path.kind == PathKind::Circle) return {1, 0, 0, 0, 0};
  const auto turn = [&](std::size_t i) { return (std::abs(path.c[i][kB]) + std::abs(path.c[i][kC])) * kRadians; };
  const double jerk = 6 * turn(3);
  const double acceleration = 2 * turn(2) + jerk * length;
  const double speed = turn(1) + acceleration * length;
  const double square = speed * speed;
  return {1, speed, square + acceleration, speed * (square + 3 * acceleration) + jerk,
          square * square + 6 * square * acceleration + 3 * acceleration * acceleration + 4 * speed * jerk};
}

/// Returns a bound of a derivative of a vector of bounds `reach` that a table turns, by the Leibniz rule.
static double table_derivative(const Norms& reach, const Norms& turning, int order) {
  static constexpr double kBinomials[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};
  double sum = 0;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(order); ++i)
    sum += kBinomials[order][i] * reach[i] * turning[static_cast<std::size_t>(order) - i];
  return sum;
}

static HigherDerivativeBounds everywhere(double third, double fourth) {
  return {geometry::Vec3::Constant(third), geometry::Vec3::Constant(fourth)};
}

/// Returns the bounds for a circle in a space whose axes are those of the joints.
static HigherDerivativeBounds circle_derivative_bounds(const Path& path) {
  const geometry::Vec3 radii = (path.c[1].head<3>().cwiseAbs2() + path.c[2].head<3>().cwiseAbs2()).cwiseSqrt();
  const double cube = std::abs(path.omega * path.omega * path.omega);
  return {radii * cube, radii * cube * std::abs(path.omega)};
}

HigherDerivativeBounds higher_derivative_bounds(const Kinematics& kinematics, const Path& path, double from,
                                                double to) {
  if (path.kind == PathKind::Circle && (path.is_of_joints || kinematics.kind != MachineKind::Table))
    return circle_derivative_bounds(path);
  const double tip_jerk = path.kind == PathKind::Polynomial ? 6 * linear_norm(path.c[3]) : 0;
  if (path.is_of_joints || kinematics.kind == MachineKind::ThreeAxis) return everywhere(tip_jerk, 0);
  const double farthest = std::max(std::abs(from), std::abs(to));
  const Norms turning = turning_norms(path, farthest);
  if (kinematics.kind == MachineKind::Head) {
    const double reach = lever(kinematics, geometry::Vec3::Zero(), path.tool_length);  // The same at every tip.
    return everywhere(tip_jerk + reach * turning[3], reach * turning[4]);
  }
  Norms tip = tip_norms(path, farthest);
  tip[0] = lever(kinematics, path.value_at(from).head<3>(), path.tool_length) + tip[1] * (to - from);
  return everywhere(table_derivative(tip, turning, 3), table_derivative(tip, turning, 4));
}

}  // namespace isocnc::kinematics
