#pragma once

#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "tests/support/random.h"

namespace isocnc::transforming {

/// Writes correct programs with arcs in all planes, compensation, faces of each kind, five axes, G91 and inches.
class RandomJob {
 public:
  explicit RandomJob(support::Random& random) : random_(random) {}

  bool has_planes = true;  ///< Arcs in G18 and G19.

  std::string text(int steps) {
    line("; a job");
    line("N10 M06 T101001");
    line("S12000 M03");
    if (random_.one_in(2)) line("G92 X500 Y-120.5 Z-80");
    if (random_.one_in(4)) {
      line("G70");
      is_in_inches_ = true;
    }
    place();
    for (int i = 0; i < steps; ++i) step();
    end_face();
    line("M05");
    line("M02");
    return text_;
  }

 private:
  void line(const std::string& words) { text_ += words + '\n'; }

  std::string number(double mm) const {
    return is_in_inches_ ? fmt::format("{:.8f}", mm / 25.4) : fmt::format("{:.3f}", mm);
  }
  double length() { return 0.5 * random_.between(-400, 400); }
  std::string end(int axis, double to) {
    auto& at = at_[static_cast<std::size_t>(axis)];
    const double value = is_incremental_ ? to - at : to;
    at = to;
    return fmt::format(" {}{}", "XYZ"[axis], number(value));
  }
  std::string feed() { return fmt::format(" F{}", 100 * random_.between(5, 60)); }

  /// A rapid to a place that is given with all its axes.
  void place() {
    line("G90");
    is_incremental_ = false;
    std::string words = "G00";
    for (int axis = 0; axis < 3; ++axis) words += end(axis, length());
    line(words + (has_turned_ ? "" : " B0 C0"));
    has_turned_ = true;
  }

  void step() {
    switch (random_.between(0, 9)) {
      case 0:
        line(is_incremental_ ? "G90" : "G91");
        is_incremental_ = !is_incremental_;
        return;
      case 1:
      case 2:
      case 3:
        return arc();
      case 4:
        return contour();
      case 5:
        return face();
      case 6:
        return turn();
      case 7:
        return line(std::string(random_.any_of({"G04 P1.5", "M101", "", "(note) ; X10"})));
      default:
        return straight();
    }
  }

  void straight() {
    std::string words = random_.one_in(4) ? "G00" : "G01" + feed();
    const int first = random_.between(0, 2);
    for (int axis = 0; axis < 3; ++axis)
      if (axis == first || random_.one_in(2)) words += end(axis, length());
    line(words);
  }

  /// A quarter, half or whole turn.
  void arc() {
    const int normal = has_planes || is_in_face_ ? random_.between(0, 2) : 2;
    if (normal != normal_) line(fmt::format("G{}", 19 - normal));
    normal_ = normal;
    const int u = (normal + 1) % 3;
    const int v = (normal + 2) % 3;
    const double radius = 0.5 * random_.between(1, 100) * (random_.one_in(2) ? 1 : -1);
    const std::array<double, 3> start = at_;
    const auto at = [&](int axis) { return start[static_cast<std::size_t>(axis)]; };
    const double center_u = at(u) + radius;
    const bool is_counterclockwise = random_.one_in(2);
    const int quarters = random_.any_of("124") - '0';
    std::string words = fmt::format("G{:02}", is_counterclockwise ? 3 : 2);
    const double to_u = quarters == 4 ? at(u) : quarters == 2 ? center_u + radius : center_u;
    // The start lies on the side of -radius, so that counterclockwise leads to -v for a positive radius.
    const double to_v = quarters == 1 ? at(v) + (is_counterclockwise ? -radius : radius) : at(v);
    words += end(u, to_u) + end(v, to_v);
    if (random_.one_in(3)) words += end(normal, length());
    if (quarters < 4 && random_.one_in(3)) {
      words += " R" + number(std::abs(radius));
    } else {
      const double relative_u = is_incremental_ ? radius : center_u;
      const double relative_v = is_incremental_ ? 0 : at(v);
      words += fmt::format(" {}{} {}{}", "IJK"[u], number(relative_u), "IJK"[v], number(relative_v));
    }
    line(words + feed());
  }

  /// A square beside which the tool goes.
  void contour() {
    if (normal_ != 2) line("G17");
    normal_ = 2;
    line(random_.one_in(2) ? "G41" : "G42");
    const double side = 20 + random_.between(0, 50);
    const int turn = random_.one_in(2) ? 1 : -1;
    line("G01" + end(0, at_[0] + side) + feed());
    line(end(1, at_[1] + turn * side));
    line(end(0, at_[0] - side) + end(1, at_[1] + side));
    line("G40");
    line("G01" + end(0, at_[0] - 30) + end(1, at_[1] - 10));
  }

  void end_face() {
    if (!is_in_face_) return;
    line("G27");
    is_in_face_ = false;
    place();
  }

  void face() {
    if (is_in_face_) return end_face();
    const std::string_view kind = random_.any_of({"29", "24", "28"});
    if (kind == "29") {
      line(fmt::format("G29 X{} Z{} B{} C{}", number(length()), number(length()), 15 * random_.between(-6, 6),
                       15 * random_.between(-12, 12)));
    } else if (kind == "24") {
      line(fmt::format("G24 Y{} A0.6 B0.8 I-0.8 J0.6 R1", number(length())));
    } else {
      line("G28 X0.8 Z-0.6 J1 P0.6 R0.8");
    }
    is_in_face_ = true;
    place();
  }

  void turn() {
    line("G49");
    line(fmt::format("G01{}{} B{} C{}{}", end(0, length()), end(2, length()), turned(b_), turned(c_), feed()));
    if (random_.one_in(2)) line(fmt::format("G01{} C{}{}", end(1, length()), turned(c_), feed()));
    line("G48");
  }
  std::string turned(double& angle) {
    const double to = random_.between(-80, 80);
    const double value = is_incremental_ ? to - angle : to;
    angle = to;
    return fmt::format("{}", value);
  }

  support::Random& random_;
  std::string text_;
  std::array<double, 3> at_{};
  double b_ = 0;
  double c_ = 0;
  int normal_ = 2;
  bool is_incremental_ = false;
  bool is_in_inches_ = false;
  bool is_in_face_ = false;
  bool has_turned_ = false;
};

}  // namespace isocnc::transforming
