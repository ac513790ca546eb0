// Programs for the removal of material: what they cut matters, not how they are written.

#include <array>
#include <cstdlib>
#include <string_view>

#include "bench/corpora/arc.h"
#include "bench/corpora/corpora.h"

namespace isocnc::bench {

namespace {

/// Steps of 1 mm in 36 directions, in turn counterclockwise: what has whole numbers on a circle of radius 65.
class Heading {
 public:
  explicit Heading(Random& random) : index_(random.between(0, kDirections - 1)) {}

  void turn(int by) { index_ = (index_ + by + kDirections) % kDirections; }
  Point step() const {
    static constexpr std::array<Point, kDirections / 4> kQuarter = {
        {{65, 0}, {63, 16}, {60, 25}, {56, 33}, {52, 39}, {39, 52}, {33, 56}, {25, 60}, {16, 63}}};
    const Point one = kQuarter[static_cast<std::size_t>(index_ % kQuarter.size())];
    switch (index_ / static_cast<int>(kQuarter.size())) {
      case 0:
        return {one.x * kThousand / 65, one.y * kThousand / 65};
      case 1:
        return {-one.y * kThousand / 65, one.x * kThousand / 65};
      case 2:
        return {-one.x * kThousand / 65, -one.y * kThousand / 65};
      default:
        return {one.y * kThousand / 65, -one.x * kThousand / 65};
    }
  }

 private:
  static constexpr int kDirections = 36;
  int index_;
};

/// Walks over a square panel by moves of 1 mm that turn by some ten degrees, from a new place every 2,000 moves.
class Walk {
 public:
  Walk(Random& random, int size) : random_(random), size_(size), heading_(random) { leave(); }

  const Point& at() const { return at_; }
  void leave() { at_ = {random_.between(kBorder, size_ - kBorder), random_.between(kBorder, size_ - kBorder)}; }
  void go() {
    heading_.turn(random_.between(-1, 1));
    const auto is_outside = [&](int value) { return value < kBorder || value > size_ - kBorder; };
    for (;; heading_.turn(1)) {
      const Point step = heading_.step();
      const Point next{at_.x + step.x, at_.y + step.y};
      if (is_outside(next.x) || is_outside(next.y)) continue;
      at_ = next;
      return;
    }
  }

 private:
  static constexpr int kBorder = 10 * kThousand;

  Random& random_;
  int size_;
  Heading heading_;
  Point at_;
};

constexpr int kMovesOfOneWalk = 2'000;
constexpr int kEndLines = 3;

void write_start(Writer& out, std::string_view title) {
  out.line(title);
  out.line("M06 T101001");
  out.line("S12000 M03");
}

void write_end(Writer& out) {
  out.line("G00 Z50");
  out.line("M05");
  out.line("M02");
}

void write_walk_over(Writer& out, Random& random, int lines, int size) {
  write_start(out, "(WALK)");
  Walk walk(random, size);
  for (bool is_first = true; out.lines() + kEndLines < lines; is_first = false) {
    if (!is_first) out.line("G00 Z5");
    if (is_first) out.text("G00");
    walk.leave();
    out.word('X', walk.at().x).word('Y', walk.at().y);
    if (is_first) out.word('Z', 5 * kThousand);
    out.end_line();
    out.text("G01").word('Z', -random.between(2'000, 8'000));
    if (is_first) out.word_of('F', 6000);
    out.end_line();
    for (int i = 0; i < kMovesOfOneWalk && out.lines() + kEndLines < lines; ++i) {
      const Point before = walk.at();
      walk.go();
      if (walk.at().x != before.x) out.word('X', walk.at().x);
      if (walk.at().y != before.y) out.word('Y', walk.at().y);
      out.end_line();
    }
  }
  write_end(out);
}

}  // namespace

void write_walk(Writer& out, Random& random, int lines) { write_walk_over(out, random, lines, 1000 * kThousand); }

void write_narrow_walk(Writer& out, Random& random, int lines) { write_walk_over(out, random, lines, 250 * kThousand); }

void write_five_axis_walk(Writer& out, Random& random, int lines) {
  constexpr int kRetracted = 60 * kThousand;
  write_start(out, "(WALK IN FIVE AXES)");
  out.line("G49");
  Walk walk(random, 1000 * kThousand);
  int b = 20'000, c = 5'000;
  const auto write_tip = [&](int z) {
    out.word('X', walk.at().x).word('Y', walk.at().y).word('Z', z).word('B', b).word('C', c);
  };
  out.text("G00");
  write_tip(kRetracted);
  out.end_line();
  for (bool is_first = true; out.lines() + kEndLines + 1 < lines; is_first = false) {
    if (!is_first) {
      walk.leave();
      write_tip(kRetracted);
      out.end_line();
    }
    int z = -random.between(2'000, 8'000);
    if (is_first) out.text("G01");
    write_tip(z);
    if (is_first) out.word_of('F', 6000);
    out.end_line();
    for (int i = 0; i < kMovesOfOneWalk && out.lines() + kEndLines + 2 < lines; ++i) {
      walk.go();
      z = -std::abs(bench::walk(-z, random.between(-50, 50), 8'000));
      // The axis stays between 10 and 30 degrees from the vertical.
      b = 20'000 + bench::walk(b - 20'000, random.between(-250, 250), 10'000);
      c = bench::walk(c, random.between(-400, 400), 170'000);
      write_tip(z);
      out.end_line();
    }
    write_tip(kRetracted);
    out.end_line();
  }
  out.line("G48");
  write_end(out);
}

void write_table(Writer& out, Random& random, int lines) {
  constexpr int kLength = 3000 * kThousand, kWidth = 1500 * kThousand, kPitch = 15 * kThousand;
  const int moves_of_row = lines * kPitch / kWidth;
  write_start(out, "(A TABLE)");
  out.text("G00").word('X', 0).word('Y', 0).word('Z', 5 * kThousand).end_line();
  out.text("G01").word('Z', -2'000).word_of('F', 20'000).end_line();
  for (int y = 0, row = 0; y <= kWidth; y += kPitch, ++row) {
    for (int i = row == 0 ? 1 : 0; i <= moves_of_row; ++i) {
      const int share = row % 2 == 0 ? i : moves_of_row - i;
      if (i > 0) out.word('X', static_cast<int>(static_cast<long long>(kLength) * share / moves_of_row));
      if (i == 0) out.word('Y', y);
      if (i > 0) out.word('Z', -random.between(1'000, 6'000));
      out.end_line();
    }
  }
  write_end(out);
}

}  // namespace isocnc::bench
