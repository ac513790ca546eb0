#include "lsp/outbox.h"

#include <utility>

namespace isocnc::lsp {

Outbox::Outbox(rpc::Send send) : send_(std::move(send)) {}

void Outbox::send(std::string body) { send_(std::move(body)); }

void Outbox::reply(const rpc::Call& call, const rpc::Json& result) {
  if (call.id) send_(rpc::result_message(*call.id, rpc::write(result)));
}

void Outbox::refuse(const rpc::Call& call, rpc::ErrorCode code, const std::string& message) {
  if (call.id) send_(rpc::error_message(*call.id, code, message));
}

void Outbox::notify(std::string_view method, const std::string& params) {
  send_(rpc::notification_message(method, params));
}

void Outbox::request(std::string_view method, const rpc::Json& params) {
  send_(rpc::request_message(next_request_++, method, params.is_null() ? std::string() : rpc::write(params)));
}

void Outbox::log(const std::string& message) {
  notify("window/logMessage", rpc::write({{"type", 1}, {"message", message}}));
}

}  // namespace isocnc::lsp
