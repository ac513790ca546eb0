#include "lsp/rpc/message.h"

#include <fmt/format.h>

namespace isocnc::rpc {

const Json& Call::params() const {
  static const Json kNone;
  const auto found = message.json.find("params");
  return found == message.json.end() ? kNone : *found;
}

static bool is_id(const Json& id) { return id.is_number() || id.is_string(); }

static Message bad(const Json& id, ErrorCode code, const char* what) { return BadMessage{id, Error(code, what)}; }

Message read_message(std::string body) {
  ParsedMessage message = ParsedMessage::parse(std::move(body));
  const Json& json = message.json;
  if (json.is_discarded()) return bad(nullptr, ErrorCode::ParseError, "the message is no JSON, or nested too deeply");
  if (!json.is_object()) return bad(nullptr, ErrorCode::InvalidRequest, "the message is no object");
  const auto id = json.find("id");
  const bool has_id = id != json.end();
  const Json known_id = has_id && is_id(*id) ? *id : Json();
  const auto method = json.find("method");
  if (method == json.end()) {
    const bool has_result = json.contains("result");
    const bool has_error = json.contains("error") && json["error"].is_object();
    if (!has_id || (!has_result && !has_error))
      return bad(known_id, ErrorCode::InvalidRequest, "the message has neither a method nor a result");
    return Response{*id, has_error ? Json() : json["result"], has_error ? json["error"] : Json()};
  }
  if (!method->is_string()) return bad(known_id, ErrorCode::InvalidRequest, "the method is no string");
  if (has_id && known_id.is_null()) return bad(nullptr, ErrorCode::InvalidRequest, "the id is no number or string");
  const auto params = json.find("params");
  if (params != json.end() && !params->is_structured() && !params->is_null())
    return bad(known_id, ErrorCode::InvalidRequest, "the params are no object or array");
  std::string name = *method;
  return Call{has_id ? std::optional(known_id) : std::nullopt, std::move(name), std::move(message)};
}

std::string write(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string result_message(const Json& id, std::string_view result) {
  return fmt::format(R"({{"jsonrpc":"2.0","id":{},"result":{}}})", write(id), result);
}

std::string error_message(const Json& id, ErrorCode code, std::string_view message) {
  return fmt::format(R"({{"jsonrpc":"2.0","id":{},"error":{{"code":{},"message":{}}}}})", write(id),
                     static_cast<int>(code), write(Json(std::string(message))));
}

std::string notification_message(std::string_view method, std::string_view params) {
  return fmt::format(R"({{"jsonrpc":"2.0","method":"{}","params":{}}})", method, params);
}

std::string request_message(std::int64_t id, std::string_view method, std::string_view params) {
  if (params.empty()) return fmt::format(R"({{"jsonrpc":"2.0","id":{},"method":"{}"}})", id, method);
  return fmt::format(R"({{"jsonrpc":"2.0","id":{},"method":"{}","params":{}}})", id, method, params);
}

}  // namespace isocnc::rpc
