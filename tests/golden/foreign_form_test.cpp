#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/examples.h"
#include "analyzer/foreign_page.h"
#include "interpreter/syntax/line_finder.h"
#include "tests/support/report_text.h"

namespace isocnc::dialect {
namespace {

using analyzer::MarkedProgram;
using testing::ElementsAre;
using testing::IsEmpty;

/// What the control would stop at, and the findings of `wanted`, with their texts.
std::vector<check::LocatedFinding> found_in(const std::string& program, DiagnosticId wanted) {
  std::vector<check::LocatedFinding> found;
  for (const check::LocatedFinding& located : check::check_text(program, {}).findings)
    if (located.finding.id == wanted || !support::is_lint(definition(located.finding.id).code))
      found.push_back(located);
  return found;
}

std::vector<std::string> shown(const std::string& program, const std::vector<check::LocatedFinding>& findings) {
  std::vector<std::string> texts;
  syntax::LineFinder lines(program);
  for (const check::LocatedFinding& located : findings)
    texts.push_back(fmt::format("{} {}:{}-{} {}", definition(located.finding.id).code, located.line + 1,
                                located.finding.span.begin, located.finding.span.end,
                                syntax::message(located.finding, lines.line(located.line), Language::English)));
  return texts;
}

class ForeignForms : public testing::TestWithParam<const ForeignForm*> {};

TEST_P(ForeignForms, ExampleHasOneFindingThatNamesTheForm) {
  const ForeignForm& form = *GetParam();
  if (form.written.empty()) GTEST_SKIP() << "comes with a second finding";
  const MarkedProgram program = analyzer::read_marked(analyzer::foreign_example(form, form.written));
  const std::vector<check::LocatedFinding> found = found_in(program.text, form.diagnostics[0]);
  if (form.runs_here()) {
    EXPECT_THAT(shown(program.text, found), IsEmpty()) << program.text;
    return;
  }
  ASSERT_TRUE(program.has_mark) << program.text;
  ASSERT_EQ(found.size(), 1u) << program.text << testing::PrintToString(shown(program.text, found));
  const syntax::Finding& finding = found.front().finding;
  EXPECT_EQ(found.front().line, program.line) << program.text;
  EXPECT_EQ(finding.span.begin, program.begin) << program.text;
  EXPECT_EQ(finding.span.end, program.end) << program.text;
  EXPECT_TRUE(std::find(std::begin(form.diagnostics), std::end(form.diagnostics), finding.id) !=
              std::end(form.diagnostics))
      << testing::PrintToString(shown(program.text, found));
  const std::string_view line = syntax::LineFinder(program.text).line(program.line);
  const ForeignForm* const named = syntax::foreign_form(finding, line);
  EXPECT_EQ(named, form.keeps_message ? nullptr : &form) << (named ? named->there.en : "") << ": " << line;
}

TEST_P(ForeignForms, WhatIsWrittenInsteadHasNoFinding) {
  const ForeignForm& form = *GetParam();
  if (form.instead.empty() && form.place == ExamplePlace::End) GTEST_SKIP();
  if (form.instead.empty() && form.place == ExamplePlace::Change) GTEST_SKIP();
  const std::string program = analyzer::foreign_example(form, form.instead);
  EXPECT_THAT(shown(program, found_in(program, kNoDiagnostic)), IsEmpty()) << program;
}

TEST_P(ForeignForms, HasTextsInBothLanguages) {
  const ForeignForm& form = *GetParam();
  EXPECT_NE(form.controls, 0);
  for (const Text& text : {form.there, form.here}) {
    EXPECT_FALSE(text.en.empty());
    EXPECT_FALSE(text.it.empty());
    EXPECT_FALSE(text.en.ends_with('.')) << text.en;
    EXPECT_FALSE(text.it.ends_with('.')) << text.it;
  }
}

std::vector<const ForeignForm*> all_forms() {
  std::vector<const ForeignForm*> forms;
  for (const ForeignForm& form : foreign_forms()) forms.push_back(&form);
  return forms;
}

INSTANTIATE_TEST_SUITE_P(Table, ForeignForms, testing::ValuesIn(all_forms()), [](const auto& row) {
  std::string name = fmt::format("{}_", row.index);
  for (const char c : analyzer::read_marked(row.param->written).text)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
  return name;
});

TEST(ForeignFormText, NamesOneTwoOrFirstOfSeveralControls) {
  ForeignForm form;
  form.controls = bit(ForeignControl::Siemens);
  EXPECT_EQ(controls_of(form, Language::English), "Siemens");
  form.controls |= bit(ForeignControl::Mach);
  EXPECT_EQ(controls_of(form, Language::English), "Siemens and Mach");
  EXPECT_EQ(controls_of(form, Language::Italian), "Siemens e Mach");
  form.controls |= bit(ForeignControl::LinuxCnc);
  EXPECT_EQ(controls_of(form, Language::English), "Siemens and others");
  EXPECT_EQ(controls_of(form, Language::Italian), "Siemens e altri");
}

std::string text_of(std::string_view line, Language language = Language::English) {
  const syntax::ParsedLine parsed(line);
  const syntax::LineTree tree = parsed.tree();
  return tree.findings.empty() ? "" : syntax::message(tree.findings.front(), line, language);
}

TEST(ForeignFormText, QuotesTheWholeOfWhichAPartIsMarked) {
  EXPECT_EQ(text_of("G02 X20 CR = 10 F200"),
            "on Siemens CR = 10 is the radius of an arc; here it is R, for half a turn at most");
  EXPECT_THAT(text_of("R12 = R3 + 5"), testing::StartsWith("on Siemens and Heidenhain R12 = R3"));
  EXPECT_THAT(text_of("G01 X#101 F200"), testing::StartsWith("on Fanuc and others X#101 takes"));
}

TEST(ForeignFormText, IsInTheReadersLanguage) {
  EXPECT_EQ(text_of("G20", Language::Italian), "su Fanuc e altri G20 seleziona i pollici; qui lo fa la G70");
}

/// Blanks, case, comments, leading zeros and the number of the line make no difference.
TEST(ForeignFormText, IsFoundHoweverItIsSpelled) {
  for (const char* const line : {"G43 H1 Z5", "g 043 h01 z5", "N10 G43(x)H1 Z5 ; length", "G0043Z5H1"})
    EXPECT_THAT(text_of(line), testing::HasSubstr("takes the tool's length")) << line;
  for (const char* const line : {"WHILE [#1 LT 10] DO1", "while[#1LT10]do 1", "N5 WHILE [ #1 LT 10 ] DO1 (x)"})
    EXPECT_THAT(text_of(line), testing::HasSubstr("repeats lines")) << line;
}

TEST(ForeignFormText, ClaimsNothingOfALineThatHasLostItsLineEnds) {
  const std::string line = "G43 H1 Z5" + std::string(1'000, ' ') + "G00 X0";
  EXPECT_EQ(text_of(line), "G43 is not among the G codes of this control");
}

/// Italian words that start like those of other controls, and lines of this control with a slip.
TEST(ForeignFormText, ClaimsNoOtherControlWithoutReason) {
  for (const char* const line :
       {"FORATURA LATO DESTRO", "PROCESSO", "APPROCCIO LENTO", "CASETTA", "G1O X10", "X10,5", "G01 X10 Y", "LATO 2"})
    EXPECT_THAT(text_of(line), testing::Not(testing::HasSubstr("; here "))) << line;
}

}  // namespace
}  // namespace isocnc::dialect
