#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/rpc/json.h"
#include "tests/support/message_client.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::debugger {

using rpc::Json;

/// A client of an Adapter. The programs that it debugs are files in a folder that goes when it does.
class DebugClient : public support::MessageClient {
 public:
  explicit DebugClient(std::optional<dialect::Language> commanded = dialect::Language::English);
  ~DebugClient();

  std::filesystem::path write(const std::string& name, const std::string& text) const;

  /// Sends `initialize` and `launch` of a program with this text, and waits until breakpoints can be set.
  void launch(const std::string& text, Json arguments = Json::object());
  /// As launch(), and then stands before the first block.
  void stop_at_start(const std::string& text, Json arguments = Json::object());

  /// The whole response.
  Json respond(const std::string& command, const Json& arguments = Json::object());
  /// The body of the response of a request that succeeds.
  Json request(const std::string& command, const Json& arguments = Json::object());
  /// The message of one that does not; empty where it does.
  std::string refusal(const std::string& command, const Json& arguments = Json::object());
  std::int64_t ask(const std::string& command, const Json& arguments = Json::object());

  /// The body of the next event with this name.
  Json event(const std::string& name);
  bool has_event(const std::string& name);
  /// Sends a request that makes the program run, and waits until it stops: the event.
  Json run(const std::string& command, const Json& arguments = Json::object());

  /// Breakpoints in lines, from 1: those of the response.
  Json set_breakpoints(const std::vector<Json>& breakpoints);
  Json set_lines(const std::vector<int>& lines);

  int line();  ///< Of the top frame.
  std::string evaluate(const std::string& expression, const std::string& context = "watch");
  /// What a scope, or a variable, calls by this name.
  std::string variable(const std::string& scope, const std::string& name);
  Json variables(const std::string& scope);
  /// What a variable of a scope holds, as `NAME=VALUE`.
  std::vector<std::string> below(const std::string& scope, const std::string& name);
  /// All that is shown of the machine: position, modes, registers, time.
  std::string state();

  const std::filesystem::path& program() const { return program_; }
  /// Ends the adapter: its exit status.
  int end(bool by_disconnect = true);

 private:
  support::TemporaryFolder folder_;
  std::filesystem::path program_;
  std::int64_t next_seq_ = 1;
};

}  // namespace isocnc::debugger
