#include "session.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "lsp/server.h"

namespace isocnc::lsp {

background::VerificationOptions without_verification() {
  background::VerificationOptions options;
  options.run = [](std::string_view, const selection::ProgramSettings&, const verification::Scene*,
                   const selection::VerifyOptions&) { return verification::VerifiedRun(); };
  return options;
}

Session::Session(background::VerificationOptions verification)
    : MessageClient([&](rpc::Loop& loop, rpc::Send send) {
        return std::make_unique<Server>(loop, std::move(send), std::nullopt, std::move(verification));
      }) {}

int Session::end(bool by_exit) {
  if (!by_exit) return hang_up();
  notify("exit");
  return wait_for_end();
}

Json Session::start(const Json& capabilities, const Json& more) {
  Json params = {{"processId", nullptr}, {"rootUri", nullptr}, {"capabilities", capabilities}};
  params.update(more);
  Json result = request("initialize", params);
  notify("initialized");
  return result;
}

std::int64_t Session::ask(const std::string& method, const Json& params) {
  const std::int64_t id = next_id_++;
  send_raw(Json{{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", params}}.dump());
  return id;
}

void Session::notify(const std::string& method, const Json& params) {
  send_raw(Json{{"jsonrpc", "2.0"}, {"method", method}, {"params", params}}.dump());
}

Json Session::response_to(const Json& id) {
  return wait_for([&](const Json& message) { return !message.contains("method") && message.at("id") == id; });
}

bool Session::has_response() {
  return has([](const Json& message) { return !message.contains("method"); });
}

Json Session::respond(const std::string& method, const Json& params) { return response_to(ask(method, params)); }

Json Session::request(const std::string& method, const Json& params) {
  const Json response = respond(method, params);
  if (!response.contains("result")) throw std::runtime_error(method + ": " + response.dump());
  return response["result"];
}

Json Session::wait_for(const std::string& method) {
  return wait_for([&](const Json& message) { return message.value("method", "") == method; });
}

void Session::open(const std::string& uri, const std::string& text, int version) {
  notify("textDocument/didOpen",
         {{"textDocument", {{"uri", uri}, {"languageId", "isocnc"}, {"version", version}, {"text", text}}}});
}

void Session::close(const std::string& uri) { notify("textDocument/didClose", {{"textDocument", {{"uri", uri}}}}); }

void Session::edit(const std::string& uri, int version, const std::vector<Json>& changes) {
  notify("textDocument/didChange",
         {{"textDocument", {{"uri", uri}, {"version", version}}}, {"contentChanges", changes}});
}

Json Session::diagnostics(const std::string& uri, int version) {
  const Json published = wait_for([&](const Json& message) {
    return message.value("method", "") == "textDocument/publishDiagnostics" && message["params"]["uri"] == uri &&
           message["params"].value("version", -1) == version;
  });
  return published["params"]["diagnostics"];
}

Json change(int line, int column, int end_line, int end_column, const std::string& text) {
  return {
      {"range",
       {{"start", {{"line", line}, {"character", column}}}, {"end", {{"line", end_line}, {"character", end_column}}}}},
      {"text", text}};
}

}  // namespace isocnc::lsp
