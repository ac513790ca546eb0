#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// One block, or, where the client asks for it, one of its instructions.
static Json answer_next(Session& session, const Json& arguments) {
  session.step(find_text(arguments, "granularity") == "instruction" ? session::Step::Instruction
                                                                    : session::Step::Block);
  return nullptr;
}

static Json next_capabilities() { return {{"supportsSteppingGranularity", true}}; }

extern const Request next = {.command = "next", .answer = answer_next, .capabilities = next_capabilities};

}  // namespace isocnc::debugger::requests
