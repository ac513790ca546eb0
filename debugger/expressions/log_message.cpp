#include "debugger/expressions/log_message.h"

#include <utility>

#include "interpreter/dialect/format.h"

namespace isocnc::expressions {

static constexpr dialect::Text kNoClosingBrace{"{{ has no }} after it", "a {{ non segue una }}"};

static bool begins_with_plain_brace(std::string_view text) { return text.starts_with("{{") || text.starts_with("}}"); }

std::variant<LogMessage, ExpressionProblem> LogMessage::compile(std::string_view text, const ValueFormat& format,
                                                                dialect::Language language) {
  LogMessage result;
  std::string plain;
  while (!text.empty()) {
    if (begins_with_plain_brace(text) || text.front() != '{') {
      plain += text.front();
      text.remove_prefix(begins_with_plain_brace(text) ? 2 : 1);
      continue;
    }
    const std::size_t close = text.find('}');
    if (close == std::string_view::npos) return ExpressionProblem{dialect::format(kNoClosingBrace, language)};
    auto compiled = compile_formatted(text.substr(1, close - 1), format, language);
    if (const auto* const problem = std::get_if<ExpressionProblem>(&compiled)) return *problem;
    result.pieces_.push_back({std::exchange(plain, {}), std::get<Expression::Formatted>(std::move(compiled))});
    text.remove_prefix(close + 1);
  }
  if (!plain.empty()) result.pieces_.push_back({std::move(plain), std::nullopt});
  return result;
}

std::string LogMessage::at(const Moment& moment) const {
  std::string text;
  for (const MessagePart& piece : pieces_) {
    text += piece.text;
    if (piece.value) text += show_value(piece.value->expression.at(moment), piece.value->format);
  }
  return text;
}

}  // namespace isocnc::expressions
