#include "interpreter/running/error_message.h"

namespace isocnc::running {

std::string error_message(const RunResult& result, dialect::Language language) {
  const syntax::Span span = result.error.span;
  const std::string_view marked = result.line_text.substr(span.begin, span.end - span.begin);
  return dialect::message(result.error.id, language, marked, result.error.values);
}

}  // namespace isocnc::running
