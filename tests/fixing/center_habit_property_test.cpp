#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/running/runner.h"
#include "tests/support/fixed_program.h"
#include "tests/support/random.h"

namespace isocnc::fixing {
namespace {

using support::codes_of;
using support::fixed;
using support::Random;

struct Point {
  double u = 0;
  double v = 0;
};

/// A circle that was meant: machine coordinates along the plane's axes, mm.
struct Circle {
  Point center;
  double radius = 0;
};

/// A program whose author counts all centers from the start, as on other controls, and what was meant.
struct HabitProgram {
  std::vector<std::string> lines;
  std::vector<Circle> circles;
  /// From X300 Y200 Z300, in the plane: its center is absolute, and fits in no other way.
  std::string absolute_arc;

  std::string text() const { return fmt::format("{}\n", fmt::join(lines, "\n")); }
};

/// One plane, mm or inches, arcs of all sizes with full turns among them, rounded to far less than the tolerance.
class HabitWriter {
 public:
  explicit HabitWriter(Random& random)
      : random_(random),
        inches_(random.one_in(4)),
        decimals_(inches_ ? 5 : 4),
        omits_zeros_(random.one_in(2)),
        plane_(random.between(17, 19)) {}

  HabitProgram write(int arcs) {
    HabitProgram program;
    program.lines = {"M06 T101001", inches_ ? "G70" : "G71", fmt::format("G{}", plane_)};
    // Away from the origin, where both readings are the same.
    at_ = {rounded(random_.real(20, 120)), rounded(random_.real(20, 120))};
    program.lines.push_back(fmt::format("G00 {}", words(end_letters(), at_)));
    program.lines.push_back("F20");
    for (int i = 0; i < arcs; ++i) program.lines.push_back(arc(program.circles));
    if (inches_) program.lines.push_back("G71");
    program.lines.push_back("M02");
    program.absolute_arc = plane_ == 17   ? "G02 X340 Y240 I340 J200 F1000"
                           : plane_ == 18 ? "G02 Z340 X340 K340 I300 F1000"
                                          : "G02 Y240 Z340 J240 K300 F1000";
    return program;
  }

 private:
  double scale() const { return inches_ ? 25.4 : 1; }
  double rounded(double value) const { return std::round(value * std::pow(10, decimals_)) / std::pow(10, decimals_); }
  /// The first and second axis of the plane: X Y, Z X, Y Z.
  std::string_view end_letters() const { return plane_ == 17 ? "XY" : plane_ == 18 ? "ZX" : "YZ"; }
  std::string_view center_letters() const { return plane_ == 17 ? "IJ" : plane_ == 18 ? "KI" : "JK"; }
  std::string words(std::string_view letters, Point point) const {
    return fmt::format("{}{:.{}f} {}{:.{}f}", letters[0], point.u, decimals_, letters[1], point.v, decimals_);
  }
  std::string center_words(Point offset) const {
    const std::string_view letters = center_letters();
    if (omits_zeros_ && offset.v == 0) return fmt::format("{}{:.{}f}", letters[0], offset.u, decimals_);
    if (omits_zeros_ && offset.u == 0) return fmt::format("{}{:.{}f}", letters[1], offset.v, decimals_);
    return words(letters, offset);
  }

  std::string arc(std::vector<Circle>& circles) {
    const double radius = std::exp(random_.real(std::log(0.5), std::log(60))) / scale();
    const double angle =
        random_.one_in(3) ? random_.between(0, 3) * std::numbers::pi / 2 : random_.real(0, 2 * std::numbers::pi);
    const bool is_clockwise = random_.one_in(2);
    const bool is_full = random_.one_in(3);
    const double sweep = (random_.one_in(3) ? random_.between(1, 3) * std::numbers::pi / 2 : random_.real(0.2, 6)) *
                         (is_clockwise ? -1 : 1);
    const Point offset{rounded(-radius * std::cos(angle)), rounded(-radius * std::sin(angle))};
    const Point center{at_.u + offset.u, at_.v + offset.v};
    const double true_radius = std::hypot(offset.u, offset.v);
    const double start = std::atan2(-offset.v, -offset.u);
    if (!is_full)
      at_ = {rounded(center.u + true_radius * std::cos(start + sweep)),
             rounded(center.v + true_radius * std::sin(start + sweep))};
    circles.push_back({{center.u * scale(), center.v * scale()}, true_radius * scale()});
    return fmt::format("{} {} {}", is_clockwise ? "G02" : "G03", words(end_letters(), at_), center_words(offset));
  }

  Random& random_;
  bool inches_;
  int decimals_;
  bool omits_zeros_;
  int plane_;
  Point at_;
};

/// The circles that the machine cuts, along the plane's axes.
std::vector<Circle> circles_of(const std::string& text) {
  std::vector<Circle> circles;
  const running::RunResult result = running::run(text, {}, [&](const running::Event& event) {
    const auto* const move = std::get_if<running::MoveEvent>(&event.what);
    if (!move || move->kind != execution::MoveKind::Arc) return;
    const auto& normal = move->normal;
    const int w = std::abs(normal[2]) > 0.5 ? 2 : std::abs(normal[1]) > 0.5 ? 1 : 0;
    circles.push_back({{move->center[(w + 1) % 3], move->center[(w + 2) % 3]}, move->radius});
  });
  EXPECT_EQ(result.ending, running::Ending::ProgramEnd) << text;
  return circles;
}

/// A program that ends without a finding cuts the circles that were meant: what cannot be mended stays a finding.
TEST(CenterHabitProperty, WhatIsMendedIsRightOrStaysAFinding) {
  std::size_t mended = 0;
  for (const std::uint64_t seed : support::seeds(1'500)) {
    Random random(seed);
    const HabitProgram program = HabitWriter(random).write(random.between(2, 12));
    const std::string after = fixed(program.text(), true);
    if (!codes_of(after).empty()) continue;
    const bool was_wrong = !codes_of(program.text()).empty();
    // One that shows nothing of the habit is the author's own affair: no fix has touched it.
    if (!was_wrong) {
      ASSERT_EQ(after, program.text());
      continue;
    }
    const std::vector<Circle> cut = circles_of(after);
    ASSERT_EQ(cut.size(), program.circles.size()) << "seed " << seed << "\n" << after;
    for (std::size_t i = 0; i < cut.size(); ++i) {
      const Circle& meant = program.circles[i];
      ASSERT_NEAR(cut[i].center.u, meant.center.u, 0.011) << "seed " << seed << "\n" << program.text() << after;
      ASSERT_NEAR(cut[i].center.v, meant.center.v, 0.011) << "seed " << seed << "\n" << program.text() << after;
      ASSERT_NEAR(cut[i].radius, meant.radius, 0.011) << "seed " << seed << "\n" << program.text() << after;
    }
    ++mended;
  }
  EXPECT_GT(mended, support::often(1'000));
}

/// With an arc that is right as it is, and so contradicts the habit, what is legal both ways is neither rewritten on a
/// guess nor left without a word.
TEST(CenterHabitProperty, MixedProgramsAreNeverMendedByGuessing) {
  std::size_t stays_open = 0;
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    HabitProgram program = HabitWriter(random).write(random.between(3, 10));
    program.lines.insert(program.lines.end() - 1, {"G00 X300 Y200 Z300", program.absolute_arc});
    const std::multiset<std::string> before = codes_of(program.text());
    if (before.empty()) continue;
    const std::string after = fixed(program.text(), true);
    const std::multiset<std::string> codes = codes_of(after);
    ASSERT_EQ(codes.count("W142"), before.count("W142")) << "seed " << seed << "\n" << after;
    stays_open += codes.contains("W142") ? 1 : 0;
    if (!codes.empty()) continue;
    const std::vector<Circle> cut = circles_of(after);
    ASSERT_EQ(cut.size(), program.circles.size() + 1) << "seed " << seed << "\n" << after;
    for (std::size_t i = 0; i < program.circles.size(); ++i)
      ASSERT_NEAR(cut[i].radius, program.circles[i].radius, 0.011) << "seed " << seed << "\n" << after;
  }
  EXPECT_GT(stays_open, support::often(100));
}

}  // namespace
}  // namespace isocnc::fixing
