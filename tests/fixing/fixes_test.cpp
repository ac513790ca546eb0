#include "analyzer/fixes/fix_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/fixing/finding_fixes.h"
#include "analyzer/fixing/fixer.h"
#include "analyzer/selection/suppressions.h"
#include "tests/support/fixed_program.h"

namespace isocnc::fixing {
namespace {

namespace fs = std::filesystem;

/// A program of tests/fixing/fixes and what becomes of it. Lines that begin with `; ----` divide a file: `before,
/// safe` or `before, unsafe`, then `after`; or `unchanged`. With `, reveals` findings of other codes show afterwards.
/// `; ====` stands between programs. A section that ends with
/// `; ---- no line end` has none at its end, nor has what becomes of it.
struct Case {
  std::string name;  ///< File and line, for messages.
  std::string code;
  fixes::Safety safety = fixes::Safety::None;
  bool reveals = false;
  std::string before;
  std::string after;
};

void finish(std::vector<Case>& cases, Case& read, bool has_no_line_end) {
  if (read.safety == fixes::Safety::None) read.after = read.before;
  if (has_no_line_end) {
    read.before.pop_back();
    read.after.pop_back();
  }
  cases.push_back(read);
}

std::vector<Case> read_cases(const fs::path& file) {
  std::vector<Case> cases;
  std::ifstream input(file, std::ios::binary);
  Case read;
  std::string* section = nullptr;
  bool has_no_line_end = false;
  std::size_t number = 0;
  for (std::string line; std::getline(input, line);) {
    ++number;
    if (line == "; ====") {
      finish(cases, read, has_no_line_end);
      section = nullptr;
    } else if (line.starts_with("; ---- before") || line == "; ---- unchanged") {
      const bool is_safe = line.find(", safe") != std::string::npos;
      read = {.name = file.filename().string() + ":" + std::to_string(number), .code = file.stem()};
      if (line != "; ---- unchanged") read.safety = is_safe ? fixes::Safety::Safe : fixes::Safety::Unsafe;
      read.reveals = line.ends_with(", reveals");
      section = &read.before;
      has_no_line_end = false;
    } else if (line == "; ---- no line end") {
      has_no_line_end = true;
    } else if (line == "; ---- after") {
      section = &read.after;
    } else if (section != nullptr) {
      *section += line + "\n";
    }
  }
  finish(cases, read, has_no_line_end);
  return cases;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto& entry : fs::directory_iterator(ISOCNC_SOURCE_DIR "/tests/fixing/fixes"))
    for (Case& each : read_cases(entry.path())) cases.push_back(std::move(each));
  std::sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.name < b.name; });
  return cases;
}

using support::codes_of;
using support::fixed;

class FixCase : public testing::TestWithParam<Case> {};

TEST_P(FixCase, BecomesWhatItShould) {
  const Case& tested = GetParam();
  EXPECT_EQ(fixed(tested.before, true, tested.code), tested.after) << tested.name;
  EXPECT_EQ(fixed(tested.before, false, tested.code),
            tested.safety == fixes::Safety::Safe ? tested.after : tested.before)
      << tested.name;
}

TEST_P(FixCase, HasTheFindingBeforeAndNoneOfAnyKindAfter) {
  const Case& tested = GetParam();
  EXPECT_GT(codes_of(tested.before, tested.code).count(tested.code), 0u) << tested.name;
  if (tested.safety == fixes::Safety::None) return;
  const std::multiset<std::string> after = codes_of(tested.after, tested.code);
  EXPECT_EQ(after.empty(), !tested.reveals) << tested.name << "\n" << tested.after;
  EXPECT_EQ(after.count(tested.code), 0u) << tested.name << "\n" << tested.after;
}

/// Who is offered a fix gets it.
TEST_P(FixCase, IsOfferedWhatIsMade) {
  const Case& tested = GetParam();
  const rules::CheckSetup setup;
  const check::Report report = support::found_in(tested.before, tested.code);
  FindingFixes fixes(tested.before, report, setup);
  const bool is_offered =
      std::any_of(report.findings.begin(), report.findings.end(), [&](const check::LocatedFinding& located) {
        return dialect::definition(located.finding.id).code == tested.code && fixes.offered(located).has_value();
      });
  EXPECT_EQ(is_offered, tested.safety != fixes::Safety::None) << tested.name;
}

/// A fix that lasts is followed down the program, however many like it stand above: the G49 at the end would be
/// written again. Without it all may be offered.
TEST(OfferedFixes, AreTriedHoweverManyThereAre) {
  const auto offered = [](std::string_view end) {
    std::string text = "M06 T101001\nF500\n";
    for (int i = 0; i < 9'000; ++i) text += "G01 X" + std::to_string(i % 977) + " C" + std::to_string(i % 7 + 1) + "\n";
    text += end;
    const rules::CheckSetup setup;
    const check::Report report = selection::Selection().shown(check::check_text(text, setup));  // Not folded.
    FindingFixes fixes(text, report, setup);
    return std::count_if(report.findings.begin(), report.findings.end(),
                         [&](const check::LocatedFinding& located) { return fixes.offered(located).has_value(); });
  };
  EXPECT_EQ(offered("G49\nM02\n"), 0);
  EXPECT_EQ(offered("M02\n"), 9'000);
}

/// The fix of a mistake that repeats (D66): one G49 mends all lines, an ignored F is removed from each.
TEST(OfferedFixes, MendAllLinesThatRepeatAFinding) {
  const rules::CheckSetup setup;
  const auto after = [&](std::string_view text) {
    const check::Report report = support::found_in(text);
    FindingFixes fixes(text, report, setup);
    std::optional<fixes::Fix> fix = fixes.offered_in_full(report.findings.at(0));
    return edited(text, fix.value().edits, fixes.program()) + fix->title_in(dialect::Language::Italian);
  };
  EXPECT_EQ(after("M06 T101001\nG01 X1 B1 F900\nX2\nX3 B3\nM02\n"),
            "M06 T101001\nG49\nG01 X1 B1 F900\nX2\nX3 B3\nM02\ninserire prima una linea con G49");
  EXPECT_EQ(after("M06 T101001\nG93\nF4\nG00 X0 F5\nF6\nM02\n"),
            "M06 T101001\nG93\nG00 X0\nM02\ntogliere F4, che viene ignorata, e su altre 2 linee");
}

/// Where many states make each trial dear, what shows on the spot is still seen: the tool change that a fix would make
/// of each T finds the spindle running (W105).
TEST(OfferedFixes, AreTriedWhereTheyAreMadeWhateverItCosts) {
  std::string text = "M06 T101001\nS9000 M03\nG91 G00 Z5\n";
  for (int i = 0; i < 7; ++i) {
    const std::string label = std::to_string(i + 1);
    text += "IF VGPL = " + label + " GOTO N" + label + "\nX" + std::to_string(1 << i) + "\nN" + label + " Y1\n";
  }
  for (int i = 0; i < 3'000; ++i) text += "T101002\nM03\n";
  text += "M05\nM02\n";
  const rules::CheckSetup setup;
  const check::Report report = support::found_in(text);
  FindingFixes fixes(text, report, setup);
  EXPECT_GT(report.findings.size(), 2'999u);
  for (const check::LocatedFinding& located : report.findings) ASSERT_FALSE(fixes.offered(located)) << located.line;
}

/// A center with a finding of its own is not rewritten before that is mended: I=-5 would become I105=-5.
TEST(ArcFixes, MendAWordBeforeItIsRewritten) {
  const auto program = [](std::string_view evidence, std::string_view turn) {
    return fmt::format("M06 T101001\nG00 X110 Y105\nG03 X115 Y110 {} F1000\nG01 X110 Y110\nG02 X110 Y110 {}\nM02\n",
                       evidence, turn);
  };
  EXPECT_EQ(fixed(program("I0 J5", "I=-5 J0"), true), program("I110 J110", "I105 J110"));
}

/// Many centers of one habit are tried, and shown, in no time that grows with their square.
TEST(ArcFixes, OfManyCentersAreMadeAtOnce) {
  std::string text = "M06 T101001\nG00 X110 Y105\nG03 X115 Y110 I0 J5 F1000\n";
  for (int i = 0; i < 20'000; ++i) text += i % 2 == 0 ? "G02 X105 Y110 I-5 J0\n" : "G02 X115 Y110 I5 J0\n";
  text += "M02\n";
  const rules::CheckSetup setup;
  const check::Report report = support::found_in(text);
  FindingFixes fixes(text, report, setup);
  std::size_t in_full = 0;
  for (const check::LocatedFinding& located : report.findings)
    if (const auto fix = fixes.offered_in_full(located)) in_full += fix->edits.size();
  EXPECT_EQ(in_full, 2u * 20'001);
  EXPECT_TRUE(codes_of(fixed(text, true)).empty());
}

/// Of a mistake that is folded over two lines, a G49 above the second one mends that line alone.
TEST(FixText, SaysThatItHasFixedSomethingWhereTheTextChanges) {
  const selection::Selection selection;
  const rules::CheckSetup setup;
  const std::string text = "M06 T101001\nG00 X10\nG02 C10 F1000\nG01 C20\nM02\n";
  const FixedText fixed = fix_text(text, {.selection = selection, .setup = setup, .unsafe = true});
  EXPECT_NE(fixed.text, text);
  EXPECT_EQ(fixed.fixed, 1u);
}

/// Arcs are mended by the tolerance of the machine: up to ten times as far, and to within half of it.
TEST(ArcFixes, GoByTheToleranceOfTheMachine) {
  const auto mended = [](double tolerance, const std::string& arc) {
    rules::CheckSetup setup;
    setup.machine.arc_tolerance = tolerance;
    const selection::Selection selection;
    const std::string text = "M06 T101001\n" + arc + " F1000\nM02\n";
    const FixedText fixed = fix_text(text, {.selection = selection, .setup = setup, .unsafe = true});
    EXPECT_EQ(fixed.text == text, !fixed.report.findings.empty()) << fixed.text;
    return fixed.text != text;
  };
  // 10 and 9.95 mm from the ends.
  EXPECT_TRUE(mended(0.01, "G02 X10 Y10 I10 J0.05"));
  EXPECT_FALSE(mended(0.001, "G02 X10 Y10 I10 J0.05"));
  // 10 and 9.5 mm.
  EXPECT_FALSE(mended(0.01, "G02 X10 Y10 I10 J0.5"));
  EXPECT_TRUE(mended(0.1, "G02 X10 Y10 I10 J0.5"));
  // More decimals than are there, where three do not suffice.
  EXPECT_TRUE(mended(0.0001, "G02 X10 Y9.9997 I10 J0"));
}

/// A number with a foreign minus is no text, whatever follows it (D67); the en dash of Windows-1252 is no valid UTF-8.
TEST(TextFixes, MakeNoCommentOfANumber) {
  for (const std::string dash : {"\x96", "\xE2\x80\x93"}) {
    const std::string text = "M06 T101001\nN " + dash + "10mm G00 X5\nM02\n";
    EXPECT_EQ(codes_of(text), (std::multiset<std::string>{"ISO003", "ISO004"}));
    EXPECT_EQ(fixed(text, true), text);
  }
}

/// A T is joined with its M06 across a few lines; farther down it may belong to something else.
TEST(ToolFixes, LookTwentyLinesDown) {
  const auto program = [](int comments, std::string_view first, std::string_view last) {
    std::string text(first);
    for (int i = 0; i < comments; ++i) text += "(ROUGHING)\n";
    return text + std::string(last) + "G00 X10\nM02\n";
  };
  EXPECT_EQ(fixed(program(19, "M06\n", "T101001\n"), true), program(19, "M06 T101001\n", ""));
  EXPECT_EQ(fixed(program(20, "M06\n", "T101001\n"), true), program(20, "M06\n", "T101001\n"));
  EXPECT_EQ(fixed(program(19, "T101001\n", "M06\n"), true), program(19, "", "M06 T101001\n"));
  EXPECT_EQ(fixed(program(20, "T101001\n", "M06\n"), true), program(20, "T101001\n", "M06\n"));
}

/// The number of a program may follow a head of comments, but no lines of another program.
TEST(ForeignFixes, FindTheNumberOfAProgramBelowItsHead) {
  const auto program = [](int comments, std::string_view number) {
    std::string text;
    for (int i = 0; i < comments; ++i) text += "(PART)\n";
    return text + std::string(number) + "M06 T101001\nM02\n";
  };
  EXPECT_EQ(fixed(program(100, "O1234\n"), true), program(100, ""));
  EXPECT_EQ(fixed(program(101, "O1234\n"), true), program(101, "O1234\n"));
}

/// CR, LF or CRLF: what is inserted ends like what is there.
TEST_P(FixCase, KeepsLineEnds) {
  const Case& tested = GetParam();
  for (const std::string line_end : {"\r\n", "\r"}) {
    const auto with = [&](const std::string& text) { return std::regex_replace(text, std::regex("\n"), line_end); };
    EXPECT_EQ(fixed(with(tested.before), true, tested.code), with(tested.after)) << tested.name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, FixCase, testing::ValuesIn(all_cases()), [](const auto& tested) {
  return std::regex_replace(tested.param.name, std::regex("[^A-Za-z0-9]"), "_");
});

/// The rows that made a fix for some finding of the cases, by their titles.
TEST(FixTable, HasACaseForEachRow) {
  std::set<std::pair<dialect::DiagnosticId, std::string_view>> made;
  const rules::CheckSetup setup;
  for (const Case& tested : all_cases()) {
    const check::Report report = support::found_in(tested.before, tested.code);
    FindingFixes fixes(tested.before, report, setup);
    for (const check::LocatedFinding& located : report.findings)
      if (const auto fix = fixes.of(located)) made.emplace(located.finding.id, fix->title.en);
  }
  for (const fixes::FixDef& row : fixes::kFixes) {
    if (row.make == nullptr) continue;
    EXPECT_TRUE(made.contains({row.diagnostic, row.title.en}))
        << dialect::definition(row.diagnostic).code << ": " << row.title.en;
  }
}

TEST(FixTable, HasTheRowsOfACodeTogetherAndAReasonAlone) {
  std::map<dialect::DiagnosticId, int> rows;
  for (std::size_t i = 0; i < fixes::kFixes.size(); ++i) {
    const fixes::FixDef& row = fixes::kFixes[i];
    const bool follows = i > 0 && fixes::kFixes[i - 1].diagnostic == row.diagnostic;
    EXPECT_EQ(rows[row.diagnostic]++ > 0, follows) << dialect::definition(row.diagnostic).code;
    EXPECT_FALSE(follows && (row.make == nullptr || fixes::kFixes[i - 1].make == nullptr)) << row.title.en;
  }
}

TEST(FixTable, SpeaksBothLanguages) {
  const auto names_in = [](std::string_view title) {
    static const std::regex kName(R"(\{([a-z]*)\})");
    const std::string text(title);
    std::set<std::string> names;
    for (std::sregex_iterator it(text.begin(), text.end(), kName); it != std::sregex_iterator(); ++it)
      names.insert((*it)[1]);
    return names;
  };
  for (const fixes::FixDef& row : fixes::kFixes) {
    EXPECT_FALSE(row.title.en.empty());
    EXPECT_FALSE(row.title.it.empty());
    EXPECT_EQ(row.make == nullptr, row.safety == fixes::Safety::None) << row.title.en;
    EXPECT_EQ(row.title.en.ends_with('.'), row.make == nullptr) << row.title.en;
    EXPECT_EQ(row.title.it.ends_with('.'), row.make == nullptr) << row.title.it;
    EXPECT_EQ(names_in(row.title.en), names_in(row.title.it));
    for (const std::string& name : names_in(row.title.en)) EXPECT_TRUE(name == "text" || name == "new") << name;
  }
}

/// What a title speaks of is there.
TEST(FixTitles, NameWhatIsMarkedAndWhatIsNew) {
  const rules::CheckSetup setup;
  for (const Case& tested : all_cases()) {
    const check::Report report = support::found_in(tested.before, tested.code);
    FindingFixes fixes(tested.before, report, setup);
    for (const check::LocatedFinding& located : report.findings) {
      const auto fix = fixes.of(located);
      if (!fix) continue;
      const bool names_new = fix->title.en.find("{new}") != std::string_view::npos;
      EXPECT_TRUE(!names_new || !fix->what.empty()) << tested.name;
      EXPECT_EQ(fix->title_in(dialect::Language::Italian).find('{'), std::string::npos);
    }
  }
}

/// What is wrong at the end of a program is found beside an M02 with company, too, so that it is none of the fix's.
TEST(Fixes, PutM02OnItsOwnLineWhateverIsStillInForce) {
  EXPECT_EQ(fixed("M06 T101001\nS1000 M03\nG29 X5\nG00 X10 M02\nG00 X20\n", false),
            "M06 T101001\nS1000 M03\nG29 X5\nG00 X10\nM02\nG00 X20\n");
}

/// Becomes better by its fixes, never worse.
void expect_mended(const std::string& wrong, std::string_view code) {
  const std::multiset<std::string> before = codes_of(wrong, code);
  const std::string text = fixed(wrong, true, code);
  const std::multiset<std::string> after = codes_of(text, code);
  EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end())) << code << "\n" << text;
  EXPECT_EQ(text == wrong, after == before) << code << "\n" << text;
}

TEST(FixTable, MendsTheTablesOwnPrograms) {
  const auto without_marks = [](std::string_view program) {
    return std::regex_replace(std::string(program), std::regex(R"(\[!|!\])"), "");
  };
  for (const dialect::DiagnosticDef& def : dialect::kDiagnostics) {
    expect_mended(without_marks(def.wrong), def.code);
    for (const dialect::CauseDef& cause : def.causes) expect_mended(without_marks(cause.wrong), def.code);
  }
}

}  // namespace
}  // namespace isocnc::fixing
