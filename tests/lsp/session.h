#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lsp/background/verification.h"
#include "lsp/rpc/json.h"
#include "tests/support/message_client.h"

namespace isocnc::lsp {

using rpc::Json;

/// The program of most tests.
inline constexpr const char* kUri = "file:///nowhere/part.iso";

inline Json document_params(const char* uri = kUri) { return {{"textDocument", {{"uri", uri}}}}; }

/// Options with which no program is verified.
background::VerificationOptions without_verification();

/// A test client of a Server. Unless a test wants verification, there is none.
class Session : public support::MessageClient {
 public:
  explicit Session(background::VerificationOptions verification = without_verification());

  /// Sends `initialize` and `initialized`. Returns the result of `initialize`.
  Json start(const Json& capabilities = Json::object(), const Json& more = Json::object());

  /// Sends a request and waits. Returns the whole response.
  Json respond(const std::string& method, const Json& params = Json::object());
  /// Sends a request that has to succeed. Returns its result.
  Json request(const std::string& method, const Json& params = Json::object());
  /// Sends a request without waiting. Returns its id.
  std::int64_t ask(const std::string& method, const Json& params = Json::object());
  Json response_to(const Json& id);
  /// Whether a received answer has not been read by the test.
  bool has_response();
  void notify(const std::string& method, const Json& params = Json::object());

  using MessageClient::wait_for;
  Json wait_for(const std::string& method);

  void open(const std::string& uri, const std::string& text, int version = 1);
  void close(const std::string& uri);
  /// Sends changes, each applied to the text that results from the one before.
  void edit(const std::string& uri, int version, const std::vector<Json>& changes);
  /// Waits for the diagnostics published for this version.
  Json diagnostics(const std::string& uri, int version);

  /// Ends the server. Returns its exit status.
  int end(bool by_exit = true);

 private:
  std::int64_t next_id_ = 1;
};

/// A step of a `didChange`.
Json change(int line, int column, int end_line, int end_column, const std::string& text);

/// The range from the start of a line to that of another.
inline rpc::Json lines(int first, int end) {
  return {{"start", {{"line", first}, {"character", 0}}}, {"end", {{"line", end}, {"character", 0}}}};
}

}  // namespace isocnc::lsp
