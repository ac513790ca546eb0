#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "analyzer/check/check_text.h"
#include "analyzer/formatting/program_formatter.h"
#include "interpreter/running/runner.h"
#include "tests/support/random_program.h"
#include "tests/support/report_text.h"

namespace isocnc::formatting {
namespace {

using support::Random;
using support::random_lines;

struct NamedStyle {
  std::string name;
  ProgramStyle style;
};

const std::vector<NamedStyle>& styles() {
  static const std::vector<NamedStyle> all = {
      {"default", {}},
      {"decimals", {.line = {.max_decimals = 2}}},
      {"one digit", {.line = {.g_digits = syntax::GDigits::One}}},
      {"two digits", {.line = {.g_digits = syntax::GDigits::Two}}},
      {"word order", {.line = {.word_order = true}}},
      {"write", {.motions = MotionStyle::Write}},
      {"fold", {.motions = MotionStyle::Fold}},
      {"renumber", {.numbers = NumberStyle{.start = 7, .step = 3}}},
      {"renumber all", {.numbers = NumberStyle{.all_lines = true}}},
      {"everything",
       {.line = {.max_decimals = 3, .g_digits = syntax::GDigits::Two, .word_order = true},
        .motions = MotionStyle::Write,
        .numbers = NumberStyle{.all_lines = true}}},
  };
  return all;
}

/// Programs with blanks, comments, zeros and lower case at any place.
std::string untidy(Random& random, const std::string& line) {
  std::string text;
  char comment = 0;
  for (const char c : line) {
    const bool is_continuation = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    if (comment == 0 && !is_continuation) {
      if (random.one_in(8)) text += random.any_of({" ", "\t", "   ", "(a)", " (\xE9;) "});
      if (c == '.' && random.one_in(2)) text += "0";
    }
    if (comment == 0 && (c == '(' || c == ';')) comment = c;
    text += c >= 'A' && c <= 'Z' && comment == 0 && random.one_in(4) ? static_cast<char>(c - 'A' + 'a') : c;
    if (comment == '(' && c == ')') comment = 0;
  }
  return text;
}

std::string random_text(Random& random) {
  std::vector<std::string> lines = random_lines(random, 60);
  for (std::string& line : lines)
    if (random.one_in(2)) line = untidy(random, line);
  std::string text = support::joined(lines, random.any_of({"\n", "\r\n", "\r"}));
  if (random.one_in(4) && !text.empty()) text.pop_back();
  return text;
}

/// Nothing where the program cannot be renumbered.
std::optional<std::string> formatted_text(const std::string& text, const ProgramStyle& style) {
  ProgramFormatter formatter(text, style);
  if (formatter.obstacle()) return std::nullopt;
  std::string formatted;
  while (const auto piece = formatter.next()) formatted += piece->after;
  return formatted;
}

/// All that a program does, to its M02 or its first error.
std::string events_of(const std::string& text, double vgpl, bool stop_at_errors) {
  std::string events;
  running::RunOptions options{.vgpl = vgpl, .stop_at_errors = stop_at_errors};
  const running::RunResult result =
      running::run(text, options, [&](const running::Event& event) { events += running::to_json(event) + '\n'; });
  events += fmt::format("ending {} line {}", static_cast<int>(result.ending), result.line);
  if (result.ending == running::Ending::Error) events += dialect::definition(result.error.id).code;
  for (const double value : result.registers) events += fmt::format(" {}", value);
  return events;
}

/// The codes by line, in their order; those below the first error only if wanted.
std::vector<std::string> codes_of(const std::string& text, bool below_errors) {
  std::vector<std::string> codes;
  std::optional<std::uint64_t> error;
  for (const check::LocatedFinding& located : check::check_text(text, {}).findings) {
    if (error && located.line > *error && !below_errors) break;
    codes.push_back(fmt::format("{}: {}", located.line, dialect::definition(located.finding.id).code));
    if (!error && located.severity() == dialect::Severity::Error) error = located.line;
  }
  return codes;
}

/// Line ends alone.
std::string ends_of(const std::string& text) {
  std::string ends;
  for (const char c : text)
    if (c == '\r' || c == '\n') ends += c;
  return ends;
}

TEST(ProgramFormatterProperty, WhatAProgramDoesStaysAsItIs) {
  int renumbered = 0;
  for (const std::uint64_t seed : support::seeds(1'500)) {
    Random random(seed);
    const std::string text = random_text(random);
    const double vgpl = random.between(0, 4);
    for (const auto& [name, style] : styles()) {
      const std::optional<std::string> formatted = formatted_text(text, style);
      if (!formatted) continue;
      renumbered += style.numbers ? 1 : 0;
      for (const bool stop_at_errors : {true, false})
        ASSERT_EQ(events_of(*formatted, vgpl, stop_at_errors), events_of(text, vgpl, stop_at_errors))
            << "seed " << seed << ", " << name << "\n"
            << text << "\n---\n"
            << *formatted;
    }
  }
  EXPECT_GT(renumbered, static_cast<int>(support::often(300)));
}

TEST(ProgramFormatterProperty, FindingsStayAsTheyAre) {
  for (const std::uint64_t seed : support::seeds(1'500)) {
    Random random(seed);
    const std::string text = random_text(random);
    for (const auto& [name, style] : styles()) {
      const std::optional<std::string> formatted = formatted_text(text, style);
      if (!formatted) continue;
      // A number or a motion G at the start of a line says that a block begins there. Without it, the words may be
      // those that the line above lacks.
      const bool below_errors = style.motions == MotionStyle::Keep && (!style.numbers || !style.numbers->all_lines);
      std::vector<std::string> codes = codes_of(*formatted, below_errors);
      std::vector<std::string> wanted = codes_of(text, below_errors);
      if (name != "default") {  // Else their columns may come in another order.
        std::sort(codes.begin(), codes.end());
        std::sort(wanted.begin(), wanted.end());
      }
      ASSERT_EQ(codes, wanted) << "seed " << seed << ", " << name << "\n" << text << "\n---\n" << *formatted;
    }
  }
}

TEST(ProgramFormatterProperty, ASecondTimeChangesNothing) {
  for (const std::uint64_t seed : support::seeds(1'500)) {
    Random random(seed);
    const std::string text = random_text(random);
    for (const auto& [name, style] : styles()) {
      const std::optional<std::string> once = formatted_text(text, style);
      if (!once) continue;
      ASSERT_EQ(formatted_text(*once, style), once) << "seed " << seed << ", " << name << "\n" << text;
      ASSERT_EQ(ends_of(*once), ends_of(text)) << "seed " << seed << ", " << name;
    }
  }
}

/// With one blank for many: a comment that was pushed on does not come back.
std::string squeezed(std::string text) {
  text.erase(std::unique(text.begin(), text.end(), [](char a, char b) { return a == ' ' && b == ' '; }), text.end());
  return text;
}

TEST(ProgramFormatterProperty, MotionsWrittenOutCanBeFoldedAgain) {
  const ProgramStyle write{.motions = MotionStyle::Write};
  const ProgramStyle fold{.motions = MotionStyle::Fold};
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    const std::string text = random_text(random);
    ASSERT_EQ(squeezed(*formatted_text(*formatted_text(text, write), fold)), squeezed(*formatted_text(text, fold)))
        << "seed " << seed << "\n"
        << text;
  }
}

}  // namespace
}  // namespace isocnc::formatting
