// What the WebAssembly module offers to web/src/module.ts: the commands, and both servers as a conversation of
// messages. Texts are UTF-8 in the module's memory, with a NUL at the end.

#include <emscripten.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "debugger/adapter.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/system/exit_status.h"
#include "lsp/rpc/hosted_peer.h"
#include "lsp/server.h"
#include "web/commands.h"

namespace isocnc::web {
namespace {

// clang-format off
EM_JS(void, send_to_host, (int conversation, const char* body), { Module["onmessage"](conversation, UTF8ToString(body)); });
// clang-format on

/// The conversations that have begun and not ended.
std::map<int, rpc::HostedPeer>& conversations() {
  static std::map<int, rpc::HostedPeer> all;
  return all;
}

rpc::MakePeer maker_of(std::string_view server, std::string_view language) {
  return [server, language](rpc::Loop& loop, rpc::Send send) -> std::unique_ptr<rpc::Peer> {
    if (server == "isodap")
      return std::make_unique<debugger::Adapter>(loop, std::move(send), dialect::language_named(language));
    return std::make_unique<lsp::Server>(loop, std::move(send), dialect::language_named(language));
  };
}

extern "C" {

/// Runs the command whose name is the first argument: `isolint`, `isofmt`, `isorun` or `isodiff`. Returns the exit
/// status; that of a usage error for a command that the module does not have.
EMSCRIPTEN_KEEPALIVE int isocnc_run(int argc, char** argv) {
  const CommandMain command = command_named(argv[0]);
  return command == nullptr ? static_cast<int>(system::ExitStatus::Failure) : command(argc, argv);
}

/// Begins a conversation with `isols` or `isodap`; `language` is en, it, or empty for the client's. Messages for the
/// client go to Module.onmessage(conversation, body). Returns the number of the conversation.
EMSCRIPTEN_KEEPALIVE int isocnc_begin(const char* server, const char* language) {
  static int last = 0;
  const int number = ++last;
  const auto send = [number](const std::string& body) { send_to_host(number, body.c_str()); };
  conversations().try_emplace(number, maker_of(server, language), send);
  return number;
}

EMSCRIPTEN_KEEPALIVE void isocnc_receive(int conversation, const char* body) {
  conversations().at(conversation).receive(body);
}

/// Works for about so many milliseconds. Returns those until there is more to do, -1 while it waits for a message, -2
/// once the conversation is over.
EMSCRIPTEN_KEEPALIVE int isocnc_work(int conversation, int milliseconds) {
  rpc::HostedPeer& peer = conversations().at(conversation);
  const auto next = peer.work(std::chrono::milliseconds(milliseconds));
  if (peer.is_done()) return -2;
  return next ? static_cast<int>(next->count()) : -1;
}

/// Ends a conversation. Returns the exit status of the server.
EMSCRIPTEN_KEEPALIVE int isocnc_end(int conversation) {
  const int status = conversations().at(conversation).exit_status();
  conversations().erase(conversation);
  return status;
}

}  // extern "C"

}  // namespace
}  // namespace isocnc::web
