#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lsp/rpc/json.h"
#include "tests/support/message_client.h"

namespace isocnc::lsp {

using rpc::Json;

/// A client of a Server.
class Session : public support::MessageClient {
 public:
  Session();

  /// Sends `initialize` and `initialized`; the result of the former.
  Json start(const Json& capabilities = Json::object(), const Json& more = Json::object());

  /// Waits for the answer: the whole response.
  Json respond(const std::string& method, const Json& params = Json::object());
  /// The result of a request that succeeds.
  Json request(const std::string& method, const Json& params = Json::object());
  /// Sends a request and does not wait; its id.
  std::int64_t ask(const std::string& method, const Json& params = Json::object());
  Json response_to(const Json& id);
  /// Whether an answer has come that nobody has waited for.
  bool has_response();
  void notify(const std::string& method, const Json& params = Json::object());

  using MessageClient::wait_for;
  Json wait_for(const std::string& method);

  void open(const std::string& uri, const std::string& text, int version = 1);
  void close(const std::string& uri);
  /// Makes changes, each in the text that the one before has left.
  void edit(const std::string& uri, int version, const std::vector<Json>& changes);
  /// The diagnostics published last of this version.
  Json diagnostics(const std::string& uri, int version);

  /// Ends the server: its exit status.
  int end(bool by_exit = true);

 private:
  std::int64_t next_id_ = 1;
};

/// A step of a `didChange`.
Json change(int line, int column, int end_line, int end_column, const std::string& text);

}  // namespace isocnc::lsp
