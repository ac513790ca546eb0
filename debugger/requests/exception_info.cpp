#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

static constexpr dialect::Text kNone{"nothing but breakpoints has stopped the program",
                                     "a fermare il programma non è stata un'eccezione"};

/// Why the control would stop: code, message, and all that is known of the code.
static Json answer_exception_info(Session& session, const Json&) {
  session.stopped_debuggee();
  const auto& exception = session.exception();
  if (!exception) throw RequestError(std::string(session.in_language(kNone)));
  const bool is_error = exception->filter == session::ExceptionFilter::Errors;
  Json details = {{"message", exception->message}, {"typeName", exception->code}};
  if (!exception->explanation.empty()) details["stackTrace"] = exception->explanation;
  return {{"exceptionId", exception->code},
          {"description", exception->message},
          {"breakMode", is_error ? "unhandled" : "always"},
          {"details", details}};
}

static Json exception_info_capabilities() { return {{"supportsExceptionInfoRequest", true}}; }

extern const Request exception_info = {
    .command = "exceptionInfo", .answer = answer_exception_info, .capabilities = exception_info_capabilities};

}  // namespace isocnc::debugger::requests
