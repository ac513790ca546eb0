#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "analyzer/check/check_text.h"
#include "analyzer/check/checker.h"
#include "interpreter/text/characters.h"
#include "tests/support/random_program.h"
#include "tests/support/report_text.h"

namespace isocnc::check {
namespace {

using support::Random;
using support::RandomProgram;

Report check(const std::string& text, int jobs = 1) { return check_text(text, {}, jobs); }

/// More than 200 KB, so that threads have something to share; about one in three ends early. Where jumps are few,
/// threads execute ahead.
std::string long_program(Random& random) {
  RandomProgram program(random);
  program.jump_chances = std::array{40, 400, 20'000}[static_cast<std::size_t>(random.between(0, 2))];
  program.labels = random.one_in(2) ? 12 : 600;
  program.end_chances = random.one_in(3) ? 3'000 : 1'000'000;
  std::string text;
  while (text.size() < 200'000) text += support::joined(program.lines(1'000 - random.between(0, 10)));
  if (random.one_in(2)) std::replace(text.begin(), text.end(), '\n', '\r');
  return text;
}

TEST(CheckTextProperty, AnyNumberOfJobsGivesTheSameReport) {
  for (const std::uint64_t seed : support::seeds(12)) {
    Random random(seed);
    const std::string text = long_program(random);
    const std::vector<std::string> expected = support::texts_of(check(text));
    for (const int jobs : {2, 3, 8})
      EXPECT_EQ(support::texts_of(check(text, jobs)), expected) << "seed " << seed << ", jobs " << jobs;
  }
}

TEST(CheckTextProperty, JobsAgreeWhereTheProgramEndsEarly) {
  std::string text = "M06 T101001\nIF VGPL=1 GOTO N5\nM02\n";
  while (text.size() < 300'000) text += "G1 X1 X2\n";
  text += "N5 G1 X1\nM02\n";
  while (text.size() < 600'000) text += "G1 X1 X2\n";
  const std::vector<std::string> expected = support::texts_of(check(text));
  EXPECT_EQ(expected.size(), 3u);  // X1 X2 after the label, and two stretches that never run.
  for (const int jobs : {2, 3, 8}) EXPECT_EQ(support::texts_of(check(text, jobs)), expected) << "jobs " << jobs;
}

TEST(CheckTextProperty, TellsHowFarItIs) {
  std::string text = "M06 T101001\n";
  while (text.size() < 600'000) text += "G00 X1\nG00 X2\n";
  for (const std::string& program : {text, "IF VGPL=1 GOTO N5\nIF VGPL=2 GOTO N5\n" + text + "N5\n"})
    for (const int jobs : {1, 3}) {
      std::size_t bytes = 0;
      int times = 0;
      check_text(program, {}, jobs, [&](std::size_t now) {
        EXPECT_GT(now, bytes);
        bytes = now;
        ++times;
      });
      EXPECT_EQ(bytes, program.size()) << jobs;
      EXPECT_GT(times, 5) << jobs;
    }
}

TEST(CheckTextProperty, LineEndsChangeNothing) {
  for (const std::uint64_t seed : support::seeds(600)) {
    Random random(seed);
    const std::vector<std::string> lines = RandomProgram(random).lines(random.between(1, 80));
    const std::vector<std::string> expected = support::texts_of(check(support::joined(lines, "\n")));
    EXPECT_EQ(support::texts_of(check(support::joined(lines, "\r"))), expected) << "seed " << seed << ", CR";
    EXPECT_EQ(support::texts_of(check(support::joined(lines, "\r\n"))), expected) << "seed " << seed << ", CRLF";
  }
}

/// A program with rows of motions, and numbers alone among them.
std::string program_of_rows(Random& random) {
  std::vector<std::string> lines = RandomProgram(random).lines(random.between(1, 60));
  for (std::string& line : lines) {
    if (random.one_in(5)) line = random.any_of({"N900", "N7 ; note", "N5 (note)", "; note", ""});
    if (random.one_in(9)) line = "M08";
    if (random.one_in(4)) line = random.any_of({"X1", "G1 Y2", "Z3"});
  }
  return support::joined(lines);
}

/// Rows of lines are checked at once. That must be as if each line was checked by itself, by the way of all lines.
TEST(CheckTextProperty, RowsGiveWhatTheirLinesGive) {
  const dialect::HouseWatch watch{.rule = "coolant",
                                  .reported = {{.kind = dialect::HouseEvent::Kind::M, .number = 8}},
                                  .started = {{.kind = dialect::HouseEvent::Kind::Motion}}};
  const auto house_rules = std::make_shared<rules::HouseRules>(std::vector{watch});
  std::size_t in_rows = 0;
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    rules::CheckSetup setup;
    if (random.one_in(2)) setup.house_rules = house_rules;
    const std::string program = program_of_rows(random);
    const char* const end = program.data() + program.size();
    const JumpMap jumps(program);
    syntax::TreeStore trees;
    trees.append_lines(program.data(), end, end);
    Checker by_rows(setup, jumps);
    Checker by_lines(setup, jumps);
    Outcome of_rows;
    Outcome of_lines;
    const char* start = program.data();
    for (std::size_t line = 0; line < trees.size(); ++line) {
      for (std::size_t done = by_rows.check_plain_lines(trees, line, line, of_rows); done > 0; --done, ++line) {
        by_lines.check_any(trees.tree(line, start), line, of_lines);
        start = text::skip_line_end(start + trees.length(line), end);
        ++in_rows;
      }
      ASSERT_TRUE(by_rows.frontier == by_lines.frontier) << "seed " << seed << ", line " << line;
      if (line == trees.size()) break;
      by_rows.check_any(trees.tree(line, start), line, of_rows);
      by_lines.check_any(trees.tree(line, start), line, of_lines);
      start = text::skip_line_end(start + trees.length(line), end);
    }
    EXPECT_EQ(of_rows.last_text_line, of_lines.last_text_line) << "seed " << seed;
    EXPECT_EQ(of_rows.has_text, of_lines.has_text) << "seed " << seed;
    ASSERT_EQ(of_rows.findings.size(), of_lines.findings.size()) << "seed " << seed;
    for (std::size_t i = 0; i < of_rows.findings.size(); ++i)
      EXPECT_TRUE(of_rows.findings[i].finding == of_lines.findings[i].finding) << "seed " << seed;
  }
  EXPECT_GT(in_rows, support::often(2'000));
}

/// A line with blanks put in, and where each of its characters went.
struct SpacedLine {
  std::string text;
  std::vector<std::uint32_t> places;

  syntax::Span map(syntax::Span span) const {
    if (span.empty()) return span;
    return {places[span.begin], places[span.end - 1] + 1};
  }
};

/// Whether a blank may be put before each character: outside comments, and not inside a UTF-8 sequence.
std::vector<bool> free_places(const std::string& line) {
  std::vector<bool> free(line.size());
  char comment = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_continuation = (static_cast<unsigned char>(line[i]) & 0xC0) == 0x80;
    free[i] = comment == 0 && !is_continuation;
    if (comment == 0 && (line[i] == '(' || line[i] == ';')) {
      comment = line[i];
    } else if (comment == '(' && line[i] == ')') {
      comment = 0;
    }
  }
  return free;
}

SpacedLine spaced(Random& random, const std::string& line) {
  const std::vector<bool> free = free_places(line);
  SpacedLine result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    while (free[i] && random.one_in(4)) result.text += random.any_of(" \t");
    result.places.push_back(static_cast<std::uint32_t>(result.text.size()));
    result.text += line[i];
  }
  return result;
}

TEST(CheckTextProperty, BlanksOutsideCommentsMoveColumnsAndNothingElse) {
  for (const std::uint64_t seed : support::seeds(1'500)) {
    Random random(seed);
    const std::vector<std::string> lines = RandomProgram(random).lines(random.between(1, 40));
    std::vector<SpacedLine> with_blanks;
    std::string text;
    for (const std::string& line : lines) text += with_blanks.emplace_back(spaced(random, line)).text + '\n';
    Report expected = check(support::joined(lines));
    for (LocatedFinding& located : expected.findings) {
      const SpacedLine& line = with_blanks[located.line];
      located.finding.span = line.map(located.finding.span);
      located.finding.related = line.map(located.finding.related);
    }
    ASSERT_EQ(support::texts_of(check(text)), support::texts_of(expected)) << "seed " << seed << "\n" << text;
  }
}

bool stands_before(const LocatedFinding& a, const LocatedFinding& b) {
  return a.line != b.line ? a.line < b.line : a.finding.span.begin < b.finding.span.begin;
}

TEST(CheckTextProperty, FindingsAreSortedAndLieWithinTheirLine) {
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    const std::vector<std::string> lines = RandomProgram(random).lines(random.between(1, 80));
    const Report report = check(support::joined(lines));
    EXPECT_TRUE(std::is_sorted(report.findings.begin(), report.findings.end(), stands_before)) << "seed " << seed;
    for (const LocatedFinding& located : report.findings) {
      ASSERT_LT(located.line, lines.size()) << "seed " << seed;
      const syntax::Span span = located.finding.span;
      EXPECT_LE(span.begin, span.end) << "seed " << seed << ": " << lines[located.line];
      EXPECT_LE(span.end, lines[located.line].size()) << "seed " << seed << ": " << lines[located.line];
      EXPECT_LE(located.finding.related.end, lines[located.line].size()) << "seed " << seed;
    }
  }
}

TEST(CheckTextProperty, OneMistakeIsReportedOncePerPlace) {
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    const std::vector<std::string> lines = RandomProgram(random).lines(random.between(1, 80));
    const Report report = check(support::joined(lines));
    std::vector<std::string> places;
    for (const LocatedFinding& located : report.findings)
      places.push_back(fmt::format("line {}: {} at {}: {}", located.line, dialect::definition(located.finding.id).code,
                                   support::text_of(located.finding.span), lines[located.line]));
    std::sort(places.begin(), places.end());
    const auto twice = std::adjacent_find(places.begin(), places.end());
    if (twice != places.end()) FAIL() << "seed " << seed << ": " << *twice;
  }
}

}  // namespace
}  // namespace isocnc::check
