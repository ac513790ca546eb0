#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lsp/rpc/json.h"
#include "lsp/rpc/message.h"
#include "lsp/rpc/serve.h"

namespace isocnc::lsp {

/// The messages to the client. Used on the loop's thread only.
class Outbox {
 public:
  explicit Outbox(rpc::Send send);

  /// Answers a request; a notification gets no answer.
  void reply(const rpc::Call& call, const rpc::Json& result);
  void refuse(const rpc::Call& call, rpc::ErrorCode code, const std::string& message);
  void notify(std::string_view method, const std::string& params);
  /// Without parameters if `params` is null.
  void request(std::string_view method, const rpc::Json& params);
  /// Shows an error to the user.
  void log(const std::string& message);
  /// The body of a whole message.
  void send(std::string body);

 private:
  const rpc::Send send_;
  std::int64_t next_request_ = 1;
};

}  // namespace isocnc::lsp
