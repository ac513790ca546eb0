#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "debugger/adapter.h"
#include "lsp/rpc/hosted_peer.h"
#include "lsp/server.h"
#include "require.h"

namespace isocnc::fuzz {

using Json = rpc::Json;

/// The program that the debugger of the corpus launches.
static constexpr const char* kProgram = "/tmp/isocnc-conversation.iso";

static bool write_program() {
  std::ofstream(kProgram) << "M06 T101001\nS18000 M03\nG00 X0 Y0 Z5\nG01 Z-2 F1500\nV1 = 3\nX10 Y10\nM02\n";
  return std::atexit([] { std::remove(kProgram); }) == 0;
}

/// What ends a conversation in order, once it has begun.
static constexpr std::string_view kLspEnd[] = {R"({"jsonrpc":"2.0","id":"last","method":"shutdown"})",
                                               R"({"jsonrpc":"2.0","method":"exit"})"};
static constexpr std::string_view kDapEnd[] = {R"({"seq":9999,"type":"request","command":"disconnect"})"};

/// A conversation as the WebAssembly module has it with a page (web/module.cpp): each line is the body of a message,
/// whatever it holds, and the host lets the server work between any two.
class Conversation {
 public:
  explicit Conversation(bool debugs)
      : debugs_(debugs),
        peer_(
            [debugs](rpc::Loop& loop, rpc::Send send) -> std::unique_ptr<rpc::Peer> {
              if (debugs) return std::make_unique<debugger::Adapter>(loop, std::move(send), std::nullopt);
              return std::make_unique<lsp::Server>(loop, std::move(send), std::nullopt);
            },
            [this](const std::string& body) { check(body); }) {}

  void run(std::string_view lines) {
    for (int count = 0; !lines.empty() && count < kMaxMessages && !peer_.is_done(); ++count) {
      const std::string_view line = lines.substr(0, lines.find('\n'));
      lines.remove_prefix(std::min(line.size() + 1, lines.size()));
      peer_.receive(std::string(line));
      if (!line.starts_with(' ')) peer_.work(std::chrono::milliseconds(1));  // Else with the next message.
    }
    work();
    if (debugs_) {
      for (const std::string_view body : kDapEnd) peer_.receive(std::string(body));
    } else {
      for (const std::string_view body : kLspEnd) peer_.receive(std::string(body));
    }
    work();
    require(peer_.is_done(), "the conversation ends where the client ends it");
  }

 private:
  /// As often as a host would that has nothing else to do, for what is due.
  void work() {
    constexpr int kTimes = 200;
    for (int i = 0; i < kTimes && !peer_.is_done(); ++i) {
      const auto next = peer_.work(std::chrono::milliseconds(5));
      if (!next || next->count() > 0) return;
    }
  }

  void check(const std::string& body) const {
    const Json message = Json::parse(body);
    require(message.is_object(), "a message is an object");
    require(message.contains(debugs_ ? "type" : "jsonrpc"), "it is one of the protocol");
  }

  static constexpr int kMaxMessages = 64;

  bool debugs_;
  rpc::HostedPeer peer_;
};

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view bytes = isocnc::fuzz::as_text(data, size);
  if (bytes.empty()) return 0;
  [[maybe_unused]] static const bool kHasProgram = isocnc::fuzz::write_program();
  const bool debugs = bytes.front() == 'd';
  bytes.remove_prefix(1);
  isocnc::fuzz::Conversation(debugs).run(bytes);
  return 0;
}
