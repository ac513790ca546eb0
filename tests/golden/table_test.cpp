#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "analyzer/check/check_text.h"
#include "analyzer/explain.h"
#include "analyzer/formats/rendering.h"
#include "analyzer/selection/selection.h"
#include "analyzer/selection/style_findings.h"
#include "analyzer/selection/suppressions.h"
#include "interpreter/running/runner.h"
#include "interpreter/simulation/compensation.h"
#include "tests/support/report_text.h"

namespace isocnc::dialect {
namespace {

using analyzer::MarkedProgram;
using analyzer::read_marked;
using check::Report;

/// The setup that the programs of the table are written for: one tool, so that ISO067 can be shown.
rules::CheckSetup table_setup(const DiagnosticDef& def) {
  rules::CheckSetup setup;
  if (def.code == "ISO067") setup.machine.tools = {{1, 1, 1}};
  if (def.code == "W129") setup.machine.functions = {100};
  if (def.code == "W130") setup.machine.limits.travel[0] = {0, 1000};
  if (def.code == "W131") setup.machine.limits.feed = 10'000;
  if (def.code == "W132") setup.machine.limits.rotary_speed = 3'600;
  if (def.code == "W133") setup.machine.limits.spindle_speed = 18'000;
  if (def.code == "W134") setup.machine.clearance = 5;
  setup.every_motion = def.is_off;
  return setup;
}

/// What isolint would report with the row's code selected, too; without opinions, where the row is about the control's
/// own codes.
Report reported_in(std::string_view program, const DiagnosticDef& def) {
  selection::Selection selection;
  EXPECT_THAT(selection.follow({.severities = {std::string(def.code) + "=warning"}}, Language::English),
              testing::IsEmpty());
  Report report = selection::with_style(check::check_text(program, table_setup(def)), program, selection);
  report = selection.shown(selection::suppress(std::move(report), program, selection));
  if (!support::is_lint(def.code))
    std::erase_if(report.findings, [](const auto& it) { return support::is_lint(definition(it.finding.id).code); });
  return report;
}

/// What isorun would report, with a cutter of 10 mm radius.
std::string warnings_of_run(std::string_view program) {
  simulation::TimedMachine machine;
  machine.tool_radii[{1, 1, 1}] = 10;
  std::string codes;
  simulation::Compensation compensation(machine);
  const simulation::Compensation::Listeners listeners{.event = [](const running::Event&) {},
                                                      .warning =
                                                          [&](const simulation::RunWarning& warning) {
                                                            codes += std::string(definition(warning.id).code) + "@" +
                                                                     std::to_string(warning.line + 1) + " ";
                                                          }};
  const auto result =
      running::run(program, {}, [&](const running::Event& event) { compensation.take(event, listeners); });
  compensation.finish(listeners);
  EXPECT_EQ(result.ending, running::Ending::ProgramEnd) << program;
  return codes;
}

std::string codes_of(const Report& report) {
  std::string codes;
  for (const auto& located : report.findings) {
    codes += std::string(definition(located.finding.id).code) + "@" + std::to_string(located.line + 1) + ":" +
             std::to_string(located.finding.span.begin) + "-" + std::to_string(located.finding.span.end) + " ";
  }
  return codes;
}

class Table : public testing::TestWithParam<DiagnosticDef> {};

TEST_P(Table, WrongProgramHasThisOneFindingAtItsMark) {
  const DiagnosticDef& def = GetParam();
  if (def.wrong.empty()) GTEST_SKIP() << "cannot be shown in a few lines";
  const MarkedProgram wrong = read_marked(def.wrong);
  ASSERT_TRUE(wrong.has_mark);
  if (def.is_reported_by_runs) {
    EXPECT_EQ(warnings_of_run(wrong.text), std::string(def.code) + "@" + std::to_string(wrong.line + 1) + " ")
        << wrong.text;
    return;
  }
  const Report report = reported_in(wrong.text, def);
  ASSERT_EQ(report.findings.size(), 1u) << wrong.text << codes_of(report);
  EXPECT_EQ(definition(report.findings[0].finding.id).code, def.code) << wrong.text;
  EXPECT_EQ(codes_of(report), std::string(def.code) + "@" + std::to_string(wrong.line + 1) + ":" +
                                  std::to_string(wrong.begin) + "-" + std::to_string(wrong.end) + " ")
      << wrong.text;
}

TEST_P(Table, RightProgramHasNone) {
  const DiagnosticDef& def = GetParam();
  const std::string_view right = def.right.empty() ? "M02\n" : def.right;
  EXPECT_EQ(codes_of(reported_in(right, def)), "") << right;
  if (def.is_reported_by_runs) {
    EXPECT_EQ(warnings_of_run(right), "") << right;
  }
}

TEST_P(Table, TextsAreThereInBothLanguages) {
  const DiagnosticDef& def = GetParam();
  for (const Text& text : {def.title, def.message, def.explanation}) {
    EXPECT_FALSE(text.en.empty());
    EXPECT_FALSE(text.it.empty());
  }
  EXPECT_FALSE(def.section.empty());
  EXPECT_FALSE(def.message.en.ends_with('.'));
  EXPECT_FALSE(def.message.it.ends_with('.'));
}

/// A message names only what is reported with it, and both languages name the same.
TEST_P(Table, MessagesNameTheirValues) {
  const DiagnosticDef& def = GetParam();
  const auto names_in = [](std::string_view message) {
    static const std::regex kName(R"(\{([a-z]*)\})");
    const std::string text(message);
    std::set<std::string> names;
    for (std::sregex_iterator it(text.begin(), text.end(), kName); it != std::sregex_iterator(); ++it)
      names.insert((*it)[1]);
    return names;
  };
  std::set<std::string> allowed = {"text"};
  for (const std::string_view name : def.arguments) allowed.insert(std::string(name));
  for (const std::string& name : names_in(def.message.en)) EXPECT_TRUE(allowed.contains(name)) << name;
  EXPECT_EQ(names_in(def.message.en), names_in(def.message.it));
}

INSTANTIATE_TEST_SUITE_P(Diagnostics, Table, testing::ValuesIn(kDiagnostics),
                         [](const auto& row) { return std::string(row.param.code); });

TEST(Diagnostics, AreFoundByCodeAndName) {
  EXPECT_EQ(find_diagnostic("iso031"), "arc-center-mismatch"_diag);
  EXPECT_EQ(find_diagnostic("arc-center-mismatch"), "arc-center-mismatch"_diag);
  EXPECT_EQ(find_diagnostic("ISO069"), std::nullopt);
}

TEST(Diagnostics, CoverTheSpecification) {
  for (int i = 1; i <= 68; ++i)
    EXPECT_TRUE(find_diagnostic("ISO" + std::string(i < 10 ? "00" : "0") + std::to_string(i))) << i;
  for (int i = 1; i <= 9; ++i) EXPECT_TRUE(find_diagnostic("E00" + std::to_string(i))) << i;
  for (int i = 1; i <= 3; ++i) EXPECT_TRUE(find_diagnostic("W00" + std::to_string(i))) << i;
}

TEST(Diagnostics, ShowValuesAsPeopleWriteThem) {
  EXPECT_EQ(format_value(10), "10");
  EXPECT_EQ(format_value(-0.0), "0");
  EXPECT_EQ(format_value(2.5), "2.5");
  EXPECT_EQ(format_value(1.0 / 3), "0.3333");
  EXPECT_EQ(format_value(1e-7), "1e-07");
}

}  // namespace
}  // namespace isocnc::dialect
