#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "lsp/rpc/long_text.h"

namespace isocnc::rpc {

/// The codes of JSON-RPC 2.0, and those that LSP adds.
enum class ErrorCode : int {
  ParseError = -32700,
  InvalidRequest = -32600,
  MethodNotFound = -32601,
  InvalidParams = -32602,
  InternalError = -32603,
  ServerNotInitialized = -32002,
  RequestFailed = -32803,
  ContentModified = -32801,
  RequestCancelled = -32800,
};

/// The answer to a request that cannot be fulfilled.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

/// A request or notification from the other side. A notification gets no answer.
struct Call {
  std::optional<Json> id;  ///< A number or a string; a notification has none.
  std::string method;
  ParsedMessage message;  ///< The whole message.

  bool is_notification() const { return !id; }
  /// The parameters: an object, an array or null.
  const Json& params() const;
};
using CallPointer = std::shared_ptr<const Call>;

/// The client's answer to one of our requests.
struct Response {
  Json id;
  Json result;  ///< Null if there is an error.
  Json error;   ///< Null if there is none.
};

/// A message that cannot be handled: the error to answer, and the id to answer with, null if that is unknown.
struct BadMessage {
  Json id;
  Error error;
};

using Message = std::variant<Call, Response, BadMessage>;

/// Reads the body of a frame.
Message read_message(std::string body);

/// Write the bodies of messages. `result` and `params` are JSON text; a request with empty `params` is sent without
/// them.
std::string result_message(const Json& id, std::string_view result);
std::string error_message(const Json& id, ErrorCode code, std::string_view message);
std::string notification_message(std::string_view method, std::string_view params);
std::string request_message(std::int64_t id, std::string_view method, std::string_view params);

/// Writes JSON as it is sent: without blanks, and with invalid UTF-8 replaced.
std::string write(const Json& json);

}  // namespace isocnc::rpc
