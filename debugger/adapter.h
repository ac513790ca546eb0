#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "debugger/requests/request.h"
#include "lsp/rpc/serve.h"

namespace isocnc::debugger {

using rpc::Json;

/// The debug adapter: reads messages, lets requests answer them, and sends responses and events. It lives on the
/// loop's thread, as its Session does.
class Adapter final : public rpc::Peer {
 public:
  /// `language` overrules those of configurations and of the client.
  Adapter(rpc::Loop& loop, rpc::Send send, std::optional<dialect::Language> language = {});
  Adapter(const Adapter&) = delete;
  Adapter& operator=(const Adapter&) = delete;

  // All on the loop's thread.
  void receive(rpc::MessageFrame frame) override;
  void end() override;

  /// 0 after `disconnect`, 1 after any other end.
  int exit_status() const override { return exit_status_; }

 private:
  void answer(const Json& request);
  Json initialize(const Json& arguments);
  Json exception_filters();
  void disconnect(const Json& request);
  void succeed(const Json& request, const Json& body);
  void fail(const Json& request, const std::string& message);
  void emit(std::string_view event, const Json& body);
  void complain(const dialect::Text& what);
  void send(Json message);

  rpc::Loop& loop_;
  const rpc::Send send_;
  session::Session session_;
  std::unordered_map<std::string_view, Json (*)(session::Session&, const Json&)> requests_;
  std::int64_t seq_ = 0;
  bool is_initialized_ = false;
  bool has_ended_ = false;
  int exit_status_ = 1;
};

}  // namespace isocnc::debugger
