#include "debugger/requests/request.h"

namespace isocnc::requests {

static constexpr dialect::Text kOther{"there is no such source", "non c'è un tale sorgente"};
static constexpr dialect::Text kTooLong{"the program is too long to be sent", "il programma è troppo lungo da inviare"};
static constexpr std::size_t kMaxLength = std::size_t{64} << 20;

namespace {

struct SourceBody {
  std::string_view content;
};

void to_json(Json& json, const SourceBody& body) { json = {{"content", body.content}, {"mimeType", "text/x-isocnc"}}; }

}  // namespace

/// The program as it is being run, even if its file has changed.
static SourceBody answer_source(Session& session, const dap::SourceArguments& arguments) {
  const std::string_view program = session.debuggee().text().text();
  if (!session.is_program(arguments.path)) throw RequestError(std::string(session.in_language(kOther)));
  if (program.size() > kMaxLength) throw RequestError(std::string(session.in_language(kTooLong)));
  return {program};
}

extern const DebugRequest source = on<&answer_source>("source");

}  // namespace isocnc::requests
