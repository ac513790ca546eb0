#include "debugger/adapter.h"

#include <utility>

#include <fmt/format.h>

#include "lsp/rpc/message.h"

namespace isocnc::debugger {

using dap::RequestError;
using dialect::Text;

static constexpr Text kNoLength{"a header has no Content-Length", "un'intestazione non riporta Content-Length"};
static constexpr Text kTooLong{"the message is longer than any that is taken",
                               "il messaggio è più lungo di quanto è ammesso"};
static constexpr Text kNoJson{"a message is no JSON object, or nested too deeply",
                              "un messaggio non è un oggetto JSON, o ha troppi livelli"};
static constexpr Text kNoRequest{"a message is no request", "un messaggio non è una richiesta"};
static constexpr Text kNotInitialized{"initialize comes first", "prima serve initialize"};
static constexpr Text kInitialized{"the adapter is initialized already", "l'adattatore è già inizializzato"};
static constexpr Text kUnknown{"there is no request {}", "non c'è nessuna richiesta {}"};
static constexpr Text kNotUnderstood{"the arguments of {} cannot be read: {}",
                                     "gli argomenti di {} non si possono leggere: {}"};

static constexpr Text kCondition{"an expression that is true before the block, such as T = 101001",
                                 "un'espressione che è vera prima del blocco, come T = 101001"};

Adapter::Adapter(rpc::Loop& loop, rpc::Send send, std::optional<dialect::Language> language)
    : loop_(loop),
      send_(std::move(send)),
      session_(
          loop, [this](std::string_view event, const Json& body) { emit(event, body); }, language) {
  for (const requests::DebugRequest* const request : requests::all_requests())
    requests_[request->command] = request->answer;
}

void Adapter::receive(rpc::MessageFrame frame) {
  using FramingError = rpc::MessageFrame::FramingError;
  if (has_ended_) return;
  if (frame.error != FramingError::None) return complain(frame.error == FramingError::NoLength ? kNoLength : kTooLong);
  const Json message = rpc::parse(frame.body);
  if (!message.is_object()) return complain(kNoJson);
  const auto type = message.find("type");
  if (type != message.end() && *type == "response") return;  // The adapter sends no requests.
  const auto seq = message.find("seq");
  const auto command = message.find("command");
  const bool is_request = type != message.end() && *type == "request" && seq != message.end() &&
                          seq->is_number_integer() && command != message.end() && command->is_string();
  if (!is_request) return complain(kNoRequest);
  answer(message);
}

void Adapter::answer(const Json& request) {
  const auto& command = request["command"].get_ref<const std::string&>();
  const Json arguments = request.value("arguments", Json::object());
  try {
    if (command == "disconnect") return disconnect(request);
    if (command == "initialize") return succeed(request, initialize(arguments));
    if (!is_initialized_) throw RequestError(std::string(session_.in_language(kNotInitialized)));
    const auto known = requests_.find(command);
    if (known == requests_.end()) throw RequestError(session_.in_language(kUnknown, command));
    succeed(request, known->second(session_, arguments));
    // The client can set its breakpoints now, as the lines of the program are known.
    if (command == "launch") emit("initialized", Json::object());
  } catch (const RequestError& error) {
    fail(request, error.in(session_.language()));
  } catch (const Json::exception& error) {
    fail(request, session_.in_language(kNotUnderstood, command, error.what()));
  }
}

/// The capabilities: the exception filters, and the part of each request.
Json Adapter::initialize(const Json& arguments) {
  if (is_initialized_) throw RequestError(std::string(session_.in_language(kInitialized)));
  session_.client() = arguments.get<dap::ClientProfile>();
  is_initialized_ = true;
  Json capabilities = {{"exceptionBreakpointFilters", exception_filters()}};
  for (const requests::DebugRequest* const request : requests::all_requests())
    if (request->capabilities != nullptr) capabilities.update(request->capabilities());
  return capabilities;
}

/// All filters, of which the default ones are turned on.
Json Adapter::exception_filters() {
  Json filters = Json::array();
  for (std::size_t i = 0; i < breakpoints::kExceptionFilterCount; ++i) {
    const auto filter = static_cast<breakpoints::ExceptionFilter>(i);
    const breakpoints::ExceptionFilterDef& def = breakpoints::definition(filter);
    filters.push_back({{"filter", def.name},
                       {"label", session_.in_language(def.label)},
                       {"description", session_.in_language(def.description)},
                       {"default", def.is_default},
                       {"supportsCondition", def.takes_condition}});
    if (def.takes_condition) filters.back()["conditionDescription"] = session_.in_language(kCondition);
    if (def.is_default) session_.exception_filters().turn_on(filter);
  }
  return filters;
}

/// The debuggee ends with its debugger.
void Adapter::disconnect(const Json& request) {
  succeed(request, nullptr);
  exit_status_ = 0;
  end();
}

void Adapter::end() {
  has_ended_ = true;
  session_.abandon();
  loop_.stop();
}

void Adapter::succeed(const Json& request, const Json& body) {
  Json message = {
      {"type", "response"}, {"request_seq", request["seq"]}, {"success", true}, {"command", request["command"]}};
  if (!body.is_null()) message["body"] = body;
  send(std::move(message));
}

void Adapter::fail(const Json& request, const std::string& message) {
  static constexpr int kRefused = 1;
  send({{"type", "response"},
        {"request_seq", request["seq"]},
        {"success", false},
        {"command", request["command"]},
        {"message", message},
        {"body", {{"error", {{"id", kRefused}, {"format", message}, {"showUser", true}}}}}});
}

void Adapter::emit(std::string_view event, const Json& body) {
  if (has_ended_) return;
  send({{"type", "event"}, {"event", event}, {"body", body}});
}

/// Reports a message that is not a request, and so has no response.
void Adapter::complain(const Text& what) {
  emit("output", {{"category", "stderr"}, {"output", fmt::format("isodap: {}\n", session_.in_language(what))}});
}

void Adapter::send(Json message) {
  message["seq"] = ++seq_;
  send_(rpc::write(message));
}

}  // namespace isocnc::debugger
