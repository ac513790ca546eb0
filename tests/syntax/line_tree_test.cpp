#include "interpreter/syntax/line_tree.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "interpreter/syntax/tree_store.h"
#include "tests/support/tree_text.h"

namespace isocnc::syntax {
namespace {

struct TreeCase {
  const char* line;
  const char* expected;
};

/// `G1 at 0-2, ...`: each word's text as written, with its place.
std::string words_of(const LineTree& tree) {
  std::string text;
  for (const Word& word : tree.words) {
    if (!text.empty()) text += ", ";
    text += fmt::format("{} at {}", tree.text_of(word.span()), support::text_of(word.span()));
  }
  return text;
}

class Words : public testing::TestWithParam<TreeCase> {};

TEST_P(Words, StandWhereTheyAreWritten) {
  const ParsedLine line(GetParam().line);
  EXPECT_EQ(words_of(line.tree()), GetParam().expected) << GetParam().line;
}

INSTANTIATE_TEST_SUITE_P(Plain, Words,
                         testing::Values(TreeCase{"", ""}, TreeCase{" \t ", ""}, TreeCase{"G0", "G0 at 0-2"},
                                         TreeCase{"G1X10", "G1 at 0-2, X10 at 2-5"},
                                         TreeCase{" g1 x-2.5 ", "g1 at 1-3, x-2.5 at 4-9"},
                                         TreeCase{"M06T130207", "M06 at 0-3, T130207 at 3-10"},
                                         TreeCase{"V1=2.5 X1", "V1 at 0-2, =2.5 at 2-6, X1 at 7-9"},
                                         TreeCase{"X1 N7", "X1 at 0-2, N7 at 3-5"}));

INSTANTIATE_TEST_SUITE_P(
    BlanksAndComments, Words,
    testing::Values(TreeCase{"G 0 Z - 5 . 65", "G 0 at 0-3, Z - 5 . 65 at 4-14"}, TreeCase{"X\t1\t", "X\t1 at 0-3"},
                    TreeCase{"X1(a)0 Y2", "X1(a)0 at 0-6, Y2 at 7-9"}, TreeCase{"X(a)1", "X(a)1 at 0-5"},
                    TreeCase{"X1(a) Y2", "X1 at 0-2, Y2 at 6-8"}, TreeCase{"X1;Y2", "X1 at 0-2"},
                    TreeCase{"(X1;(Y2) Z3", "Z3 at 9-11"}, TreeCase{"T 1 30 207", "T 1 30 207 at 0-10"},
                    TreeCase{"V 1 = 2", "V 1 at 0-3, = 2 at 4-7"}));

INSTANTIATE_TEST_SUITE_P(
    Jumps, Words,
    testing::Values(
        TreeCase{"IF V1<=2 GOTO N30", "IF at 0-2, V1 at 3-5, <= at 5-7, 2 at 7-8, GOTO at 9-13, N30 at 14-17"},
        TreeCase{"ifvgpl=1goton3", "if at 0-2, vgpl at 2-6, = at 6-7, 1 at 7-8, goto at 8-12, n3 at 12-14"},
        TreeCase{"I F V G P L < > 1 G O T O N 3",
                 "I F at 0-3, V G P L at 4-11, < > at 12-15, 1 at 16-17, G O T O at 18-25, N 3 at 26-29"},
        TreeCase{"IF V1=-.5 GOTO N1", "IF at 0-2, V1 at 3-5, = at 5-6, -.5 at 6-9, GOTO at 10-14, N1 at 15-17"}));

INSTANTIATE_TEST_SUITE_P(Errors, Words,
                         testing::Values(TreeCase{"%", "% at 0-1"}, TreeCase{"#5 X1", "#5 at 0-2, X1 at 3-5"},
                                         TreeCase{"X Y1", "X at 0-1, Y1 at 2-4"},
                                         TreeCase{"5 X1", "5 at 0-1, X1 at 2-4"}, TreeCase{"X1.2.3", "X1.2.3 at 0-6"},
                                         TreeCase{"\xC3\xA8 X1", "\xC3\xA8 at 0-2, X1 at 3-5"},
                                         TreeCase{"L5 * X1", "L5 at 0-2, * at 3-4, X1 at 5-7"}));

TEST(LineTree, WordsCarryWhatIsWrittenOfTheirNumber) {
  const ParsedLine line("G01 X-2.50 Y Z1.2.3");
  const LineTree tree = line.tree();
  ASSERT_EQ(tree.words.size(), 4u);
  EXPECT_TRUE(tree.words[0].is_plain_integer());
  EXPECT_EQ(tree.words[1].value, -2.5);
  EXPECT_EQ(tree.words[1].digits, 3u);
  EXPECT_TRUE(tree.words[1].has(Word::kSigned));
  EXPECT_TRUE(tree.words[1].has(Word::kPoint));
  EXPECT_TRUE(tree.words[2].has(Word::kMissing));
  EXPECT_TRUE(tree.words[3].has(Word::kMalformed));
  EXPECT_FALSE(tree.words[2].known());
  EXPECT_FALSE(tree.words[3].known());
}

TEST(Word, IsWholeIfAnIntHoldsItsValue) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto whole = [](double value) {
    Word word{};
    word.value = value;
    return word.whole();
  };
  EXPECT_EQ(whole(8), 8);
  EXPECT_EQ(whole(-8), -8);
  EXPECT_EQ(whole(-0.0), 0);
  EXPECT_EQ(whole(2147483647), 2147483647);
  for (const double other : {kNaN, 8.5, -0.1, 2147483648.0, -2147483648.0, 1e300, -1e300, kInfinity})
    EXPECT_EQ(whole(other), std::nullopt) << other;
}

TEST(Word, NamesAToolBySixDigitsAndAParameterByOneOfTwentyNumbers) {
  const auto tool = [](std::string_view t) { return ParsedLine(t).tree().words[0].tool_number(); };
  EXPECT_EQ(tool("T101001"), 101001);
  for (const char* const other : {"T10100", "T1010011", "T+101001", "T1010.01", "T", "T1x1001"})
    EXPECT_EQ(tool(other), std::nullopt) << other;
  const auto parameter = [](std::string_view p) { return ParsedLine(p).tree().words[0].parameter_number(); };
  EXPECT_EQ(parameter("P1"), 1);
  EXPECT_EQ(parameter("P20"), 20);
  for (const char* const other : {"P0", "P21", "P+1", "P1.0", "P", "P99999999999"})
    EXPECT_EQ(parameter(other), 0) << other;
}

TEST(LineTree, LettersAreUpperCase) {
  const ParsedLine line("g1 x1 y2 f300");
  for (const Word& word : line.tree().words) EXPECT_TRUE(word.letter >= 'A' && word.letter <= 'Z');
}

TEST(LineTree, ErrorsAndNumbersHaveSignsOfTheirOwn) {
  EXPECT_EQ(ParsedLine("%12").tree().words[0].letter, kError);
  EXPECT_EQ(ParsedLine("12").tree().words[0].letter, kNumber);
  EXPECT_EQ(ParsedLine("V1=2").tree().words[1].letter, kAssign);
}

TEST(LineTree, FindsTheWordUnderAColumn) {
  const ParsedLine line("G1  X10");
  const LineTree tree = line.tree();
  EXPECT_EQ(tree.word_at(0), &tree.words[0]);
  EXPECT_EQ(tree.word_at(1), &tree.words[0]);
  EXPECT_EQ(tree.word_at(2), nullptr);
  EXPECT_EQ(tree.word_at(6), &tree.words[1]);
  EXPECT_EQ(tree.word_at(7), nullptr);
}

class Comments : public testing::TestWithParam<TreeCase> {};

TEST_P(Comments, AreListed) {
  const ParsedLine line(GetParam().line);
  std::string text;
  for (const Span comment : line.tree().comments) text += fmt::format("[{}]", line.tree().text_of(comment));
  EXPECT_EQ(text, GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Lines, Comments,
                         testing::Values(TreeCase{"X1", ""}, TreeCase{"(a)X1(b)", "[(a)][(b)]"},
                                         TreeCase{"X1;a(b)", "[;a(b)]"}, TreeCase{"(a(b)c", "[(a(b)]"},
                                         TreeCase{"(a;b)", "[(a;b)]"}, TreeCase{"X1(a)0", "[(a)]"},
                                         TreeCase{"X(a)1(b)", "[(a)][(b)]"}, TreeCase{"V1(a)=(b)2", "[(a)][(b)]"},
                                         TreeCase{"I(a)F V1=2 G(b)OTO N1", "[(a)][(b)]"},
                                         TreeCase{"IF V(a)GPL=2 GOTO N1", "[(a)]"}, TreeCase{"X1 (a", "[(a]"},
                                         TreeCase{"()", "[()]"}, TreeCase{";", "[;]"},
                                         TreeCase{"X1(a)(b)0", "[(a)][(b)]"}));

/// `G01(X1 Z5)`: each instruction with its arguments; F, S and N belong to none.
std::string instructions_of(const LineTree& tree) {
  std::string text;
  for (const Instruction& each : tree.instructions) {
    if (!text.empty()) text += ' ';
    text += each.kind == InstructionKind::Continuation ? "" : tree.text_of(tree.command(each).span());
    std::string arguments;
    for (std::uint16_t i = each.begin; i < each.end; ++i) {
      if (tree.words[i].owner != each.number) continue;
      if (i == each.command && each.kind != InstructionKind::Continuation) continue;
      if (!arguments.empty()) arguments += ' ';
      arguments += tree.text_of(tree.words[i].span());
    }
    text += '(' + arguments + ')';
  }
  return text;
}

class Instructions : public testing::TestWithParam<TreeCase> {};

TEST_P(Instructions, HaveTheirArguments) {
  const ParsedLine line(GetParam().line);
  EXPECT_EQ(instructions_of(line.tree()), GetParam().expected) << GetParam().line;
}

INSTANTIATE_TEST_SUITE_P(
    Lines, Instructions,
    testing::Values(TreeCase{"", ""}, TreeCase{"N10", ""}, TreeCase{"F100 S200", ""}, TreeCase{"G1 X1 Z5", "G1(X1 Z5)"},
                    TreeCase{"X1 Y2", "(X1 Y2)"}, TreeCase{"G90 G1 X1", "G90() G1(X1)"},
                    TreeCase{"G1 X1 F300 Z5", "G1(X1 Z5)"}, TreeCase{"G1 X1 S500 Z5", "G1(X1 Z5)"},
                    TreeCase{"G1 X1 N5 Z5", "G1(X1 Z5)"}, TreeCase{"G2 X1 Y1 I0 J5 G9", "G2(X1 Y1 I0 J5) G9()"},
                    TreeCase{"G4 P1.5", "G4(P1.5)"}, TreeCase{"G24 X1 I1 P1 A1", "G24(X1 I1 P1 A1)"},
                    TreeCase{"M06 T101001 M3", "M06(T101001) M3()"}, TreeCase{"T101001", "T101001()"},
                    TreeCase{"V1=2 V2=3 X1", "V1(=2) V2(=3) (X1)"},
                    TreeCase{"M100 P1=2.5 P2=-3", "M100(P1 =2.5 P2 =-3)"}));

/// Who collects the arguments of a G by their letters relies on that.
TEST(LineTree, ArgumentsOfAGAreLetters) {
  const ParsedLine line("P20 M100 =5 G00 X7");
  const LineTree tree = line.tree();
  for (const Instruction& g : tree.instructions) {
    if (g.kind != InstructionKind::G) continue;
    for (const Word& word : tree.words) EXPECT_FALSE(word.owner == g.number && word.letter == kError);
  }
  EXPECT_EQ(tree.words.front().letter, kError);
}

TEST(LineTree, UserFunctionsTakeTwentyParameters) {
  std::string text = "M100";
  for (int i = 1; i <= 20; ++i) text += fmt::format(" P{}={}.5", i, i);
  const ParsedLine line(text);
  const LineTree tree = line.tree();
  ASSERT_EQ(tree.instructions.size(), 1u);
  EXPECT_EQ(tree.instructions[0].kind, InstructionKind::Function);
  ASSERT_EQ(tree.words.size(), 41u);
  for (const Word& word : tree.words) EXPECT_EQ(word.owner, 0);
  EXPECT_EQ(tree.words[40].value, 20.5);
  EXPECT_TRUE(tree.findings.empty());
}

TEST(LineTree, InstructionsHaveAKind) {
  const auto kind = [](const char* text) { return ParsedLine(text).tree().instructions[0].kind; };
  EXPECT_EQ(kind("G1 X1"), InstructionKind::G);
  EXPECT_EQ(kind("X1"), InstructionKind::Continuation);
  EXPECT_EQ(kind("M3"), InstructionKind::Function);
  EXPECT_EQ(kind("M06 T101001"), InstructionKind::ToolChange);
  EXPECT_EQ(kind("T101001"), InstructionKind::StrayTool);
  EXPECT_EQ(kind("V1=2"), InstructionKind::Assignment);
  EXPECT_EQ(kind("IF V1=2 GOTO N1"), InstructionKind::Jump);
}

TEST(LineTree, KnowsTheRowOfEachG) {
  EXPECT_EQ(ParsedLine("G001 X1").tree().instructions[0].g()->number, 1);
  EXPECT_EQ(ParsedLine("G990").tree().instructions[0].g()->number, 990);
  EXPECT_EQ(ParsedLine("G77").tree().instructions[0].g(), nullptr);
}

struct LabelCase {
  const char* line;
  bool has_label;
  std::uint64_t label;
};

class Labels : public testing::TestWithParam<LabelCase> {};

TEST_P(Labels, MayStandAnywhere) {
  const ParsedLine line(GetParam().line);
  EXPECT_EQ(line.tree().has_label(), GetParam().has_label);
  EXPECT_EQ(line.tree().label, GetParam().label);
}

INSTANTIATE_TEST_SUITE_P(Lines, Labels,
                         testing::Values(LabelCase{"N7 X1", true, 7}, LabelCase{"X1 N007", true, 7},
                                         LabelCase{"X1 N7 Y2", true, 7}, LabelCase{"N0", true, 0},
                                         LabelCase{"N 1 (a) 2", true, 12}, LabelCase{"X1", false, 0},
                                         LabelCase{"N-7", false, 0}, LabelCase{"N1.5", false, 0},
                                         LabelCase{"N", false, 0}, LabelCase{"IF V1=2 GOTO N7", false, 0},
                                         LabelCase{"N8 IF V1=2 GOTO N7", true, 8},
                                         LabelCase{"IF V1=2 GOTO N7 N8", true, 8}));

TEST(LineTree, LongLabelsDiffer) {
  const auto label = [](const char* text) { return ParsedLine(text).tree().label; };
  EXPECT_NE(label("N12345678901234567890"), label("N12345678901234567891"));
  EXPECT_EQ(label("N12345678901234567890"), label("N000 12345678901234567890"));
}

TEST(LineTree, KnowsItsFeedAndSpindleSpeed) {
  const ParsedLine line("G1 F300 X1 S5000");
  EXPECT_EQ(line.tree().feed, 1);
  EXPECT_EQ(line.tree().spindle, 3);
  EXPECT_EQ(ParsedLine("G1 X1").tree().feed, -1);
  EXPECT_EQ(ParsedLine("G1 X1").tree().spindle, -1);
}

TEST(LineTree, LinesThatDoNothingAreEmpty) {
  for (const char* text : {"", " ", "N10", "(a)", "; a", "N10 (a) ; b"})
    EXPECT_TRUE(ParsedLine(text).tree().is_empty()) << text;
  for (const char* text : {"X1", "F1", "S1", "V1=1", "M1"}) EXPECT_FALSE(ParsedLine(text).tree().is_empty()) << text;
}

struct JumpCase {
  const char* line;
  int variable;
  Comparison comparison;
  double value;
  std::uint64_t target;
};

class Jumps : public testing::TestWithParam<JumpCase> {};

TEST_P(Jumps, AreReadWithConditionAndTarget) {
  const ParsedLine line(GetParam().line);
  const Jump* const jump = line.tree().jump;
  ASSERT_NE(jump, nullptr);
  EXPECT_TRUE(jump->condition_is_known());
  EXPECT_EQ(jump->variable, GetParam().variable);
  EXPECT_EQ(jump->comparison, GetParam().comparison);
  EXPECT_EQ(jump->value, GetParam().value);
  EXPECT_TRUE(jump->has_target);
  EXPECT_EQ(jump->target, GetParam().target);
  EXPECT_TRUE(line.tree().findings.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Conditions, Jumps,
    testing::Values(JumpCase{"IF V1=2 GOTO N30", 1, Comparison::Equal, 2, 30},
                    JumpCase{"IF V30<-2.5 GOTO N0", 30, Comparison::Less, -2.5, 0},
                    JumpCase{"IF V2 > .5 GOTO N007", 2, Comparison::Greater, 0.5, 7},
                    JumpCase{"IF V2<=1 GOTO N1", 2, Comparison::LessEqual, 1, 1},
                    JumpCase{"IF V2>=1 GOTO N1", 2, Comparison::GreaterEqual, 1, 1},
                    JumpCase{"IF V2<>1 GOTO N1", 2, Comparison::NotEqual, 1, 1},
                    JumpCase{"IF V2 < (a) > 1 GOTO N1", 2, Comparison::NotEqual, 1, 1},
                    JumpCase{"N5 if vgpl = 1 goto n30", Jump::kVgplVariable, Comparison::Equal, 1, 30},
                    JumpCase{"I F V G P L < = 1 0 G O T O N 3 0", Jump::kVgplVariable, Comparison::LessEqual, 10, 30}));

TEST(LineTree, JumpsKnowTheirPlaces) {
  const ParsedLine line(" IF V1=2 GOTO N30 ");
  EXPECT_EQ(line.tree().jump->if_span, (Span{1, 3}));
  EXPECT_EQ(line.tree().jump->target_span, (Span{14, 17}));
}

/// `ISO016 at 6-8`: codes and places of what the line shows by itself.
std::string findings_of(const LineTree& tree) {
  std::string text;
  for (const Finding& finding : tree.findings) {
    if (!text.empty()) text += ", ";
    text += fmt::format("{} at {}", dialect::definition(finding.id).code, support::text_of(finding.span));
  }
  return text;
}

class Findings : public testing::TestWithParam<TreeCase> {};

TEST_P(Findings, StandInTheOrderOfTheColumns) {
  const ParsedLine line(GetParam().line);
  EXPECT_EQ(findings_of(line.tree()), GetParam().expected) << GetParam().line;
}

INSTANTIATE_TEST_SUITE_P(Lines, Findings,
                         testing::Values(TreeCase{"G1 X1 Y2 F100", ""}, TreeCase{"G1 X1.2.3", "ISO006 at 4-9"},
                                         TreeCase{"G1000", "ISO007 at 0-5"}, TreeCase{"G1.5", "ISO007 at 0-4"},
                                         TreeCase{"M0", "ISO008 at 0-2"}, TreeCase{"M06 T13", "ISO009 at 4-7"},
                                         TreeCase{"M06 T030207", "ISO012 at 4-11"}, TreeCase{"G1 X", "ISO004 at 3-4"},
                                         TreeCase{"%#*12 X1", "ISO003 at 0-5"}, TreeCase{"5", "ISO005 at 0-1"},
                                         TreeCase{"G1 X1 X2", "ISO016 at 6-8"}, TreeCase{"F1 F2", "ISO065 at 3-5"},
                                         TreeCase{"S1 S2", "ISO046 at 3-5"}, TreeCase{"N1 N2", "ISO056 at 3-5"},
                                         TreeCase{"N-1", "ISO056 at 0-3"}, TreeCase{"G77", "E001 at 0-3"},
                                         TreeCase{"X1 (a", "ISO001 at 3-5"}, TreeCase{"X1 )", "ISO002 at 3-4"},
                                         TreeCase{"V31=1", "ISO059 at 0-3"}, TreeCase{"V1.5=1", "ISO057 at 0-4"},
                                         TreeCase{"V1", "ISO063 at 0-2"},
                                         TreeCase{"G1 X1.2.3 Y1,5", "ISO006 at 4-9, ISO006 at 11-14"}));

TEST(LineTree, ALineOfTooManyWordsIsCutAndSaysSo) {
  std::string text = "G1";
  for (std::size_t i = 0; i < kMaxWords + 10; ++i) text += " N";
  const ParsedLine line(text);
  EXPECT_EQ(line.tree().words.size(), kMaxWords);
  EXPECT_TRUE(line.tree().has(LineTree::kCut));
  EXPECT_EQ(line.tree().text.size(), text.size());
}

TEST(TreeStore, PacksLinesThatKeepTheirTrees) {
  const std::string text = "G1 X1 (a)\nIF V1=2 GOTO N3\nN3 X1 X2\n";
  TreeStore store;
  std::string parsed;
  std::string alone;
  for (const char *p = text.data(), *end = p + text.size(); p != end; ++p) {
    const char* const line_end = store.append_line(p, end);
    parsed += support::text_of(store.tree(store.size() - 1, p));
    alone += support::text_of(ParsedLine({p, line_end}).tree());
    p = line_end;
  }
  EXPECT_EQ(store.size(), 3u);
  EXPECT_EQ(parsed, alone);
}

/// U0 W0 are increments with one finding, which U0 alone has on the line above at the same place.
TEST(TreeStore, ALineLeavesTheFindingsOfOthers) {
  const std::string_view above = "     U0";
  const std::string_view below = "GOTO U0 W0";
  TreeStore store;
  store.append_line(above.data(), above.data() + above.size());
  store.append_line(below.data(), below.data() + below.size());
  EXPECT_EQ(support::text_of(store.tree(0, above.data())), support::text_of(ParsedLine(above).tree()));
  EXPECT_EQ(support::text_of(store.tree(1, below.data())), support::text_of(ParsedLine(below).tree()));
}

TEST(TreeStore, ReadsNothingOfWhatItHeldBeforeItWasCleared) {
  TreeStore store;
  for (const std::string_view before : {"T1 T2 T3 T4", "S1 S2 S3 S4", "P1=1 P2=2 P3=3"})
    for (const std::string_view text : {"M06 T", "G90 G92", "G01 X1 M101 P1", "V1 =", "IF V1 = 2 GOTO"}) {
      store.append_line(before.data(), before.data() + before.size());
      store.clear();
      store.append_line(text.data(), text.data() + text.size());
      EXPECT_EQ(support::text_of(store.tree(0, text.data())), support::text_of(ParsedLine(text).tree())) << before;
      store.clear();
    }
}

}  // namespace
}  // namespace isocnc::syntax
