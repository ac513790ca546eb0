#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "debugger/expressions/expression.h"

namespace isocnc::session {
namespace {

struct Formula {
  std::string text;
  std::string value;  ///< As it is shown.
};

class Formulas : public testing::TestWithParam<Formula> {};

TEST_P(Formulas, HaveTheirValue) {
  execution::State state;
  state.position.tip = {10, -2.5, 0.125};
  state.spindle_speed = 18000;
  running::Registers registers{};
  registers[3] = 7;
  const expressions::Moment moment{.state = state, .registers = registers, .vgpl = 2, .line = 41};
  const auto compiled = expressions::compile_formatted(GetParam().text, {}, dialect::Language::English);
  ASSERT_TRUE(std::holds_alternative<expressions::Expression::Formatted>(compiled))
      << std::get<expressions::ExpressionProblem>(compiled).message;
  const auto& formatted = std::get<expressions::Expression::Formatted>(compiled);
  EXPECT_EQ(expressions::show_value(formatted.expression.at(moment), formatted.format), GetParam().value);
}

INSTANTIATE_TEST_SUITE_P(
    All, Formulas,
    testing::Values(Formula{"X", "10"}, Formula{"x + y", "7.5"}, Formula{"-Y", "2.5"}, Formula{"2 + 3 * 4", "14"},
                    Formula{"(2 + 3) * 4", "20"}, Formula{"2 - 3 - 4", "-5"}, Formula{"8 / 4 / 2", "1"},
                    Formula{"Z < 0 && S > 0", "0"}, Formula{"Z > 0 && S > 0", "1"}, Formula{"1 || 0 && 0", "1"},
                    Formula{"!(X = 10)", "0"}, Formula{"X <> 10", "0"}, Formula{"X != 9", "1"},
                    Formula{"V3 >= 7 == 1", "1"}, Formula{"VGPL * V3", "14"}, Formula{"LINE", "42"},
                    Formula{"MOTION", "-"}, Formula{"MOTION == 1", "0"}, Formula{"MOTION != 1", "0"},
                    Formula{"UNITS", "71"}, Formula{"Z,1", "0.1"}, Formula{"X,3", "10.000"}, Formula{"S,x", "0x4650"},
                    Formula{"-V3,x", "-0x7"}, Formula{"1/0", "∞"}, Formula{"0/0", "-"}, Formula{".5", "0.5"},
                    Formula{"--X", "10"}, Formula{"!!X", "1"}));

class Mistakes : public testing::TestWithParam<Formula> {};

TEST_P(Mistakes, AreReportedWithTheirColumn) {
  const auto compiled = expressions::compile_formatted(GetParam().text, {}, dialect::Language::English);
  ASSERT_TRUE(std::holds_alternative<expressions::ExpressionProblem>(compiled));
  EXPECT_EQ(std::get<expressions::ExpressionProblem>(compiled).message, GetParam().value);
}

INSTANTIATE_TEST_SUITE_P(
    All, Mistakes,
    testing::Values(
        Formula{"", "column 1: a value is missing here"}, Formula{"X +", "column 4: a value is missing here"},
        Formula{"V31", "column 1: there is nothing called V31"}, Formula{"V0", "column 1: there is nothing called V0"},
        Formula{"X $ 2", "column 3: $ has no meaning here"}, Formula{"è + X", "column 1: è has no meaning here"},
        Formula{"X 2", "column 3: 2 has no meaning here"}, Formula{"1.2.3", "column 1: 1.2.3 has no meaning here"},
        Formula{"(X", "column 1: this parenthesis is not closed"}, Formula{"X)", "column 2: ) has no meaning here"},
        Formula{std::string(100, '(') + "1" + std::string(100, ')'), "column 66: this nests too deeply"},
        Formula{"X,y",
                "column 3: a format is x (hexadecimal) or a number of decimals, 0 to "
                "12, not y"}));

TEST(Expressions, LongOnesNeedNoMoreThanTheirLength) {
  std::string sum = "1";
  for (int i = 0; i < 10000; ++i) sum += "+1";
  const auto compiled = expressions::Expression::compile(sum, dialect::Language::English);
  const execution::State state;
  const running::Registers registers{};
  EXPECT_EQ(std::get<expressions::Expression>(compiled).at({.state = state, .registers = registers}), 10001);
}

}  // namespace
}  // namespace isocnc::session
