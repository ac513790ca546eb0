// The programs of one long tool path each.

#include <string_view>

#include "bench/corpora/arc.h"
#include "bench/corpora/corpora.h"

namespace isocnc::bench {

static constexpr int kReach = 300'000;

static void write_start(Writer& out, std::string_view title) {
  out.line(title);
  out.line("M06 T101001");
  out.line("S12000 M03");
}

static constexpr int kEndLines = 3;

static void write_end(Writer& out) {
  out.line("G00 Z50");
  out.line("M05");
  out.line("M02");
}

/// Where a coordinate did not change, its word is left out, as a post-processor does.
static void write_change(Writer& out, char letter, int before, int after) {
  if (after != before) out.word(letter, after);
}

void write_short_moves(Writer& out, Random& random, int lines) {
  write_start(out, "(SHORT MOVES)");
  out.line("G00 X1 Y1 Z5");
  out.line("G01 Z-1 F1200");
  int x = 1'000, y = 1'000, z = -1'000;
  while (out.lines() < lines - kEndLines) {
    x = walk(x, random.step(-900, 900), kReach);
    out.word('X', x);
    const int next_y = walk(y, random.between(-900, 900), kReach);
    write_change(out, 'Y', y, next_y);
    y = next_y;
    if (random.one_in(4)) {
      z = z == -1'000 ? -1'250 : -1'000;
      out.word('Z', z);
    }
    out.end_line();
  }
  write_end(out);
}

void write_arcs(Writer& out, Random& random, int lines) {
  write_start(out, "(ARCS)");
  out.line("G00 X1 Y1 Z5");
  out.line("G01 Z-1 F1200");
  Point at{1'000, 1'000};
  bool was_clockwise = false;
  for (bool first = true; out.lines() < lines - kEndLines; first = false) {
    const Arc arc = random_arc(random, at, kReach);
    const bool clockwise = random.one_in(2);
    if (first || clockwise != was_clockwise) out.text(clockwise ? "G02" : "G03");
    was_clockwise = clockwise;
    write_change(out, 'X', at.x, arc.end.x);
    write_change(out, 'Y', at.y, arc.end.y);
    if (random.one_in(2)) {
      out.word('R', arc.radius);
    } else {
      out.word('I', arc.center.x).word('J', arc.center.y);
    }
    out.end_line();
    at = arc.end;
  }
  write_end(out);
}

void write_five_axis(Writer& out, Random& random, int lines) {
  constexpr int kBlocksPerFeedMode = 2'000;
  write_start(out, "(FIVE AXES)");
  out.line("G49");
  out.line("G00 X1 Y1 Z80 B10 C5");
  int x = 1'000, y = 1'000, z = 80'000, b = 10'000, c = 5'000;
  bool inverse_time = random.one_in(2);
  for (int blocks = 0; out.lines() < lines - kEndLines - 1; ++blocks) {
    if (blocks % kBlocksPerFeedMode == 0) {
      inverse_time = !inverse_time;
      out.text(inverse_time ? "G93" : "G94");
    }
    if (blocks == 0) out.text("G01");
    x = walk(x, random.step(-700, 700), kReach);
    y = walk(y, random.between(-700, 700), kReach);
    z = walk(z, random.between(-300, 300), 100'000);
    b = walk(b, random.between(-250, 250), 60'000);
    c = walk(c, random.between(-400, 400), 170'000);
    out.word('X', x).word('Y', y).word('Z', z).word('B', b).word('C', c);
    if (inverse_time) {
      out.word('F', random.between(20'000, 900'000));
    } else {
      out.word_of('F', random.between(300, 4'000));
    }
    out.end_line();
  }
  out.line("G48");
  write_end(out);
}

/// The line of an arc in G91, where end and center count from the start.
static void write_incremental_arc(Writer& out, Random& random, Point start, const Arc& arc) {
  out.text(random.one_in(2) ? "G02" : "G03");
  write_change(out, 'X', 0, arc.end.x - start.x);
  write_change(out, 'Y', 0, arc.end.y - start.y);
  if (random.one_in(2)) {
    out.word('R', arc.radius);
  } else {
    out.word('I', arc.center.x - start.x).word('J', arc.center.y - start.y);
  }
  out.end_line();
}

void write_incremental(Writer& out, Random& random, int lines) {
  write_start(out, "(INCREMENTAL MOVES)");
  out.line("G00 X1 Y1 Z5");
  out.line("G01 Z-1 F1200");
  out.line("G91");
  Point at{1'000, 1'000};
  bool after_arc = false;
  while (out.lines() < lines - kEndLines - 1) {
    if (!after_arc && random.one_in(8)) {
      const Arc arc = random_arc(random, at, kReach);
      write_incremental_arc(out, random, at, arc);
      at = arc.end;
      after_arc = true;
      continue;
    }
    if (after_arc) out.text("G01");
    after_arc = false;
    const Point next{walk(at.x, random.step(-900, 900), kReach), walk(at.y, random.between(-900, 900), kReach)};
    out.word('X', next.x - at.x);
    write_change(out, 'Y', 0, next.y - at.y);
    out.end_line();
    at = next;
  }
  out.line("G90");
  write_end(out);
}

}  // namespace isocnc::bench
