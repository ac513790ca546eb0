#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "analyzer/examples.h"
#include "tests/support/report_text.h"

namespace isocnc::dialect {
namespace {

using analyzer::MarkedProgram;
using analyzer::read_marked;
using check::Report;

/// What isolint would report with the row's code selected, too; without opinions, where the row is about the control's
/// own codes.
Report reported_in(std::string_view program, DiagnosticId id) {
  Report report = analyzer::example_report(program, id);
  if (!support::is_lint(definition(id).code))
    std::erase_if(report.findings, [](const auto& it) { return support::is_lint(definition(it.finding.id).code); });
  return report;
}

std::string codes_of(const Report& report) {
  std::string codes;
  for (const auto& located : report.findings) {
    codes += std::string(definition(located.finding.id).code) + "@" + std::to_string(located.line + 1) + ":" +
             std::to_string(located.finding.span.begin) + "-" + std::to_string(located.finding.span.end) + " ";
  }
  return codes;
}

/// What a run would report, in the same way.
std::string codes_of_run(std::string_view program, DiagnosticId id) {
  Report report;
  for (const simulation::RunFinding& found : analyzer::example_run(program, id))
    report.findings.push_back({.line = found.line, .finding = found.finding});
  return codes_of(report);
}

/// The diagnostics, each with its causes.
std::vector<Cause> all_causes() {
  std::vector<Cause> causes;
  for (std::uint8_t row = 0; row < kDiagnosticCount; ++row)
    for (std::uint8_t number = 0; number < cause_count(kDiagnostics[row]); ++number)
      causes.emplace_back(DiagnosticId{row}, number);
  return causes;
}

class Table : public testing::TestWithParam<Cause> {};

TEST_P(Table, WrongProgramHasThisOneFindingAtItsMark) {
  const Cause cause = GetParam();
  const DiagnosticDef& def = definition(cause.id);
  if (analyzer::wrong_program(cause).empty()) GTEST_SKIP() << "cannot be shown in a few lines";
  const MarkedProgram wrong = read_marked(analyzer::wrong_program(cause));
  ASSERT_TRUE(wrong.has_mark);
  const std::string mark = std::string(def.code) + "@" + std::to_string(wrong.line + 1) + ":" +
                           std::to_string(wrong.begin) + "-" + std::to_string(wrong.end) + " ";
  if (def.is_reported_by_runs()) {
    EXPECT_EQ(codes_of_run(wrong.text, cause.id), mark) << wrong.text;
    return;
  }
  const Report report = reported_in(wrong.text, cause.id);
  ASSERT_EQ(report.findings.size(), 1u) << wrong.text << codes_of(report);
  EXPECT_EQ(definition(report.findings[0].finding.id).code, def.code) << wrong.text;
  EXPECT_EQ(report.findings[0].finding.cause, cause.number) << wrong.text;
  EXPECT_EQ(codes_of(report), mark) << wrong.text;
}

TEST_P(Table, RightProgramHasNone) {
  if (GetParam().number > 0) return;  // All causes of a code have the same.
  const DiagnosticDef& def = definition(GetParam().id);
  const std::string_view right = def.right.empty() ? "M02\n" : def.right;
  EXPECT_EQ(codes_of(reported_in(right, GetParam().id)), "") << right;
  if (def.is_reported_by_runs()) {
    EXPECT_EQ(codes_of_run(right, GetParam().id), "") << right;
  }
}

TEST_P(Table, TextsAreThereInBothLanguages) {
  const DiagnosticDef& def = definition(GetParam().id);
  const Text& message = message_text(GetParam());
  for (const Text& text : {def.title, message, def.explanation}) {
    EXPECT_FALSE(text.en.empty());
    EXPECT_FALSE(text.it.empty());
  }
  EXPECT_FALSE(def.section.empty());
  EXPECT_FALSE(message.en.ends_with('.'));
  EXPECT_FALSE(message.it.ends_with('.'));
}

/// A message names only what is reported with it, and both languages name the same.
TEST_P(Table, MessagesNameTheirValues) {
  const DiagnosticDef& def = definition(GetParam().id);
  const Text& message = message_text(GetParam());
  const auto names_in = [](std::string_view text) {
    static const std::regex kName(R"(\{([a-z]*)\})");
    const std::string copy(text);
    std::set<std::string> names;
    for (std::sregex_iterator it(copy.begin(), copy.end(), kName); it != std::sregex_iterator(); ++it)
      names.insert((*it)[1]);
    return names;
  };
  std::set<std::string> allowed = {"text", "other", "who", "whom", "said", "unit", "inches"};
  for (const std::string_view name : def.arguments) allowed.insert(std::string(name));
  for (const std::string& name : names_in(message.en)) EXPECT_TRUE(allowed.contains(name)) << name;
  EXPECT_EQ(names_in(message.en), names_in(message.it));
}

/// Each cause can be seen in a program, and its message then says all it has to.
TEST_P(Table, HasAnExampleWhoseMessageIsComplete) {
  const std::optional<analyzer::Example> example = analyzer::example_of(GetParam());
  ASSERT_TRUE(example) << definition(GetParam().id).code;
  const bool quotes_other = message_text(GetParam()).en.find("{other}") != std::string_view::npos;
  EXPECT_EQ(example->finding.related.empty() && quotes_other, false);
  for (const Language language : {Language::English, Language::Italian}) {
    const std::string message = example->message(language);
    EXPECT_EQ(message.find_first_of("{}"), std::string::npos) << message;
    EXPECT_EQ(message.find("  "), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(Diagnostics, Table, testing::ValuesIn(all_causes()), [](const auto& row) {
  const DiagnosticDef& def = definition(row.param.id);
  std::string name(def.code);
  if (row.param.number > 0) name += "_" + std::string(def.causes[row.param.number - 1].cause);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// Two causes of one code have two messages; else they would be one.
TEST(Diagnostics, DifferInTheirCauses) {
  std::set<std::pair<DiagnosticId, std::string_view>> messages;
  for (const Cause& cause : all_causes())
    EXPECT_TRUE(messages.emplace(cause.id, message_text(cause).en).second) << message_text(cause).en;
}

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
