#include "analyzer/check/folding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "analyzer/check/analysis.h"
#include "analyzer/check/check_text.h"
#include "tests/support/random_program.h"
#include "tests/support/report_text.h"

namespace isocnc::check {
namespace {

using dialect::Severity;
using support::Random;
using syntax::Document;

const rules::CheckSetup kFoldingSetup;

std::string_view text_of_code(dialect::DiagnosticId id) { return dialect::definition(id).code; }

/// A line of a program without jumps in which the mistakes that fold are frequent.
std::string line(Random& random) {
  return std::string(random.any_of({"G01 X10 B10", "X20 B20",   "X30 C5",     "C90",       "G48",      "G49",
                                    "X5",          "Y5 F4",     "F6",         "G00 X0 F2", "G00 B0",   "G93",
                                    "G94",         "G01 X1 F5", "G93 G01 X7", "M08",       "",         "(note)",
                                    "X1 X2",       "F0",        "G94 F900",   "X10 B7 F3", "X9 G93",   "G02 X10 R500",
                                    "X8 Y8",       "X7 Y7",     "G91",        "G90",       "G01 G0 X1"}));
}

std::string program(Random& random, int lines) {
  std::string text = "M06 T101001\nG01 X0 Y0 F1000\n";
  for (int i = 0; i < lines; ++i) text += line(random) + "\n";
  return text + "M02\n";
}

/// The folds that a line ends, judged by its text and its findings alone.
std::string folds_ended_by_text(std::string_view text, const std::vector<std::string_view>& codes) {
  const auto has = [&](std::string_view word) { return text.find(word) != std::string_view::npos; };
  const auto found = [&](std::string_view code) { return std::find(codes.begin(), codes.end(), code) != codes.end(); };
  std::string ended;
  if (has("G48") || has("G49")) ended += "5";
  const bool has_feed = has("F") && !has("F0") && !has("G00") && (has("X") || has("Y"));
  if (has("G93") || has("G94") || (has_feed && !found("W003"))) ended += "F";
  return ended;
}

char fold_of(std::string_view code) {
  return code == "ISO032" || code == "ISO047" ? '5' : code == "ISO041" ? '4' : code == "W003" ? '3' : 0;
}

/// The report folded line by line, as D66 says it: `line 3: ISO032 and 2 more, to 9`.
std::vector<std::string> folded_by_hand(const Report& report, const std::string& text) {
  struct Mistake {
    std::size_t place;
    int repeats = 0;
    std::uint64_t last = 0;
  };
  std::map<char, Mistake> open;
  std::vector<std::pair<std::string, Mistake>> all;
  const Document document(text);
  auto next = report.findings.begin();
  for (std::uint64_t number = 0; number < document.line_count(); ++number) {
    const auto first = next;
    std::vector<std::string_view> codes;
    for (; next != report.findings.end() && next->line == number; ++next)
      codes.push_back(text_of_code(next->finding.id));
    for (const char ended : folds_ended_by_text(document.text_of_line(number), codes)) {
      if (ended == '5') open.erase('5');
      if (ended != 'F') continue;
      open.erase('4');
      open.erase('3');
    }
    for (auto each = first; each != next; ++each) {
      const char fold = fold_of(text_of_code(each->finding.id));
      if (fold != 0 && open.contains(fold)) {
        Mistake& mistake = all[open[fold].place].second;
        ++mistake.repeats;
        mistake.last = number;
        continue;
      }
      if (fold != 0) open[fold] = {all.size()};
      all.push_back({fmt::format("line {}: {}", number, text_of_code(each->finding.id)), {}});
    }
  }
  std::vector<std::string> texts;
  for (const auto& [place, mistake] : all)
    texts.push_back(place +
                    (mistake.repeats == 0 ? "" : fmt::format(" and {} more, to {}", mistake.repeats, mistake.last)));
  return texts;
}

std::vector<std::string> texts_of_folded(const Report& report) {
  std::vector<std::string> texts;
  for (const LocatedFinding& located : report.findings) {
    const auto repetitions = report.repetitions_of(located);
    texts.push_back(fmt::format("line {}: {}", located.line, text_of_code(located.finding.id)));
    if (!repetitions.empty())
      texts.back() += fmt::format(" and {} more, to {}", repetitions.size(), repetitions.back().line);
  }
  return texts;
}

TEST(Folding, FollowsTheRuleLineByLine) {
  int folds = 0;
  for (const std::uint64_t seed : support::seeds(2'000)) {
    Random random(seed);
    const std::string text = program(random, random.between(1, 60));
    const Report report = check_text(text, kFoldingSetup);
    const Report shown = folded(report);
    ASSERT_EQ(texts_of_folded(shown), folded_by_hand(report, text)) << "seed " << seed << "\n" << text;
    EXPECT_EQ(folded_size(report), shown.findings.size());
    EXPECT_EQ(folded(shown), shown) << "seed " << seed;
    folds += static_cast<int>(shown.repetitions.size());
  }
  EXPECT_GT(folds, static_cast<int>(support::often(2'000)));
}

/// The same program by paths of their own, whose states differ, so that no row of plain lines runs.
TEST(Folding, RowsOfPlainLinesFoldAsSingleLinesDo) {
  for (const std::uint64_t seed : support::seeds(200)) {
    Random random(seed);
    const std::string text = program(random, 40);
    std::string on_two_paths = "IF VGPL = 1 GOTO N1\nG92 X7\nN1\n" + text;
    std::vector<std::string> expected = texts_of_folded(folded(check_text("\n\n\n" + text, kFoldingSetup)));
    ASSERT_EQ(texts_of_folded(folded(check_text(on_two_paths, kFoldingSetup))), expected) << "seed " << seed << "\n"
                                                                                          << text;
  }
}

TEST(Folding, AnEditSplitsAndJoinsFolds) {
  for (const std::uint64_t seed : support::seeds(60)) {
    Random random(seed);
    Document document(program(random, random.one_in(2) ? 40 : 1'200));
    Analysis analysis(document, kFoldingSetup);
    for (int i = 0; i < 20; ++i) {
      const std::size_t at = random.below(document.line_count());
      document.replace({at, 0}, {at + random.below(3), 0}, random.one_in(3) ? "" : line(random) + "\n");
      analysis.update();
      ASSERT_EQ(support::texts_of(folded(analysis.report())),
                support::texts_of(folded(check_text(document.text(), kFoldingSetup))))
          << "seed " << seed << ", edit " << i;
    }
  }
}

TEST(Folding, AnExcerptIsTheStartOfTheFoldedReport) {
  std::size_t left_out = 0;
  for (const std::uint64_t seed : support::seeds(60)) {
    Random random(seed);
    const Document document(program(random, 1'500));
    const Analysis analysis(document, kFoldingSetup);
    const std::vector<std::string> all = texts_of_folded(folded(analysis.report()));
    for (const std::size_t maximum : {1u, 40u, 300u, 10'000u}) {
      const FirstFindings first = analysis.excerpt({.max = maximum, .folds = true});
      const std::vector<std::string> texts = texts_of_folded(first.report);
      ASSERT_LE(texts.size(), all.size());
      EXPECT_TRUE(std::equal(texts.begin(), texts.end(), all.begin())) << "seed " << seed << ", " << maximum;
      EXPECT_EQ(texts.size() + first.left_out, all.size()) << "seed " << seed << ", " << maximum;
      left_out += first.left_out;
    }
  }
  EXPECT_GT(left_out, support::often(1'000));
}

TEST(Folding, AnEditFarAboveChecksNoMoreLinesThanBefore) {
  std::string text = "M06 T101001\nG01 X0 Y0 F1000\n";
  for (int i = 0; i < 20'000; ++i) text += fmt::format("X{} Y{}\n", i % 50, i % 7);
  Document document(text + "X1 B5\nX2 B6\nM02\n");
  Analysis analysis(document, kFoldingSetup);
  document.replace({50, 0}, {51, 0}, "X1 Y1 B7\n");
  document.replace({52, 0}, {53, 0}, "X1 Y1 B0\n");
  analysis.update();
  EXPECT_LT(analysis.lines_checked(), 600u);
  EXPECT_THAT(texts_of_folded(folded(analysis.report())), testing::ElementsAre("line 50: ISO032 and 3 more, to 20003"));
}

/// A finding does not hide one of higher severity.
TEST(Folding, KeepsSeveritiesApart) {
  Report report = check_text("M06 T101001\nG01 X1 B1 F900\nX2 B2\nC9\nC10\nM02\n", kFoldingSetup);
  for (LocatedFinding& located : report.findings)
    if (text_of_code(located.finding.id) == "ISO032") located.selected = Severity::Info;
  EXPECT_THAT(texts_of_folded(folded(report)),
              testing::ElementsAre("line 1: ISO032 and 1 more, to 2", "line 3: ISO047 and 1 more, to 4"));
}

}  // namespace
}  // namespace isocnc::check
