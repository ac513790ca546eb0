// A program with one mistake on each line.

#include <iterator>
#include <string_view>

#include "bench/corpora/arc.h"
#include "bench/corpora/corpora.h"

namespace isocnc::bench {

namespace {

constexpr int kReach = 100'000;

/// Writes lines that are wrong in one way each, whatever the reader takes as the result of the lines before: every
/// motion names its G, its X and its Y.
class Mistakes {
 public:
  Mistakes(Writer& out, Random& random) : out_(out), random_(random) {}

  void write_line() {
    if (random_.one_in(4)) return write_arc_line();
    if (random_.one_in(3)) return write_line_without_motion();
    write_linear_line();
  }

 private:
  void write_linear_line() {
    static constexpr struct {
      std::string_view command, tail;
    } kLines[] = {
        {"G01", "Z1.2.3"},       // ISO006
        {"G01", "Z1,5"},         // ISO006
        {"G01", "A12.5"},        // ISO011
        {"G01", "I3.25"},        // ISO011
        {"S9000 G01", "S8000"},  // ISO046
        {"G01", "X250.75"},      // ISO016
        {"G01", "F900 F950"},    // ISO065
        {"G01", "F0"},           // ISO042
        {"G01", "Z"},            // ISO004
        {"12.5 G01", ""},        // ISO005
        {"G01", "G90"},          // ISO061
        {"U5.2 G01", ""},        // ISO003
        {"# G01", ""},           // ISO003
        {"N-5 G01", ""},         // ISO056
        {"G01", "(left open"},   // ISO001
    };
    if (random_.one_in(16)) return feed("G01").word('B', next_angle()).end_line();  // ISO032
    const auto& line = kLines[random_.between(0, static_cast<int>(std::size(kLines)) - 1)];
    feed(line.command);
    if (!line.tail.empty()) out_.text(line.tail);
    out_.end_line();
  }

  void write_arc_line() {
    static constexpr std::string_view kTails[] = {
        "",         // ISO028
        "R-2.5",    // ISO030
        "I0 J0 K5"  // ISO038
    };
    switch (random_.between(1, 6)) {
      case 1:
        return out_.text("G03").word('X', any()).text("I0").end_line();  // ISO048
      case 2:
        return out_.line("G02 Z-5 I1 J1");  // ISO027
      case 3:
        return write_mismatched_arc();  // ISO031
      default:
        feed(random_.one_in(2) ? "G02" : "G03");
        if (const std::string_view tail = kTails[random_.between(0, 2)]; !tail.empty()) out_.text(tail);
        out_.end_line();
    }
  }

  void write_line_without_motion() {
    static constexpr std::string_view kLines[] = {
        "G01",                         // ISO026
        "G1000",                       // ISO007
        "G1.5",                        // ISO007
        "M1000",                       // ISO008
        "T101001",                     // ISO054
        "S0",                          // ISO015
        "S1000 )",                     // ISO002
        "G04",                         // ISO064
        "G04 P-1",                     // ISO036
        "G92",                         // ISO025
        "V5",                          // ISO063
        "V31 = 2.5",                   // ISO059
        "V1.5 = 2",                    // ISO057
        "G55",                         // E001
        "IF VGPL = 5 GOTO N12345678",  // E004
        "M100 P21=5",                  // E008
    };
    out_.line(kLines[random_.between(0, static_cast<int>(std::size(kLines)) - 1)]);
  }

  /// The end lies far out, on the left and on the right in turn, and the center beside it: wherever the arc starts, it
  /// is not as near.
  void write_mismatched_arc() {
    far_right_ = !far_right_;
    const int x = (far_right_ ? 1 : -1) * (2 * kReach + any_positive());
    const int y = any();
    out_.text("G02").word('X', x).word('Y', y).word('I', x + 1'000).word('J', y).end_line();
  }

  Writer& feed(std::string_view command) { return out_.text(command).word('X', any()).word('Y', any()); }

  int any() { return random_.between(-kReach, kReach); }
  int any_positive() { return random_.between(1, kReach); }

  /// One that the axis does not have, whether or not the earlier ones were taken.
  int next_angle() { return angle_ = angle_ % 90'000 + 1; }

  Writer& out_;
  Random& random_;
  bool far_right_ = false;
  int angle_ = 0;
};

}  // namespace

void write_errors(Writer& out, Random& random, int lines) {
  constexpr int kEndLines = 3;
  out.line("(ONE MISTAKE ON EVERY LINE)");
  out.line("M06 T101001");
  out.line("S12000 M03");
  out.line("G00 X0 Y0 Z5");
  out.line("G01 Z-1 F1200");
  Mistakes mistakes(out, random);
  while (out.lines() < lines - kEndLines) mistakes.write_line();
  out.line("G00 Z50");
  out.line("M05");
  out.line("M02");
}

}  // namespace isocnc::bench
