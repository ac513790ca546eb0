#include <gtest/gtest.h>

#include <algorithm>

#include "analyzer/check/analysis.h"
#include "analyzer/check/check_text.h"
#include "tests/support/random_program.h"
#include "tests/support/report_text.h"

/// House rules against programs that change, and against each way through the checker.
namespace isocnc::check {
namespace {

using dialect::HouseEvent;
using dialect::HouseWatch;
using support::Random;
using Event = HouseEvent::Kind;

template <class Value>
Value any_of(Random& random, std::initializer_list<Value> choices) {
  return choices.begin()[random.below(choices.size())];
}

HouseEvent random_event(Random& random) {
  switch (random.between(0, 9)) {
    case 0:
    case 1:
    case 2:
      return {.kind = Event::M, .number = random.between(7, 10)};
    case 3:
      return {.kind = Event::M, .number = random.between(3, 5)};
    case 4:
      return {.kind = Event::G, .number = any_of(random, {90, 91, 71, 40})};
    case 5:
      return {.kind = Event::ToolChange};
    case 6:
      return {.kind = Event::End};
    default:
      return {.kind = any_of(random, {Event::Motion, Event::Rapid, Event::Cut})};
  }
}

std::vector<HouseEvent> random_events(Random& random, int minimum) {
  std::vector<HouseEvent> events;
  for (int i = random.between(minimum, 2); i > 0; --i) events.push_back(random_event(random));
  return events;
}

HouseWatch random_watch(Random& random, int number) {
  HouseWatch watch;
  watch.rule = fmt::format("rule-{}", number);
  watch.message = {.en = watch.rule, .it = watch.rule};
  switch (random.between(0, 9)) {
    case 0:
      watch.kind = HouseWatch::Kind::Speed;
      watch.minimum = 5'000;
      watch.maximum = random.one_in(2) ? 9'000 : 20'000;
      break;
    case 1:
      watch.kind = HouseWatch::Kind::Feed;
      watch.minimum = 500;
      watch.maximum = random.one_in(2) ? 1'500 : 25'000;
      break;
    case 2:
      watch.kind = HouseWatch::Kind::Depth;
      watch.minimum = random.between(-30, 0);
      break;
    default:
      watch.reported = random_events(random, 1);
      watch.started = random_events(random, 0);
      watch.ended = random_events(random, 0);
      if (random.one_in(4)) watch.comment = "*t*";
      watch.is_on_first = watch.started.empty() || random.one_in(3);
      watch.stays_on = watch.started.empty() && watch.ended.empty() && watch.comment.empty();
      return watch;
  }
  if (random.one_in(2)) watch.tools = {{.first = 101'000, .last = 101'003}};
  return watch;
}

rules::CheckSetup random_shop(Random& random) {
  std::vector<HouseWatch> watches;
  for (int i = random.between(1, 8); i > 0; --i) watches.push_back(random_watch(random, i));
  return {.house_rules = std::make_shared<const rules::HouseRules>(watches)};
}

/// Lines that house rules are about, and rows of plain motions between them.
std::string shop_line(Random& random, int labels) {
  switch (random.between(0, 11)) {
    case 0:
      return fmt::format("M{:02}", random.between(7, 10));
    case 1:
      return fmt::format("M{:02}", random.between(3, 5));
    case 2:
      return fmt::format("M06 T10100{}{}", random.between(1, 6), random.one_in(3) ? " (tool)" : "");
    case 3:
      return fmt::format("S{}000", random.between(3, 22));
    case 4:
      return std::string(
          random.any_of({"G90", "G91", "G70", "G71", "G17", "G18", "G40", "(note)", "(x) V1=2", "M8 M9"}));
    case 5:
      return fmt::format("IF VGPL = {} GOTO N{}", random.between(0, 3), random.between(1, labels));
    case 6:
      return fmt::format("N{} X1", random.between(1, labels));
    case 7:
      return random.one_in(4) ? std::string(random.any_of({"M0l8", "G77 X1", "X1 X2", "08", "M02"})) : "G00 Z5";
    default:
      return fmt::format("G{:02} X{} Z{}{}", random.between(0, 1), random.between(0, 9), random.between(-35, 5),
                         random.one_in(3) ? fmt::format(" F{}00", random.between(1, 30)) : "");
  }
}

std::string shop_program(Random& random, int lines, int labels) {
  std::string text = "M06 T101001\nG01 X0 Y0 Z5 F1000\n";
  for (int i = 0; i < lines; ++i) {
    // Long rows of plain motions, of which some concern a rule.
    const bool is_plain = lines > 100 && !random.one_in(8);
    text += (is_plain ? fmt::format("X{} Z{}", i % 10, i % 50 == 0 ? -20 : i % 3) : shop_line(random, labels)) + "\n";
  }
  return text + "M05\nM02\n";
}

TEST(HouseRuleProperty, EditedEqualsFresh) {
  std::size_t found = 0;
  for (const std::uint64_t seed : support::seeds(120)) {
    Random random(seed);
    const rules::CheckSetup setup = random_shop(random);
    const int lines = random.one_in(3) ? 1'200 : 60;
    syntax::Document document(shop_program(random, lines, lines / 8));
    Analysis analysis(document, setup);
    for (int i = 0; i < 15; ++i) {
      const std::size_t line = random.below(document.line_count());
      document.replace({line, 0}, {line + random.below(3), 0}, shop_line(random, lines / 8) + "\n");
      if (random.one_in(4) && !analysis.update([] { return true; })) continue;
      analysis.update();
      const Analysis fresh(document, setup);
      const std::vector<std::string> report = support::texts_of(analysis.report());
      const std::string which = fmt::format("seed {}, edit {}\n{}", seed, i, lines > 60 ? "" : document.text());
      ASSERT_EQ(report, support::texts_of(fresh.report())) << which;
      ASSERT_EQ(report, support::texts_of(check_text(document.text(), setup))) << which;
      for (std::size_t at = 0; at <= document.line_count(); at += 61)
        ASSERT_EQ(analysis.frontier_before(at), fresh.frontier_before(at)) << which << ", line " << at;
      for (const LocatedFinding& located : fresh.report().findings)
        if (dialect::definition(located.finding.id).name == "house-rule") ++found;
    }
  }
  EXPECT_GT(found, support::often(1'000));
}

/// The fast path for plain lines finds what line by line is found.
TEST(HouseRuleProperty, RowsOfMotionsEqualSingleMotions) {
  for (const std::uint64_t seed : support::seeds(300)) {
    Random random(seed);
    const rules::CheckSetup fast = random_shop(random);
    rules::CheckSetup slow = fast;
    slow.every_motion = true;
    const int lines = random.one_in(3) ? 600 : 40;
    const std::string program =
        random.one_in(3) ? support::joined(support::random_lines(random, 60)) : shop_program(random, lines, lines / 8);
    const auto of_house = [](const Report& report) {
      Report kept = report;
      std::erase_if(kept.findings, [](const LocatedFinding& located) {
        return dialect::definition(located.finding.id).name != "house-rule";
      });
      return support::texts_of(kept);
    };
    ASSERT_EQ(of_house(check_text(program, fast)), of_house(check_text(program, slow))) << "seed " << seed << "\n"
                                                                                        << program;
    ASSERT_EQ(of_house(check_text(program, fast)), of_house(check_text(program, fast, 2))) << "seed " << seed;
  }
}

/// Without house rules, a program has the findings that it has with rules that nothing breaks.
TEST(HouseRuleProperty, HouseRulesChangeNothingElse) {
  for (const std::uint64_t seed : support::seeds(150)) {
    Random random(seed);
    const rules::CheckSetup setup = random_shop(random);
    const std::string program = support::joined(support::random_lines(random, 80));
    const Report with = check_text(program, setup);
    const auto is_left_out = [](const dialect::DiagnosticDef& def) { return def.name == "house-rule" || def.is_off; };
    const auto places = [&](const Report& report) {
      std::vector<std::string> all;
      for (const LocatedFinding& located : report.findings)
        if (!is_left_out(dialect::definition(located.finding.id)))
          all.push_back(fmt::format("{}: {}", located.line, support::text_of(located.finding)));
      return all;
    };
    const std::vector<std::string> without = places(check_text(program, rules::CheckSetup()));
    ASSERT_EQ(places(with), without) << "seed " << seed << "\n" << program;
  }
}

}  // namespace
}  // namespace isocnc::check
