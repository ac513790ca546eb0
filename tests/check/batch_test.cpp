#include "analyzer/check/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "analyzer/check/conclusion.h"
#include "analyzer/check/folding.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/text/characters.h"
#include "tests/support/random_program.h"
#include "tests/support/report_text.h"

namespace isocnc::check {
namespace {

using support::Random;

/// Rows of motions of one kind, and other lines among them.
std::string program_of_long_rows(Random& random, std::size_t size) {
  support::RandomProgram other(random);
  other.jump_chances = random.one_in(4) ? 500 : 1'000'000;
  other.end_chances = 5'000;
  const int chances = std::array{10, 200, 2'000}[static_cast<std::size_t>(random.between(0, 2))];
  std::string text = "M06 T101001\nS9000 M03\nG00 X0 Y0 Z5\nG01 F2000 X1\n";
  if (random.one_in(2)) text += "G91\n";
  const bool has_arcs = random.one_in(3);
  while (text.size() < size) {
    const int x = random.between(1, 90);
    if (random.one_in(chances)) {
      text += other.line();
    } else if (has_arcs && random.one_in(3)) {
      text += fmt::format("G02 X{} Y0 R{}\nG01 X{}", x, 100 + x, x + 1);
    } else {
      text += fmt::format("X{}.{} Y{}{}", x, x, 90 - x, random.one_in(30) ? " F1500" : "");
    }
    text += '\n';
  }
  return text;
}

/// The first part of a text, of whole lines.
std::string_view cut(std::string_view& text, std::ptrdiff_t size) {
  const std::string_view part = text::whole_lines(text.data(), size, text.data() + text.size());
  text.remove_prefix(part.size());
  return part;
}

/// The report, and the same with repetitions folded.
std::vector<std::string> texts_of(const Outcome& outcome, const Checker& checker, const JumpMap& jumps,
                                  std::string_view program) {
  const Report report = conclude(outcome, checker.frontier, jumps,
                                 [&](std::size_t line) { return syntax::LineFinder(program).line(line); });
  std::vector<std::string> texts = support::texts_of(report);
  for (std::string& text : support::texts_of(folded(report))) texts.push_back(std::move(text));
  return texts;
}

/// Portions are executed ahead from a frontier somewhere above them, and joined. That must be as if each was executed
/// from its own.
TEST(Portion, ExecutedAheadGivesWhatItGivesInOrder) {
  dialect::HouseWatch watch{.rule = "coolant",
                            .reported = {{.kind = dialect::HouseEvent::Kind::Motion}},
                            .started = {{.kind = dialect::HouseEvent::Kind::M, .number = 8}}};
  const auto house_rules = std::make_shared<rules::HouseRules>(std::vector{watch});
  std::size_t taken_over = 0;
  std::size_t executed = 0;
  for (const std::uint64_t seed : support::seeds(60)) {
    Random random(seed);
    rules::CheckSetup setup;
    if (random.one_in(4)) setup.house_rules = house_rules;
    if (random.one_in(4)) setup.machine.clearance = 3.0;
    const std::string program = program_of_long_rows(random, 200'000);
    const JumpMap jumps(program);
    const char* const end = program.data() + program.size();
    Checker joined(setup, jumps);
    Checker in_order(setup, jumps);
    Outcome of_joined;
    Outcome of_order;
    std::size_t line = 0;
    std::size_t expected_line = 0;
    std::vector<Frontier> frontiers{in_order.frontier};
    std::string_view rest = program;
    std::string_view above;
    while (!rest.empty()) {
      const std::string_view part = cut(rest, 1'000 * random.between(1, 60));
      Checker ahead(setup, jumps);
      ahead.frontier = frontiers[frontiers.size() - static_cast<std::size_t>(random.between(
                                                        1, std::min(4, static_cast<int>(frontiers.size()))))];
      const char* const start = above.empty() ? part.data() : above.data();
      ahead.frontier.next_jump = jumps.count_above(static_cast<std::size_t>(start - program.data()));
      Portion portion;
      portion.start(part, end);
      portion.check_ahead(ahead, above);
      line = portion.check(joined, line, of_joined);
      taken_over += portion.taken_over();
      executed += portion.executed();
      portion.start(part, end);
      expected_line = portion.check(in_order, expected_line, of_order);
      ASSERT_TRUE(joined.frontier == in_order.frontier) << "seed " << seed << ", line " << line;
      ASSERT_EQ(line, expected_line) << "seed " << seed;
      frontiers.push_back(in_order.frontier);
      above = random.one_in(2) ? std::string_view() : part;
    }
    EXPECT_EQ(texts_of(of_joined, joined, jumps, program), texts_of(of_order, in_order, jumps, program)) << seed;
    EXPECT_EQ(of_joined.centers.from_start, of_order.centers.from_start) << "seed " << seed;
    EXPECT_EQ(of_joined.centers.open, of_order.centers.open) << "seed " << seed;
  }
  EXPECT_GT(taken_over, support::often(150));
  EXPECT_GT(executed, support::often(150));
}

/// A portion of 40 KB in three batches, below lines that set a speed and a feed.
TEST(Portion, IsTakenOverWhereTheLinesAboveSetWhatDiffers) {
  const std::string above = "S9000 M03\nG00 X0 Y0 Z5\nG01 X1 F2000\n";
  std::string lines;
  while (lines.size() < 40'000) lines += "S9500\nX2 Y2\nX1 Y1\n";
  const std::string program = "M06 T101001\n" + above + lines;
  const char* const end = program.data() + program.size();
  const std::string_view part = std::string_view(program).substr(program.size() - lines.size());
  const rules::CheckSetup setup;
  const JumpMap jumps;
  Checker in_order(setup, jumps);
  Batch top;
  top.parse(std::string_view(program).substr(0, program.size() - lines.size()), end);
  Outcome outcome;
  std::size_t line = 0;
  line = top.check(in_order, line, outcome);
  for (const bool knows_above : {true, false}) {
    Checker joined(setup, jumps);
    joined.frontier = in_order.frontier;
    Checker ahead(setup, jumps);
    Portion portion;
    portion.start(part, end);
    portion.check_ahead(ahead, knows_above ? std::string_view(program).substr(0, program.size() - lines.size()) : "");
    EXPECT_TRUE(portion.is_ahead());
    Outcome of_portion;
    portion.check(joined, line, of_portion);
    EXPECT_EQ(portion.executed(), knows_above ? 0u : 3u);
    EXPECT_EQ(portion.taken_over(), knows_above ? 3u : 0u);
    portion.start(part, end);
    EXPECT_FALSE(portion.is_ahead());
  }
}

}  // namespace
}  // namespace isocnc::check
