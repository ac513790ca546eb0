#include "debug_client.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "debugger/adapter.h"

namespace isocnc::debugger {

DebugClient::DebugClient(std::optional<dialect::Language> commanded)
    : MessageClient([commanded](rpc::Loop& loop, rpc::Send send) {
        return std::make_unique<Adapter>(loop, std::move(send), commanded);
      }) {}

DebugClient::~DebugClient() {
  if (is_speaking()) hang_up();  // Before the program's folder goes.
}

int DebugClient::end(bool by_disconnect) {
  if (!by_disconnect) return hang_up();
  respond("disconnect");
  return wait_for_end();
}

std::filesystem::path DebugClient::write(const std::string& name, const std::string& text) const {
  return folder_.write(name, text);
}

void DebugClient::launch(const std::string& text, Json arguments) {
  program_ = write("program.iso", text);
  arguments["program"] = program_.string();
  request("initialize", {{"adapterID", "isocnc"}, {"supportsInvalidatedEvent", true}});
  request("launch", arguments);
  event("initialized");
}

void DebugClient::stop_at_start(const std::string& text, Json arguments) {
  arguments["stopOnEntry"] = true;
  launch(text, std::move(arguments));
  run("configurationDone");
}

std::int64_t DebugClient::ask(const std::string& command, const Json& arguments) {
  const std::int64_t seq = next_seq_++;
  send_raw(Json{{"seq", seq}, {"type", "request"}, {"command", command}, {"arguments", arguments}}.dump());
  return seq;
}

Json DebugClient::respond(const std::string& command, const Json& arguments) {
  const std::int64_t seq = ask(command, arguments);
  return wait_for(
      [&](const Json& message) { return message.at("type") == "response" && message.at("request_seq") == seq; });
}

Json DebugClient::request(const std::string& command, const Json& arguments) {
  const Json response = respond(command, arguments);
  if (!response.at("success").get<bool>()) throw std::runtime_error(response.dump());
  return response.value("body", Json::object());
}

std::string DebugClient::refusal(const std::string& command, const Json& arguments) {
  return respond(command, arguments).value("message", "");
}

static bool is_event(const Json& message, const std::string& name) {
  return message.at("type") == "event" && message.at("event") == name;
}

Json DebugClient::event(const std::string& name) {
  return wait_for([&](const Json& message) { return is_event(message, name); }).value("body", Json::object());
}

bool DebugClient::has_event(const std::string& name) {
  return has([&](const Json& message) { return is_event(message, name); });
}

Json DebugClient::run(const std::string& command, const Json& arguments) {
  request(command, arguments);
  return event("stopped");
}

Json DebugClient::set_breakpoints(const std::vector<Json>& breakpoints) {
  return request("setBreakpoints", {{"source", {{"path", program_.string()}}}, {"breakpoints", breakpoints}})
      .at("breakpoints");
}

Json DebugClient::set_lines(const std::vector<int>& lines) {
  std::vector<Json> breakpoints;
  for (const int line : lines) breakpoints.push_back({{"line", line}});
  return set_breakpoints(breakpoints);
}

int DebugClient::line() { return request("stackTrace", {{"threadId", 1}}).at("stackFrames").at(0).at("line"); }

std::string DebugClient::evaluate(const std::string& expression, const std::string& context) {
  return request("evaluate", {{"expression", expression}, {"context", context}}).at("result");
}

Json DebugClient::variables(const std::string& scope) {
  for (const Json& each : Json(request("scopes", {{"frameId", 1}}).at("scopes")))
    if (each.at("name") == scope)
      return request("variables", {{"variablesReference", each.at("variablesReference")}}).at("variables");
  throw std::runtime_error("no scope " + scope);
}

std::string DebugClient::variable(const std::string& scope, const std::string& name) {
  for (const Json& each : variables(scope))
    if (each.at("name") == name) return each.at("value");
  return "(none)";
}

std::vector<std::string> DebugClient::below(const std::string& scope, const std::string& name) {
  std::vector<std::string> held;
  for (const Json& each : variables(scope)) {
    if (each.at("name") != name) continue;
    const Json reference = {{"variablesReference", each.at("variablesReference")}};
    for (const Json& variable : Json(request("variables", reference).at("variables")))
      held.push_back(variable.at("name").get<std::string>() + "=" + variable.at("value").get<std::string>());
  }
  return held;
}

std::string DebugClient::state() {
  std::string all = std::to_string(line());
  for (const Json& scope : Json(request("scopes", {{"frameId", 1}}).at("scopes"))) {
    const Json variables =
        request("variables", {{"variablesReference", scope.at("variablesReference")}}).at("variables");
    for (const Json& each : variables)
      all += " " + each.at("name").get<std::string>() + "=" + each.at("value").get<std::string>();
    all += "\n";
  }
  return all;
}

}  // namespace isocnc::debugger
