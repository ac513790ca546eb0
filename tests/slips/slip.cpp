#include "slip.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <initializer_list>

#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::slips {

using support::Random;
using syntax::Span;

namespace {

/// The words of a line, from their letters to the ends of their numbers; comments lie outside.
std::vector<Span> words_of(const std::string& line) {
  std::vector<Span> words;
  const syntax::ParsedLine parsed(line);
  const syntax::LineTree tree = parsed.tree();
  for (const syntax::Word& word : tree.words) words.push_back(word.span());
  return words;
}

std::string text_of(const std::string& line, Span span) { return line.substr(span.begin, span.end - span.begin); }

std::string replaced(const std::string& line, std::size_t begin, std::size_t count, std::string_view by) {
  return std::string(line).replace(begin, count, by);
}

Slip on_line(std::size_t line, Lines lines) { return {.first = line, .removed = 1, .inserted = std::move(lines)}; }

/// The columns of the characters in words for which a function of the line and the column holds.
template <class Holds>
std::vector<std::size_t> columns_where(const std::string& line, Holds holds) {
  std::vector<std::size_t> columns;
  for (const Span word : words_of(line))
    for (std::size_t at = word.begin; at < word.end; ++at)
      if (holds(line, at)) columns.push_back(at);
  return columns;
}

/// Replaces one character for which `holds` by what `instead` makes of it.
template <class Holds, class Instead>
std::optional<Slip> replace_character(const Lines& program, Random& random, Holds holds, Instead instead) {
  const std::size_t line = random.below(program.size());
  const std::vector<std::size_t> columns = columns_where(program[line], holds);
  if (columns.empty()) return std::nullopt;
  const std::size_t at = columns[random.below(columns.size())];
  return on_line(line, {replaced(program[line], at, 1, instead(program[line][at]))});
}

auto is(char wanted) {
  return [wanted](const std::string& line, std::size_t at) { return line[at] == wanted; };
}

bool is_letter_of_number(const std::string& line, std::size_t at) {
  if (!std::isalpha(static_cast<unsigned char>(line[at]))) return false;
  std::size_t next = at + 1;
  while (next < line.size() && text::is_blank(line[next])) ++next;
  return next < line.size() && text::is_number_char(line[next]);
}

bool is_text(const std::string& line, std::size_t at) { return !text::is_blank(line[at]); }

std::optional<Slip> drop_word(const Lines& program, Random& random) {
  const std::size_t line = random.below(program.size());
  const std::vector<Span> words = words_of(program[line]);
  if (words.empty()) return std::nullopt;
  const Span word = words[random.below(words.size())];
  return on_line(line, {replaced(program[line], word.begin, word.end - word.begin, "")});
}

std::optional<Slip> double_word(const Lines& program, Random& random) {
  const std::size_t line = random.below(program.size());
  const std::vector<Span> words = words_of(program[line]);
  if (words.empty()) return std::nullopt;
  const Span word = words[random.below(words.size())];
  return on_line(line, {replaced(program[line], word.end, 0, " " + text_of(program[line], word))});
}

std::optional<Slip> swap_words(const Lines& program, Random& random) {
  const std::size_t line = random.below(program.size());
  const std::vector<Span> words = words_of(program[line]);
  if (words.size() < 2) return std::nullopt;
  const std::size_t at = random.below(words.size() - 1);
  const Span first = words[at];
  const Span second = words[at + 1];
  const std::string& text = program[line];
  return on_line(
      line, {text.substr(0, first.begin) + text_of(text, second) + text.substr(first.end, second.begin - first.end) +
             text_of(text, first) + text.substr(second.end)});
}

std::optional<Slip> write_o_for_zero(const Lines& program, Random& random) {
  return replace_character(program, random, is('0'), [](char) { return "O"; });
}

std::optional<Slip> write_comma(const Lines& program, Random& random) {
  return replace_character(program, random, is('.'), [](char) { return ","; });
}

std::optional<Slip> double_point(const Lines& program, Random& random) {
  return replace_character(program, random, is('.'), [](char) { return ".."; });
}

std::optional<Slip> lose_letter(const Lines& program, Random& random) {
  return replace_character(program, random, is_letter_of_number, [](char) { return ""; });
}

std::optional<Slip> lose_sign(const Lines& program, Random& random) {
  return replace_character(program, random, is('-'), [](char) { return ""; });
}

std::optional<Slip> write_typographic_minus(const Lines& program, Random& random) {
  const bool is_dash = random.one_in(2);
  return replace_character(program, random, is('-'), [&](char) { return is_dash ? "\u2013" : "\u2212"; });
}

std::optional<Slip> lose_character(const Lines& program, Random& random) {
  return replace_character(program, random, is_text, [](char) { return ""; });
}

std::optional<Slip> double_character(const Lines& program, Random& random) {
  return replace_character(program, random, is_text, [](char it) { return std::string(2, it); });
}

std::optional<Slip> change_case(const Lines& program, Random& random) {
  const auto is_letter = [](const std::string& line, std::size_t at) {
    return std::isalpha(static_cast<unsigned char>(line[at])) != 0;
  };
  return replace_character(program, random, is_letter,
                           [](char it) { return std::string(1, static_cast<char>(it ^ ('a' - 'A'))); });
}

std::optional<Slip> swap_digits(const Lines& program, Random& random) {
  const std::size_t line = random.below(program.size());
  const auto are_two_digits = [](const std::string& text, std::size_t at) {
    return at + 1 < text.size() && text::is_digit(text[at]) && text::is_digit(text[at + 1]) && text[at] != text[at + 1];
  };
  const std::vector<std::size_t> columns = columns_where(program[line], are_two_digits);
  if (columns.empty()) return std::nullopt;
  const std::size_t at = columns[random.below(columns.size())];
  std::string text = program[line];
  std::swap(text[at], text[at + 1]);
  return on_line(line, {text});
}

/// The keys around a digit on a keypad.
std::string_view digits_beside(char digit) {
  static constexpr std::array<std::string_view, 10> kBeside = {"12",   "024", "0135", "26",  "157",
                                                               "2468", "359", "48",   "579", "68"};
  return kBeside[static_cast<std::size_t>(digit - '0')];
}

std::optional<Slip> write_neighbor_g(const Lines& program, Random& random) {
  const auto is_digit_of_g = [](const std::string& line, std::size_t at) {
    if (!text::is_digit(line[at])) return false;
    while (at > 0 && (text::is_digit(line[at]) || text::is_blank(line[at]))) --at;
    return text::upper(line[at]) == 'G';
  };
  return replace_character(program, random, is_digit_of_g, [&](char digit) {
    const bool is_next = random.one_in(2);
    const char beside = random.any_of(digits_beside(digit));
    return std::string(1, !is_next ? beside : digit == '9' ? '8' : static_cast<char>(digit + 1));
  });
}

/// The keys beside a letter on a keyboard, as far as they are letters.
std::string_view letters_beside(char letter) {
  static constexpr std::array<std::string_view, 26> kBeside = {"SQZ", "VN", "XV", "SF", "WR", "DG", "FH", "GJ", "UO",
                                                               "HK",  "JL", "K",  "N",  "BM", "IP", "O",  "WA", "ET",
                                                               "AD",  "RY", "YI", "CB", "QE", "ZC", "TU", "AX"};
  return kBeside[static_cast<std::size_t>(letter - 'A')];
}

std::optional<Slip> write_neighbor_letter(const Lines& program, Random& random) {
  return replace_character(program, random, is_letter_of_number, [&](char letter) {
    return std::string(1, random.any_of(letters_beside(text::upper(letter))));
  });
}

std::optional<Slip> lose_line_break(const Lines& program, Random& random) {
  if (program.size() < 2) return std::nullopt;
  const std::size_t line = random.below(program.size() - 1);
  return Slip{.first = line, .removed = 2, .inserted = {program[line] + program[line + 1]}};
}

std::optional<Slip> break_line(const Lines& program, Random& random) {
  const std::size_t line = random.below(program.size());
  const std::vector<Span> words = words_of(program[line]);
  if (words.size() < 2) return std::nullopt;
  const std::size_t at = words[1 + random.below(words.size() - 1)].begin;
  return on_line(line, {program[line].substr(0, at), program[line].substr(at)});
}

std::optional<Slip> move_word_down(const Lines& program, Random& random) {
  if (program.size() < 2) return std::nullopt;
  const std::size_t line = random.below(program.size() - 1);
  const std::vector<Span> words = words_of(program[line]);
  if (words.empty()) return std::nullopt;
  const Span last = words.back();
  return Slip{.first = line,
              .removed = 2,
              .inserted = {replaced(program[line], last.begin, last.end - last.begin, ""),
                           text_of(program[line], last) + " " + program[line + 1]}};
}

std::optional<Slip> repeat_line(const Lines& program, Random& random) {
  const std::size_t line = random.below(program.size());
  return on_line(line, {program[line], program[line]});
}

std::optional<Slip> lose_line(const Lines& program, Random& random) {
  return on_line(random.below(program.size()), {});
}

/// Blocks that stay in a program that was written for another control.
constexpr std::string_view kForeignBlocks[] = {"%",
                                               "O1234",
                                               "G54",
                                               "G28 U0 W0",
                                               "G28 X0 Y0",
                                               "G91 G28 Z0",
                                               "G30 Z0",
                                               "G43 H1 Z50",
                                               "G43 H1",
                                               "G49",
                                               "G53 Z0",
                                               "G20",
                                               "G21",
                                               "G17 G21 G40 G49 G80 G90",
                                               "G80",
                                               "G81 X10 Y10 Z-5 R2 F100",
                                               "G83 Z-10 Q2 R2 F200",
                                               "G68 X0 Y0 R45",
                                               "G69",
                                               "G95 F0.2",
                                               "G96 S200",
                                               "G97",
                                               "G64 P0.01",
                                               "G4 F2",
                                               "G04 X1.5",
                                               "T1 M6",
                                               "T1 D1",
                                               "T5",
                                               "M6 T5",
                                               "M00",
                                               "M01",
                                               "M08",
                                               "M30",
                                               "M98 P1000",
                                               "M99",
                                               "#1=5",
                                               "#101=#102+1",
                                               "R1=10",
                                               "WHILE [#1 LT 10] DO1",
                                               "END1",
                                               "IF [#1 EQ 1] GOTO 10",
                                               "TRANS X100 Y50",
                                               "CALL SUB1",
                                               "L X+10 Y+5 R0 F100",
                                               "TOOL CALL 5 Z S3000",
                                               "CYCL DEF 7.0",
                                               "MSG(\"end\")",
                                               "S1=5000 M1=3",
                                               "G41 D1",
                                               "G90 G54 G0 X0 Y0"};

std::optional<Slip> copy_foreign_block(const Lines& program, Random& random) {
  const std::string_view block = kForeignBlocks[random.below(std::size(kForeignBlocks))];
  return Slip{.first = random.below(program.size() + 1), .removed = 0, .inserted = {std::string(block)}};
}

constexpr SlipKind kKinds[] = {
    {"word dropped", drop_word},
    {"word doubled", double_word},
    {"words swapped", swap_words},
    {"word moved down", move_word_down},
    {"letter O for zero", write_o_for_zero},
    {"comma for point", write_comma},
    {"point doubled", double_point},
    {"letter lost", lose_letter},
    {"neighbor letter", write_neighbor_letter},
    {"upper or lower case", change_case},
    {"digits swapped", swap_digits},
    {"sign lost", lose_sign},
    {"typographic minus", write_typographic_minus},
    {"neighbor G", write_neighbor_g},
    {"character lost", lose_character},
    {"character doubled", double_character},
    {"line break lost", lose_line_break},
    {"line broken", break_line},
    {"line repeated", repeat_line},
    {"line lost", lose_line},
    {"foreign block", copy_foreign_block},
};

}  // namespace

std::span<const SlipKind> slip_kinds() { return kKinds; }

Lines slipped(const Lines& program, const Slip& slip) {
  const auto first = program.begin() + static_cast<std::ptrdiff_t>(slip.first);
  Lines lines(program.begin(), first);
  lines.insert(lines.end(), slip.inserted.begin(), slip.inserted.end());
  lines.insert(lines.end(), first + static_cast<std::ptrdiff_t>(slip.removed), program.end());
  return lines;
}

}  // namespace isocnc::slips
