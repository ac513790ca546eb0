#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "debugger/expressions/quantities.h"

namespace isocnc::expressions {

/// Why a text is not an expression, for people: `column 5: there is nothing called W`. Columns count from 1, in code
/// points.
struct ExpressionProblem {
  std::string message;
};

/// How a value is to be shown: `V3,x` in hexadecimal, `Z,2` with two decimals.
struct ValueFormat {
  static constexpr int kMaxDecimals = 12;

  bool is_hexadecimal = false;
  int decimals = 4;          ///< Maximum number of decimals.
  bool keeps_zeros = false;  ///< Shows zeros at the end of the decimals, too.
};

/// A value as people read it: `12.5`, `0x1F`, `-` where it is not known.
std::string show_value(double value, const ValueFormat& format = {});

/// A formula over the quantities of a run, which is compiled once and evaluated at any moment: comparisons, `&&`, `||`,
/// `!`,
/// `+ - * /`, parentheses. True is 1, false is 0, and 0 counts as false. No comparison with an unknown value (NaN)
/// holds, and an unknown value counts as false.
class Expression {
 public:
  static std::variant<Expression, ExpressionProblem> compile(std::string_view text, dialect::Language language);
  /// An expression with a format after a comma.
  struct Formatted;

  double at(const Moment& moment) const;
  bool holds_at(const Moment& moment) const;
  /// The quantity whose name is the whole expression; null for any other expression.
  const Quantity* sole_quantity() const;
  /// Whether it names no quantity.
  bool is_constant() const;
  bool reads_surroundings() const;
  bool reads_depth() const;

 private:
  friend class ExpressionCompiler;

  enum class Operation : std::uint8_t {
    Number,
    Read,
    Negate,
    Not,
    Add,
    Subtract,
    Multiply,
    Divide,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    And,
    Or,
  };
  /// An instruction of a stack machine.
  struct StackInstruction {
    Operation operation = Operation::Number;
    double number = 0;
    const Quantity* quantity = nullptr;
  };

  static double apply(Operation operation, double left, double right);

  std::vector<StackInstruction> code_;
};

struct Expression::Formatted {
  Expression expression;
  ValueFormat format;
};

/// Compiles an expression, whose format may follow after a comma. `format` is that of a text without one.
std::variant<Expression::Formatted, ExpressionProblem> compile_formatted(std::string_view text,
                                                                         const ValueFormat& format,
                                                                         dialect::Language language);

}  // namespace isocnc::expressions
