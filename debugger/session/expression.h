#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "debugger/session/quantities.h"

namespace isocnc::debugger::session {

/// Why a text is no expression, for people: `column 5: there is nothing called W`. Columns count from 1, in code
/// points.
struct ExpressionProblem {
  std::string message;
};

/// How a value is to be shown: `V3,x` in hexadecimal, `Z,2` with two decimals.
struct ValueFormat {
  static constexpr int kMostDecimals = 12;

  bool is_hexadecimal = false;
  int decimals = 4;  ///< At most; trailing zeros are left out, unless they are asked for.
  bool keeps_zeros = false;
};

/// A value as people read it: `12.5`, `0x1F`, `-` where it is not known.
std::string show_value(double value, const ValueFormat& format = {});

/// A formula over the quantities of a run, compiled once and then asked at any moment: comparisons, `&&`, `||`, `!`,
/// `+ - * /`, parentheses. What is true is 1, what is false 0, and 0 counts as false. Nothing compares with what is not
/// known (NaN), and that counts as false, too.
class Expression {
 public:
  static std::variant<Expression, ExpressionProblem> compile(std::string_view text, dialect::Language language);
  /// The same, with what the text says behind a comma of how its value is to be shown.
  struct Formatted;

  double at(const Moment& moment) const;
  bool holds_at(const Moment& moment) const;
  /// The quantity that is all of it; null where it is more than a name.
  const Quantity* sole_quantity() const;

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
  /// In the order of a stack machine.
  struct Instruction {
    Operation operation = Operation::Number;
    double number = 0;
    const Quantity* quantity = nullptr;
  };

  static double apply(Operation operation, double left, double right);

  std::vector<Instruction> code_;
};

struct Expression::Formatted {
  Expression expression;
  ValueFormat format;
};

/// An expression with a format behind a comma.
std::variant<Expression::Formatted, ExpressionProblem> compile_formatted(std::string_view text,
                                                                         const ValueFormat& format,
                                                                         dialect::Language language);

}  // namespace isocnc::debugger::session
