#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

static constexpr dialect::Text kOther{"there is no such source", "non c'è un tale sorgente"};
static constexpr dialect::Text kTooLong{"the program is too long to be sent", "il programma è troppo lungo da inviare"};
static constexpr std::size_t kLongest = std::size_t{64} << 20;

/// The program as it is being run, whatever has become of its file.
static Json answer_source(Session& session, const Json& arguments) {
  const std::string_view program = session.debuggee().text().text();
  const Json source = arguments.value("source", Json::object());
  if (!session.is_program(find_text(source, "path").value_or("")))
    throw RequestError(std::string(session.in_language(kOther)));
  if (program.size() > kLongest) throw RequestError(std::string(session.in_language(kTooLong)));
  return {{"content", program}, {"mimeType", "text/x-isocnc"}};
}

extern const Request source = {.command = "source", .answer = answer_source};

}  // namespace isocnc::debugger::requests
