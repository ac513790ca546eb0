// What a good post-processor writes: operations one after another, each of which leaves the modes as it found them and
// may therefore be skipped.

#include <cstdint>
#include <string_view>

#include "bench/corpora/arc.h"
#include "bench/corpora/corpora.h"
#include "bench/corpora/registers.h"

namespace isocnc::bench {

namespace {

/// Which operations may be skipped by an IF before them.
enum class Options { None, Some, All };

/// How many operations may be skipped with `Options::Some`, where there are so many.
constexpr int kSomeOptions = 200;

/// Line numbers: operation 12 has N1200 on its first line, then N1201 and so on.
constexpr int kNumbersPerOperation = 100;

constexpr int kReach = 200'000;

/// Writes one program, the same operations from the same seed whatever the options. Between operations the modes are
/// those of the start, the tip is at Z50 of the workpiece, and G00 is in force, on every path. An operation starts at
/// an odd X (in micrometers) and ends at an even one, so that its first motion goes somewhere whichever operations
/// before it were skipped.
class Production {
 public:
  Production(Writer& out, Random& random, Options options)
      : out_(out), random_(random), registers_(out, random.split()), options_(options) {}

  void write(int lines) {
    write_start();
    constexpr int kEndLines = 5;
    constexpr int kLinesOfOperation = 130;
    bool changes_tool = false;
    for (bool last = false; !last; ++operation_) {
      const int lines_left = lines - kEndLines - out_.lines();
      last = lines_left < kLinesOfOperation;
      const bool next_changes_tool = random_.one_in(3);
      write_operation({.moves = last ? lines_left - 14 : random_.between(20, 58),
                       .changes_tool = changes_tool,
                       .is_option = !last && is_option(lines, next_changes_tool)});
      changes_tool = next_changes_tool;
    }
    write_end();
  }

 private:
  struct Operation {
    int moves = 0;
    bool changes_tool = false;
    bool is_option = false;
  };

  /// What a skipped tool change leaves is right only if the operation after it changes the tool again. With an
  /// option on every operation that is not asked for, so that the paths meet again late.
  bool is_option(int lines, bool next_changes_tool) {
    if (options_ != Options::Some) return options_ == Options::All;
    const auto next_place = (2 * written_options_ + 1) * static_cast<std::int64_t>(lines) / (2 * kSomeOptions);
    return next_changes_tool && written_options_ < kSomeOptions && out_.lines() >= next_place;
  }

  void write_start() {
    out_.line("(PART 4711, FIRST SIDE)");
    out_.line("; material: aluminum, clamped in the vise, zero at the upper left corner");
    out_.line("N1 G17 G71 G90 G94");
    out_.line("N2 G48");
    out_.line("N3 M06 T101001 (FACE MILL D50)");
    out_.line("N4 S8000 M03");
    out_.line("N5 M08");
    out_.line("N6 G00 Z50");
  }

  void write_end() {
    number_ = operation_ * kNumbersPerOperation;
    block("M09").end_line();
    block("M05").end_line();
    block("G00 Z180").end_line();
    out_.line("(END)");
    block("M02").end_line();
  }

  void write_operation(const Operation& operation) {
    number_ = operation_ * kNumbersPerOperation;
    block("; OPERATION").integer(operation_).end_line();
    if (operation_ % kOperationsPerSetup == 1) write_setup();
    if (operation.is_option) write_option();
    if (operation.changes_tool) write_tool_change();
    switch (operation.moves > 60 ? 0 : random_.between(0, 7)) {
      case 1:
        return pocket(operation.moves);
      case 2:
        return drill(operation.moves);
      case 3:
        return bore(operation.moves);
      case 4:
        return valley(operation.moves);
      case 5:
        return tilted_face(operation.moves);
      default:
        return contour(operation.moves);
    }
  }

  // The lines around an operation's motions.

  static constexpr int kOperationsPerSetup = 40;

  void write_setup() {
    setup_z_ = setup_z_ == -120'000 ? -95'500 : -120'000;
    block("G92").word('X', random_.between(10'000, 400'000)).word('Y', random_.between(10'000, 300'000));
    out_.word('Z', setup_z_).end_line();
    block("G00 Z50").end_line();
  }

  void write_option() {
    ++written_options_;
    const bool depends_on_registers = options_ == Options::All && operation_ % 2 == 0;
    const int number = registers_.any();
    if (options_ == Options::All && !depends_on_registers) {
      registers_.assign(registers_.any());
      registers_.assign(number);
    }
    block("IF");
    if (depends_on_registers) {
      registers_.write_condition();
    } else {
      registers_.write_machine_condition();
    }
    out_.text("GOTO").word_of('N', (operation_ + 1) * kNumbersPerOperation).end_line();
    if (options_ != Options::All) return;
    in_dependent_option_ = depends_on_registers;
    assign_register(number);
  }

  void assign_register(int number) {
    if (in_dependent_option_) {
      registers_.assign_in_dependent_option(number);
    } else {
      registers_.assign_in_option(number);
    }
  }

  /// Anything that may stand between two motions.
  void pause() {
    if (options_ == Options::All && registers_.one_in(10)) assign_register(registers_.any());
    if (random_.one_in(50)) out_.line("; next pass");
  }

  void write_tool_change() {
    block("M09").end_line();
    block("M05").end_line();
    block("M06").word_of('T', 101'000 + random_.between(1, 60)).text("(END MILL)").end_line();
    block("M03").word_of('S', 500 * random_.between(4, 36)).end_line();
    if (random_.one_in(6)) block("M120 P1=2.5 P2=3").end_line();
    block("M08").end_line();
  }

  // The operations.

  void contour(int moves) {
    approach(random_point());
    contour_at_tool(moves);
    retract();
  }

  void contour_at_tool(int moves) {
    const bool compensates = random_.one_in(3);
    block("G01").word('Z', -100 * random_.between(1, 120)).word_of('F', 350).end_line();
    block(compensates ? "G41 G01" : "G01");
    move_to(next_point()).word_of('F', 50 * random_.between(12, 80)).end_line();
    write_curves(moves - 6);
    block("G01");
    move_to(even(next_point())).text(random_.one_in(3) ? "G09" : "(OUT)").end_line();
    if (compensates) block("G40").end_line();
  }

  /// Lines by modal continuation, with an arc, now and then a helix, in between.
  void write_curves(int moves) {
    bool after_arc = false;
    for (int i = 0; i < moves; ++i) {
      if (!after_arc && random_.one_in(6)) {
        arc();
        after_arc = true;
        continue;
      }
      if (after_arc) block("G01");
      after_arc = false;
      move_to(next_point()).end_line();
      pause();
    }
    if (!after_arc) arc();
  }

  void arc() {
    const Arc arc = random_arc(random_, at_, kReach);
    block(random_.one_in(2) ? "G02" : "G03");
    move_to(arc.end);
    if (random_.one_in(5)) out_.word('Z', -100 * random_.between(121, 200));
    if (random_.one_in(4)) {
      out_.word('R', arc.radius).end_line();
    } else {
      out_.word('I', arc.center.x).word('J', arc.center.y).end_line();
    }
  }

  /// Down along a helix of full turns, then to and fro.
  void pocket(int moves) {
    approach(random_point());
    block("G01 Z0.5").word_of('F', 600).end_line();
    const int radius = random_.between(2'000, 6'000);
    int z = 500;
    for (int turn = 0; turn < 3; ++turn) {
      z -= 700;
      if (turn == 0) block("G03");
      out_.word('X', at_.x).word('Z', z).word('I', at_.x + radius).word('J', at_.y).end_line();
    }
    const int length = random_.between(8'000, 30'000) * (at_.x > 0 ? -1 : 1);
    const int pitch = random_.between(300, 1'500) * (at_.y > 0 ? -1 : 1);
    block("G01");
    for (int i = 0; i < moves - 8; ++i) {
      const bool across = i % 2 == 1;
      const int sign = i % 4 == 0 ? 1 : -1;
      move_to(at_ + (across ? Point{0, pitch} : Point{sign * length, 0}));
      if (i == 0) out_.word_of('F', 40 * random_.between(20, 90));
      out_.end_line();
      pause();
    }
    leave_sideways();
    retract();
  }

  void drill(int moves) {
    constexpr int kLinesPerHole = 4;
    const bool dwells = random_.one_in(2);
    const int z = -10 * random_.between(300, 3'000);
    const int holes = moves / kLinesPerHole + 1;
    approach(random_point());
    for (int hole = 0; hole < holes; ++hole) {
      if (hole > 0) move_to(hole == holes - 1 ? even(next_point()) : next_point()).end_line();
      block("G01").word('Z', z).word_of('F', 280).end_line();
      if (dwells) block("G04 P0.25").end_line();
      block("G00 Z2").end_line();
      pause();
    }
    retract();
  }

  void bore(int moves) {
    const Point center = random_point();
    const int radius = random_.between(5'000, 20'000);
    approach(center);
    int z = -500;
    block("G01").word('Z', z).word_of('F', 300).end_line();
    move_to(center + Point{radius, 0}).word_of('F', 900).end_line();
    block("G03");
    for (int turn = 0; turn < moves - 6; ++turn) {
      z -= 150;
      out_.word('X', at_.x).word('Z', z).word('I', center.x).word('J', center.y).end_line();
      pause();
    }
    block("G01");
    move_to(center).end_line();
    leave_sideways();
    retract();
  }

  /// Arcs in the ZX or the YZ plane, to and fro through a valley.
  void valley(int moves) {
    constexpr int kLinesPerPass = 2;
    const bool along_x = random_.one_in(2);
    const int scale = random_.between(40, 200);
    const Point half = scale * Point{63, 16};
    approach(random_point());
    block("G01 Z-0.8").word_of('F', 400).end_line();
    block(along_x ? "G18" : "G19").end_line();
    const int center = (along_x ? at_.x : at_.y) + half.x;
    for (int pass = 0; pass < moves / kLinesPerPass - 4; ++pass) {
      const bool forth = pass % 2 == 0;
      const int end = center + (forth ? half.x : -half.x);
      block(forth == along_x ? "G02" : "G03");
      out_.word(along_x ? 'X' : 'Y', end).word('Z', -800);
      out_.word(along_x ? 'I' : 'J', center).word('K', -800 + half.y);
      if (pass == 0) out_.word_of('F', 1'500);
      out_.end_line();
      at_ = along_x ? Point{end, at_.y} : Point{at_.x, end};
      block("G01");
      move_to(at_ + (along_x ? Point{0, 400} : Point{400, 0})).end_line();
      pause();
    }
    block("G17").end_line();
    leave_sideways();
    retract();
  }

  /// A contour on a face that the head is turned to.
  void tilted_face(int moves) {
    const int b = 500 * random_.step(-120, 120);
    const int c = 500 * random_.step(-300, 300);
    block("G00").word('B', b).word('C', c).end_line();
    block("G29").word('X', random_.between(0, 90'000)).word('Y', random_.between(0, 90'000));
    out_.word('Z', -random_.between(0, 20'000)).word('C', c).word('B', b).end_line();
    at_ = random_point();
    block("G00").word('X', at_.x).word('Y', at_.y).text("Z50").end_line();
    block("G00 Z2").end_line();
    contour_at_tool(moves - 8);
    retract();
    block("G27").end_line();
    block("G00 Z350").end_line();
    at_ = even(random_point());
    block("G00").word('X', at_.x).word('Y', at_.y).text("B0 C0").end_line();
    retract();
  }

  // The motions that they are made of.

  void approach(Point start) {
    at_ = start;
    block("G00").word('X', start.x).word('Y', start.y).end_line();
    block("G00 Z2").end_line();
  }

  /// Ends a path at an even X that is not the present one.
  void leave_sideways() { move_to(even(at_ + Point{3'000, 0})).end_line(); }

  void retract() { block("G00 Z50").end_line(); }

  /// The words of a motion to `point`, which differs from the present one.
  Writer& move_to(Point point) {
    if (point.x != at_.x) out_.word('X', point.x);
    if (point.y != at_.y) out_.word('Y', point.y);
    at_ = point;
    return out_;
  }

  Point random_point() { return {random_.between(-80'000, 80'000) | 1, random_.between(-80'000, 80'000)}; }

  static Point even(Point point) { return {point.x & ~1, point.y}; }

  /// A point near by. In X it is more than a rounding to even away.
  Point next_point() {
    const int distance = random_.between(3, 9'000);
    return {walk(at_.x, random_.one_in(2) ? distance : -distance, kReach),
            walk(at_.y, random_.between(-9'000, 9'000), kReach)};
  }

  /// Begins a line with the next number.
  Writer& block(std::string_view text) { return out_.word_of('N', number_++).text(text); }

  Writer& out_;
  Random& random_;
  Registers registers_;
  Options options_;
  int operation_ = 1;
  int number_ = 0;
  int written_options_ = 0;
  bool in_dependent_option_ = false;
  int setup_z_ = -120'000;
  Point at_;
};

}  // namespace

void write_production(Writer& out, Random& random, int lines) { Production(out, random, Options::None).write(lines); }

void write_production_if(Writer& out, Random& random, int lines) {
  Production(out, random, Options::Some).write(lines);
}

void write_hostile_if(Writer& out, Random& random, int lines) { Production(out, random, Options::All).write(lines); }

}  // namespace isocnc::bench
