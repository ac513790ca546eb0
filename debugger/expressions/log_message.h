#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "debugger/expressions/expression.h"

namespace isocnc::expressions {

/// A text with expressions in braces: `Z is {Z,2}`. `{{` and `}}` are braces.
class LogMessage {
 public:
  static std::variant<LogMessage, ExpressionProblem> compile(std::string_view text, const ValueFormat& format,
                                                             dialect::Language language);
  std::string at(const Moment& moment) const;

 private:
  struct MessagePart {
    std::string text;
    std::optional<Expression::Formatted> value;  ///< Shown after the text.
  };
  std::vector<MessagePart> pieces_;
};

}  // namespace isocnc::expressions
