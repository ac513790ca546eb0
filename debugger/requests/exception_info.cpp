#include "debugger/requests/request.h"

namespace isocnc::requests {

static constexpr dialect::Text kNone{"nothing but breakpoints has stopped the program",
                                     "a fermare il programma non è stata un'eccezione"};

namespace {

struct ExceptionBody {
  const breakpoints::Exception& exception;
};

void to_json(Json& json, const ExceptionBody& body) {
  const breakpoints::Exception& exception = body.exception;
  const bool is_error = exception.filter == breakpoints::ExceptionFilter::Errors;
  json = {{"exceptionId", exception.code},
          {"description", exception.message},
          {"breakMode", is_error ? "unhandled" : "always"},
          {"details", {{"message", exception.message}, {"typeName", exception.code}}}};
  if (!exception.explanation.empty()) json["details"]["stackTrace"] = exception.explanation;
}

}  // namespace

/// Why the control would stop: code, message, and the full explanation of the code.
static ExceptionBody answer_exception_info(Session& session) {
  session.stopped_debuggee();
  const auto& exception = session.exception();
  if (!exception) throw RequestError(std::string(session.in_language(kNone)));
  return {*exception};
}

static Json exception_info_capabilities() { return {{"supportsExceptionInfoRequest", true}}; }

extern const DebugRequest exception_info = on<&answer_exception_info>("exceptionInfo", exception_info_capabilities);

}  // namespace isocnc::requests
