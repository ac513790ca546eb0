#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/selection/program_settings.h"
#include "analyzer/selection/shown_report.h"
#include "interpreter/syntax/line_finder.h"
#include "tests/support/temporary_folder.h"

/// House rules from the configuration to what is shown.
namespace isocnc::selection {
namespace {

using dialect::Language;

constexpr std::string_view kCode = "W143";

/// Programs under the house rules of one configuration.
class Shop {
 public:
  explicit Shop(std::string_view house_rules, std::string_view further_lint = "", SelectionOptions command_line = {})
      : program_(folder_.path("part.iso")) {
    folder_.write("isocnc.json", fmt::format(R"({{"lint": {{"houseRules": {}{}}}}})", house_rules, further_lint));
    finder_.emplace(configurations_, std::move(command_line));
    settings_ = &finder_->of(program_);
    EXPECT_THAT(configurations_.mistakes(Language::English), testing::IsEmpty()) << house_rules;
  }

  check::Report report(std::string_view text) const {
    return shown_report(check::check_text(text, settings_->setup), text, settings_->selection);
  }

  /// The findings of house rules, each as `LINE:COLUMN severity message`.
  std::vector<std::string> findings(std::string_view text, Language language = Language::English) const {
    std::vector<std::string> all;
    const check::Report shown = report(text);
    for (const check::LocatedFinding& located : shown.findings) {
      if (dialect::definition(located.finding.id).code != kCode) continue;
      const std::string_view line = syntax::LineFinder(text).line(located.line);
      all.push_back(fmt::format("{}:{} {} {}", located.line + 1, located.finding.span.begin,
                                dialect::severity_name(located.severity(), Language::English),
                                syntax::message(located.finding, line, language)));
    }
    return all;
  }

 private:
  support::TemporaryFolder folder_;
  std::filesystem::path program_;
  configuration::Configurations configurations_{{}, Language::English};
  std::optional<SettingsFinder> finder_;
  const ProgramSettings* settings_ = nullptr;
};

// --- The examples of the page

struct PageExample {
  std::string heading;
  std::string rules;
  std::string program;
};

std::vector<PageExample> examples_of(const std::string& page) {
  std::vector<PageExample> examples;
  std::ifstream lines(std::filesystem::path(ISOCNC_SOURCE_DIR) / page);
  std::string* block = nullptr;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("### ")) {
      examples.push_back({.heading = line.substr(4), .rules = {}, .program = {}});
    } else if (line.starts_with("```") && !examples.empty()) {
      block = block ? nullptr : line == "```jsonc" ? &examples.back().rules : &examples.back().program;
    } else if (block) {
      *block += line + "\n";
    }
  }
  return examples;
}

class HouseRulePage : public testing::TestWithParam<std::string> {};

TEST_P(HouseRulePage, ExamplesHaveTheFindingsThatTheyMark) {
  const std::vector<PageExample> examples = examples_of(GetParam());
  ASSERT_EQ(examples.size(), 10U);
  for (const PageExample& example : examples) {
    SCOPED_TRACE(example.heading);
    std::vector<std::size_t> marked;
    std::istringstream lines(example.program);
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line); ++number)
      if (line.ends_with("; " + std::string(kCode))) marked.push_back(number);
    EXPECT_FALSE(marked.empty());
    std::vector<std::size_t> found;
    for (const check::LocatedFinding& located : Shop(example.rules).report(example.program).findings) {
      const dialect::DiagnosticDef& def = dialect::definition(located.finding.id);
      EXPECT_NE(def.severity, dialect::Severity::Error) << def.code << " on line " << located.line + 1;
      if (def.code == kCode) found.push_back(located.line);
    }
    EXPECT_EQ(found, marked);
  }
}

INSTANTIATE_TEST_SUITE_P(Pages, HouseRulePage, testing::Values("docs/house-rules.md", "docs/it/regole.md"),
                         [](const auto& page) { return page.index == 0 ? "English" : "Italian"; });

// --- Order

constexpr std::string_view kCoolant =
    R"([{"id": "coolant", "require": ["M08"], "before": ["cut"], "since": ["toolChange"], "severity": "error",
         "message": {"en": "coolant first", "it": "prima il refrigerante"}}])";

TEST(HouseRules, SayTheirMessageInTheLanguageOfTheReader) {
  const std::string program = "M06 T101001\nG01 X10 F1000\nM02\n";
  const Shop shop(kCoolant);
  EXPECT_THAT(shop.findings(program), testing::ElementsAre("2:0 error coolant first (coolant)"));
  EXPECT_THAT(shop.findings(program, Language::Italian),
              testing::ElementsAre("2:0 error prima il refrigerante (coolant)"));
}

TEST(HouseRules, JudgeTheWordsOfALineInTheirOrder) {
  const Shop shop(kCoolant);
  EXPECT_THAT(shop.findings("M06 T101001\nM08 G01 X10 F1000\nM02\n"), testing::IsEmpty());
  EXPECT_THAT(shop.findings("M06 T101001\nG01 X10 F1000 M08\nM02\n"), testing::SizeIs(1));
  EXPECT_THAT(shop.findings("M06 T101001 M08\nG01 X10 F1000\nM02\n"), testing::IsEmpty());
  EXPECT_THAT(shop.findings("M08 M06 T101001\nG01 X10 F1000\nM02\n"), testing::SizeIs(1));
}

/// Modal continuations, arcs and many plain lines go another way through the checker.
TEST(HouseRules, SeeMotionsWithoutTheirG) {
  const Shop shop(kCoolant);
  std::string program = "M06 T101001\nM08\nG01 X1 F1000\n";
  for (int i = 0; i < 500; ++i) program += fmt::format("X{}\n", i % 7);
  program += "M06 T101002\nG00 X5\nY5\nG01\n";
  EXPECT_THAT(shop.findings(program + "M02\n"), testing::IsEmpty());  // G01 alone is an error, and no cut.
  EXPECT_THAT(shop.findings(program + "X9\nX8\nM06 T101003\nM08\nX7\nM02\n"), testing::SizeIs(1));
}

std::string path_of(const check::Report& report, const check::LocatedFinding& located) {
  std::string path;
  if (located.path >= 0)
    for (const check::PathStep& step : report.paths[static_cast<std::size_t>(located.path)])
      path += fmt::format("{}{} ", step.taken ? "" : "not ", step.line + 1);
  return path;
}

TEST(HouseRules, AreJudgedOnEachPath) {
  const Shop shop(kCoolant);
  const std::string skipped = "M06 T101001\nIF VGPL = 1 GOTO N1\nM08\nN1\nG00 X1\nG01 X10 F1000\nM02\n";
  const check::Report report = shop.report(skipped);
  const auto found = std::find_if(report.findings.begin(), report.findings.end(), [](const auto& located) {
    return dialect::definition(located.finding.id).code == kCode;
  });
  ASSERT_NE(found, report.findings.end());
  EXPECT_EQ(found->line, 5U);
  EXPECT_EQ(path_of(report, *found), "2 ");
  // On both ways the coolant is on.
  EXPECT_THAT(
      shop.findings("M06 T101001\nIF VGPL = 1 GOTO N1\nM08\nIF VGPL = 2 GOTO N2\nN1 M08\nN2\nG01 X10 F1000\nM02\n"),
      testing::IsEmpty());
  // The register keeps the paths apart: where the coolant is off, nothing is cut.
  EXPECT_THAT(shop.findings("M06 T101001\nV1 = 0\nIF VGPL = 1 GOTO N1\nM08\nV1 = 1\nN1\nIF V1 = 0 GOTO N2\n"
                            "G01 X10 F1000\nN2 M02\n"),
              testing::IsEmpty());
  EXPECT_THAT(shop.findings("M06 T101001\nV1 = 0\nIF VGPL = 1 GOTO N1\nM08\nV1 = 1\nN1\nIF V1 = 1 GOTO N2\n"
                            "G01 X10 F1000\nN2 M02\n"),
              testing::SizeIs(1));
}

/// A finding needs what the program says; what cannot be read may have been the M that is missing.
TEST(HouseRules, SayNothingBecauseOfAnotherMistake) {
  const Shop shop(kCoolant);
  for (const std::string_view line : {"M0l8", "M", "08", "G77 X1", "MO8", "(coolant M08", "#500=8 M08"})
    EXPECT_THAT(shop.findings(fmt::format("M06 T101001\n{}\nG01 X10 F1000\nM02\n", line)), testing::IsEmpty()) << line;
  // An arc that does not fit hides nothing: its words can be read.
  EXPECT_THAT(shop.findings("M06 T101001\nG00 X0 Y0\nG02 X10 Y0 R1 F1000\nG01 X20\nM02\n"),
              testing::ElementsAre(testing::StartsWith("4:0")));
}

TEST(HouseRules, OfOneLineAreSeveralFindings) {
  const Shop shop(R"([{"id": "a", "head": ["G71", "G90"], "message": "a"},
                      {"id": "b", "comment": "X", "before": ["motion"], "severity": "info", "message": "b"}])");
  EXPECT_THAT(shop.findings("M06 T101001\nG00 X1\nG00 X2\nM02\n"),
              testing::ElementsAre("2:0 warning a: G71 (a)", "2:0 warning a: G90 (a)", "2:0 info b (b)"));
}

// --- Numbers

TEST(HouseRules, GiveTheNumbersOfThisProgram) {
  const Shop shop(R"([{"id": "s", "speedFrom": 3000, "message": "s"}, {"id": "f", "feedFrom": 100, "feedTo": 2000,
                       "message": "f"}, {"id": "z", "lowestZ": -25.4, "message": "z"}])");
  EXPECT_THAT(shop.findings("M06 T101001\nS2000 M03\nG70\nG01 X1 F1000\nZ-2 F40\nG71\nG01 Z-60 F50\nM02\n"),
              testing::ElementsAre("2:0 warning s (s): S is 2000, and at least 3000 is right here",
                                   "4:7 warning f (f): the feed is 25400 mm/min, and at most 2000 is right here",
                                   "5:0 warning z (z): this goes down to Z-2 in, and Z-1 is the lowest",
                                   "7:9 warning f (f): the feed is 50 mm/min, and at least 100 is right here"));
}

TEST(HouseRules, FollowArcsBelowTheirEnds) {
  const Shop shop(R"([{"id": "z", "lowestZ": -5, "message": "z"}])");
  const std::string arc = " X20 Z0 R10 F1000\nM02\n";
  EXPECT_THAT(shop.findings("M06 T101001\nG18\nG00 X0 Z0\nG03" + arc), testing::IsEmpty());
  EXPECT_THAT(shop.findings("M06 T101001\nG18\nG00 X0 Z0\nG02" + arc), testing::SizeIs(1));
}

TEST(HouseRules, LeaveTurningFeedsAlone) {
  const Shop shop(R"([{"id": "f", "feedTo": 2000, "message": "f"}])");
  EXPECT_THAT(shop.findings("M06 T101001\nG49\nG01 B10 F5000\nM02\n"), testing::IsEmpty());  // Degrees per minute.
  EXPECT_THAT(shop.findings("M06 T101001\nG49\nG01 B10 X1 F5000\nM02\n"), testing::SizeIs(1));
  EXPECT_THAT(shop.findings("M06 T101001\nG00 X1 F5000\nM02\n"), testing::IsEmpty());  // An F on a rapid is ignored.
}

// --- Selection

TEST(HouseRules, KeepTheirSeverityUnlessTheirCodeIsGivenOne) {
  const std::string program = "M06 T101001\nG01 X10 F1000\nM02\n";
  const auto severity_of = [&](const Shop& shop) {
    const std::vector<std::string> found = shop.findings(program);
    return found.empty() ? "" : found.front().substr(4, found.front().find(' ', 4) - 4);
  };
  EXPECT_EQ(severity_of(Shop(kCoolant)), "error");
  EXPECT_EQ(severity_of(Shop(kCoolant, R"(, "severity": {"W143": "info"})")), "info");
  EXPECT_EQ(severity_of(Shop(kCoolant, R"(, "severity": {"W142": "info"})")), "error");
  EXPECT_EQ(severity_of(Shop(kCoolant, "", {.severities = {"house-rule=warning"}})), "warning");
  EXPECT_EQ(severity_of(Shop(kCoolant, R"(, "ignore": ["W143"])")), "");
  EXPECT_EQ(severity_of(Shop(kCoolant, "", {.select = {"ISO"}})), "");
  EXPECT_EQ(severity_of(Shop(kCoolant, R"(, "files": [{"paths": ["part.iso"], "ignore": ["house-rule"]}])")), "");
}

TEST(HouseRules, AreSilencedByComments) {
  const Shop shop(kCoolant);
  EXPECT_THAT(shop.findings("M06 T101001\nG01 X10 F1000 ;isolint: ignore W143\nM02\n"), testing::IsEmpty());
  EXPECT_THAT(shop.findings("M06 T101001\nG01 X10 F1000 ;isolint: ignore W142\nM02\n"), testing::SizeIs(1));
}

}  // namespace
}  // namespace isocnc::selection
