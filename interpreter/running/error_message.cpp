#include "interpreter/running/error_message.h"

namespace isocnc::running {

std::string error_message(const RunResult& result, dialect::Language language) {
  return syntax::message(result.error, result.line_text, language);
}

}  // namespace isocnc::running
