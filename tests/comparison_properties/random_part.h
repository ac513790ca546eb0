#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tests/support/random.h"

namespace isocnc::comparison {

/// A motion of a part, or what stands between motions.
struct PartStep {
  enum class Kind { Rapid, Line, Arc, Dwell, Function };

  Kind kind = Kind::Line;
  std::array<int, 3> to{};      ///< Micrometers.
  std::array<int, 2> center{};  ///< Micrometers.
  std::array<int, 2> turn{};    ///< B and C at the end, thousandths of a degree.
  bool is_counterclockwise = false;
  int feed = 1000;  ///< mm/min
  int number = 0;   ///< Dwell: tenths of a second. Function: its M.

  bool is_motion() const { return kind != Kind::Dwell && kind != Kind::Function; }
};

/// What a part is made of, apart from how its program is written.
struct RandomPart {
  int tool = 101001;
  int speed = 12000;
  bool is_five_axis = false;  ///< G49: lines turn B and C, and there are no arcs.
  std::vector<PartStep> steps;

  bool is_arc(std::size_t i) const { return i < steps.size() && steps[i].kind == PartStep::Kind::Arc; }
  /// Whether the step is a straight motion, and no arc starts where it ends.
  bool is_free(std::size_t i) const {
    if (i >= steps.size() || !steps[i].is_motion() || is_arc(i)) return false;
    std::size_t next = i + 1;
    while (next < steps.size() && !steps[next].is_motion()) ++next;
    return !is_arc(next);
  }
};

inline RandomPart random_part(support::Random& random, int count, bool is_five_axis = false) {
  RandomPart part{.is_five_axis = is_five_axis};
  part.steps.push_back({.kind = PartStep::Kind::Rapid, .to = {10'000, 20'000, 30'000}});
  std::array<int, 3> at = part.steps[0].to;
  for (int i = 0; i < count; ++i) {
    PartStep step;
    step.feed = 100 * random.between(5, 60);
    const int kind = random.between(0, 11);
    if (kind == 0) {
      step.kind = PartStep::Kind::Dwell;
      step.number = random.between(1, 30);
    } else if (kind == 1) {
      step.kind = PartStep::Kind::Function;
      step.number = random.between(100, 105);
    } else if (kind < 5 && !is_five_axis) {
      // A quarter or half of a circle, whose points are exact in micrometers.
      step.kind = PartStep::Kind::Arc;
      step.is_counterclockwise = random.one_in(2);
      const int radius = 2 * random.between(500, 30'000);
      step.center = {at[0] + radius, at[1]};
      const int side = step.is_counterclockwise ? -radius : radius;
      step.to = random.one_in(2) ? std::array{at[0] + 2 * radius, at[1], at[2]}
                                 : std::array{at[0] + radius, at[1] + side, at[2]};
      if (random.one_in(3)) step.to[2] += 1000 * random.between(-5, 5);
    } else {
      step.kind = kind < 7 ? PartStep::Kind::Rapid : PartStep::Kind::Line;
      for (int& each : step.to) each = 2 * random.between(-100'000, 100'000);
      if (is_five_axis)
        for (int& each : step.turn) each = 2 * random.between(-20'000, 20'000);
    }
    if (step.is_motion()) at = step.to;
    part.steps.push_back(step);
  }
  return part;
}

/// How a program is written.
struct WritingStyle {
  bool is_incremental = false;  ///< G91
  bool is_in_inches = false;    ///< G70
  bool by_radius = false;       ///< Quarters of circles by R.
  bool is_numbered = false;
  bool is_split = false;  ///< Each line as two.
  int chords = 0;         ///< Each arc as so many lines.
};

struct WrittenPart {
  std::string text;
  std::vector<std::size_t> lines;  ///< The first line of each step, from 0.
};

class PartWriter {
 public:
  explicit PartWriter(const WritingStyle& style) : style_(style) {}

  WrittenPart write(const RandomPart& part) {
    line("; a part");
    line(fmt::format("M06 T{}", part.tool));
    line(fmt::format("S{} M03", part.speed));
    if (style_.is_in_inches) line("G70");
    if (part.is_five_axis) line("G49");
    is_five_axis_ = part.is_five_axis;
    if (style_.is_incremental) line("G91");
    for (const PartStep& step : part.steps) {
      written_.lines.push_back(count_);
      write(step);
    }
    line("M02");
    return std::move(written_);
  }

 private:
  using Point = std::array<double, 3>;  // mm
  using Turn = std::array<double, 2>;   // B and C, degrees.

  void line(const std::string& text) {
    if (style_.is_numbered) written_.text += fmt::format("N{} ", 10 * (count_ + 1));
    written_.text += text + '\n';
    ++count_;
  }

  std::string number(double mm) const {
    return style_.is_in_inches ? fmt::format("{:.8f}", mm / 25.4) : fmt::format("{:.4f}", mm);
  }
  std::string feed(int mm_per_minute) const {
    return style_.is_in_inches ? fmt::format("{:.6f}", mm_per_minute / 25.4) : std::to_string(mm_per_minute);
  }
  std::string word(char letter, double value, double from) const {
    return fmt::format(" {}{}", letter, number(style_.is_incremental ? value - from : value));
  }

  void go(const std::string& g, const Point& to, const Turn& turn, const std::string& after) {
    std::string text = g;
    for (std::size_t i = 0; i < 3; ++i) text += word("XYZ"[i], to[i], at_[i]);
    for (std::size_t i = 0; is_five_axis_ && i < 2; ++i)
      text += fmt::format(" {}{:.4f}", "BC"[i], style_.is_incremental ? turn[i] - turn_[i] : turn[i]);
    line(text + after);
    at_ = to;
    turn_ = turn;
  }

  void write(const PartStep& step) {
    const Point to{step.to[0] / 1000.0, step.to[1] / 1000.0, step.to[2] / 1000.0};
    switch (step.kind) {
      case PartStep::Kind::Dwell:
        return line(fmt::format("G04 P{:.1f}", step.number / 10.0));
      case PartStep::Kind::Function:
        return line(fmt::format("M{}", step.number));
      case PartStep::Kind::Arc:
        return arc(step, to);
      case PartStep::Kind::Rapid:
      case PartStep::Kind::Line: {
        const bool is_rapid = step.kind == PartStep::Kind::Rapid;
        const std::string after = is_rapid ? "" : " F" + feed(step.feed);
        const std::string g = is_rapid ? "G00" : "G01";
        const Turn turn{step.turn[0] / 1000.0, step.turn[1] / 1000.0};
        // The tip of a rapid that turns B or C does not go straight.
        if (style_.is_split && !(is_rapid && is_five_axis_)) {
          Point middle = at_;
          for (std::size_t i = 0; i < 3; ++i) middle[i] = (at_[i] + to[i]) / 2;
          go(g, middle, {(turn_[0] + turn[0]) / 2, (turn_[1] + turn[1]) / 2}, after);
        }
        return go(g, to, turn, after);
      }
    }
  }

  void arc(const PartStep& step, const Point& to) {
    const double u = step.center[0] / 1000.0;
    const double v = step.center[1] / 1000.0;
    const double radius = std::abs(u - at_[0]);
    const bool is_quarter = to[0] == u;
    if (style_.chords > 0) return chords(step, to, u, v, radius, is_quarter);
    const std::string center =
        style_.by_radius && is_quarter ? " R" + number(radius) : word('I', u, at_[0]) + word('J', v, at_[1]);
    go(step.is_counterclockwise ? "G03" : "G02", to, {}, center + " F" + feed(step.feed));
  }

  void chords(const PartStep& step, const Point& to, double u, double v, double radius, bool is_quarter) {
    const double sweep = (step.is_counterclockwise ? 1 : -1) * (is_quarter ? 0.5 : 1) * std::acos(-1.0);
    const double z = at_[2];
    for (int i = 1; i < style_.chords; ++i) {
      const double part = static_cast<double>(i) / style_.chords;
      const double angle = std::acos(-1.0) + sweep * part;  // The center lies in +X of the start.
      go("G01", {u + radius * std::cos(angle), v + radius * std::sin(angle), z + part * (to[2] - z)}, {},
         " F" + feed(step.feed));
    }
    go("G01", to, {}, " F" + feed(step.feed));
  }

  WritingStyle style_;
  WrittenPart written_;
  std::size_t count_ = 0;
  Point at_{};
  Turn turn_{};
  bool is_five_axis_ = false;
};

inline WrittenPart written(const RandomPart& part, const WritingStyle& style = {}) {
  return PartWriter(style).write(part);
}

}  // namespace isocnc::comparison
