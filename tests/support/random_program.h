#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpreter/syntax/tree_store.h"
#include "tests/support/random.h"

namespace isocnc::support {

/// Writes programs with all features of the dialect, valid and invalid, line by line.
class RandomProgram {
 public:
  explicit RandomProgram(Random& random) : random_(random) {}

  /// Labels are drawn from N1 to this one: few give repeated and backward ones, many give missing ones.
  int labels = 12;
  /// One line in `jump_chances` is an IF, and one in `end_chances` ends the program.
  int jump_chances = 12;
  int end_chances = 60;

  std::vector<std::string> lines(int count) {
    std::vector<std::string> all;
    if (!random_.one_in(5)) all = {"M06 T101001 M3 S12000", "G1 Z5 F2000"};
    for (int i = 0; i < count; ++i) all.push_back(line());
    if (!random_.one_in(4)) all.push_back("M02");
    return all;
  }

  std::string line() {
    std::string text = statement();
    if (random_.one_in(12)) text = fmt::format("N{} {}", random_.between(1, labels), text);
    if (random_.one_in(15)) text += random_.any_of({" (note)", " ; note", "(unclosed", " ) stray"});
    if (random_.one_in(25)) text = lower(std::move(text));
    return text;
  }

 private:
  std::string statement() {
    if (random_.one_in(jump_chances)) return jump();
    if (random_.one_in(end_chances)) return "M02";
    switch (random_.between(0, 15)) {
      case 0:
      case 1:
      case 2:
        return fmt::format("G{}{}{}", random_.between(0, 1), coordinates(), feed());
      case 3:
      case 4:
        return coordinates();
      case 5:
      case 6:
        return arc();
      case 7:
        return half_circle();
      case 8:
        return std::string(random_.any_of({"G90", "G91", "G70", "G71", "G17", "G18", "G19", "G93", "G94", "G48", "G49",
                                           "G38", "G39", "G40", "G41", "G42", "G90 G71", "G91 G70"}));
      case 9:
        return frame();
      case 10:
        return fmt::format("M06 T{}{}{:02}{:03}", random_.one_in(4) ? " " : "", random_.between(0, 2),
                           random_.between(0, 3), random_.between(0, 9));
      case 11:
        return fmt::format("V{}={}", random_.between(1, 4), random_.between(0, 4));
      case 12:
        return std::string(random_.any_of({"G09", "G200", "G909", "G990", "M3", "M5", "S8000", "F1500", "G04 P1.5",
                                           "M100 P1=2 P2=-3", "G04", "M100 P1=2 X1", "F0", "S-1", "W1"}));
      case 13:
        return mistake();
      case 14:
        return std::string(random_.any_of({"", " ", "(comment)", "; comment", "N900"}));
      default:
        return random_.one_in(3) ? noise()
                                 : fmt::format("G1{}{}{}", coordinates(), feed(), random_.one_in(3) ? " G09" : "");
    }
  }

  std::string number() {
    switch (random_.between(0, 5)) {
      case 0:
        return fmt::format("{}.{}", random_.between(-20, 20), random_.between(0, 99));
      case 1:
        return fmt::format("{}", random_.between(-200, 200));
      case 2:
        return "0";
      default:
        return fmt::format("{}", 10 * random_.between(-5, 5));
    }
  }

  std::string coordinates() {
    std::string text;
    for (const char axis : {'X', 'Y', 'Z'})
      if (!random_.one_in(3)) text += fmt::format(" {}{}", axis, number());
    if (random_.one_in(10)) text += fmt::format(" {}{}", random_.any_of("BC"), number());
    return text;
  }

  std::string feed() { return random_.one_in(6) ? fmt::format(" F{}", 100 * random_.between(1, 30)) : ""; }

  std::string arc() {
    std::string text = fmt::format("G{}{}", random_.between(2, 3), coordinates());
    if (random_.one_in(2)) return text + fmt::format(" R{}", number());
    for (const char axis : {'I', 'J', 'K'})
      if (!random_.one_in(3)) text += fmt::format(" {}{}", axis, number());
    return text;
  }

  /// A half circle that is valid in G91 at any position; in G90 it is usually invalid.
  std::string half_circle() {
    const int radius = random_.between(1, 30);
    return fmt::format("G91 G{} X{} Y0 I{} J0", random_.between(2, 3), 2 * radius, radius);
  }

  std::string frame() {
    switch (random_.between(0, 6)) {
      case 0:
        return fmt::format("G24{} I1 J0 K0 P0 Q1 R0 A0 B0 C1", coordinates());
      case 1:
        return "G28 I1 J0 K0 X1 Y1 Z0 P0 Q0 R1";
      case 2:
        return fmt::format("G29{} B{} C{}", coordinates(), 45 * random_.between(0, 4), 90 * random_.between(0, 4));
      case 3:
        return fmt::format("G92{}", coordinates());
      case 4:
        return fmt::format("G24 X1{}", arc());
      default:
        return "G27";
    }
  }

  std::string jump() {
    const std::string left = random_.one_in(3) ? "VGPL" : fmt::format("V{}", random_.between(1, 4));
    return fmt::format("IF {}{}{} GOTO N{}{}", left, random_.any_of({"=", "<", ">", "<=", ">=", "<>"}),
                       random_.between(0, 4), random_.between(1, labels), random_.one_in(20) ? " X1" : "");
  }

  std::string mistake() {
    return std::string(random_.any_of({"G1 X1.2.3",
                                       "G1 X1,5",
                                       "X",
                                       "G1000",
                                       "M0",
                                       "M1000",
                                       "M06",
                                       "M06 T13",
                                       "T101001",
                                       "G1 X1 X2",
                                       "F1 F2",
                                       "S1 S2",
                                       "N1 N2",
                                       "N-1",
                                       "G77",
                                       "%#12",
                                       "5",
                                       "V31=1",
                                       "V1.5=2",
                                       "V1",
                                       "V=5",
                                       "=5",
                                       "X=5",
                                       "IF V1 GOTO",
                                       "IF V1=1",
                                       "GOTO N1",
                                       "IF VGPL=1 GOTO N1 G0",
                                       "IF V99=1 GOTO N1",
                                       "G0 G1 X1",
                                       "G1",
                                       "G2 X1",
                                       "G1 A5 X1",
                                       "G1 S500 X1",
                                       "G1 X1 S500 Z5",
                                       "X10 G1",
                                       "G1 X1 G70",
                                       "X1 G91",
                                       "G27 X1",
                                       "G28",
                                       "G29",
                                       "G92",
                                       "G49 X1",
                                       "G04 P-1",
                                       "M100 P1=2 P1=3",
                                       "M3 P1=2",
                                       "M02 X1",
                                       "G41 X1",
                                       "X1 G40 G1",
                                       "G24 X1 I0 J0 K0 P0 Q1 R0 A0 B0 C1",
                                       "G24 X1 I1 J0 K0 P1 Q0 R0 A0 B0 C1",
                                       "G1 I5 X1",
                                       "G2 X1 Y1 K5",
                                       "\xC3\xA8 X1",
                                       "X1 \xE2\x82\xAC",
                                       "IF",
                                       "VGPL",
                                       "G1 X1 (a) G9",
                                       "90 X5",
                                       "29 X1 C90",
                                       "2=1",
                                       "pausa 2 s",
                                       "GOTO N1O",
                                       "G1 X\xE2\x88\x92"
                                       "5 Y1",
                                       "IF V1<\xE2\x80\x93"
                                       "1 GOTO N2",
                                       "N1 G0 X1 N2 G1 X2",
                                       "N3 IF V1=2 GOTO N4 N5 V1=3",
                                       "N6 V2=1 N7 IF V2=1 GOTO N8",
                                       "N9 IF VGPL=1 GOTO N10 N11 IF V3<2 GOTO N12",
                                       "N10 M02 N12 G1 X3"}));
  }

  std::string noise() {
    std::string text;
    for (int i = random_.between(1, 12); i > 0; --i)
      text += random_.any_of({"G",  "M", "T",        "X", "N", "V",  "IF", "GOTO", "VGPL", "=",   "<",
                              ">",  ".", "-",        "+", ",", "1",  "06", "(",    ")",    ";",   " ",
                              "\t", "#", "\xC3\xA8", "F", "S", "P1", "R5", "O",    "I",    "\xFF"});
    return text;
  }

  static std::string lower(std::string text) {
    for (char& c : text)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
  }

  Random& random_;
};

inline std::string joined(const std::vector<std::string>& lines, std::string_view line_end = "\n") {
  std::string text;
  for (const std::string& line : lines) text.append(line).append(line_end);
  return text;
}

/// The lines of a program of up to `max` random lines. Half of the programs have few mistakes, so that more than a few
/// blocks run.
inline std::vector<std::string> random_lines(Random& random, int max) {
  RandomProgram program(random);
  program.labels = random.one_in(2) ? 12 : 100;
  program.end_chances = random.one_in(2) ? 60 : 1'000;
  std::vector<std::string> lines = program.lines(random.between(1, max));
  if (random.one_in(2))
    std::erase_if(lines, [](const std::string& line) { return !syntax::ParsedLine(line).tree().findings.empty(); });
  return lines;
}

}  // namespace isocnc::support
