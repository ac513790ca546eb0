#include <algorithm>
#include <cstdint>
#include <deque>

#include "lsp/rpc/frame.h"
#include "lsp/rpc/message.h"
#include "require.h"

namespace isocnc::fuzz {

using rpc::FrameReader;
using rpc::MessageFrame;

/// Frames of up to so many bytes: short ones are cut off often enough.
static constexpr std::size_t kLongest = 1'000;

static std::deque<MessageFrame> frames_of(std::string_view stream, std::size_t piece) {
  FrameReader reader(kLongest);
  std::deque<MessageFrame> frames;
  for (; !stream.empty(); stream.remove_prefix(std::min(piece, stream.size())))
    reader.read(stream.substr(0, piece), frames);
  return frames;
}

static bool same(const MessageFrame& a, const MessageFrame& b) { return a.error == b.error && a.body == b.body; }

static void read(std::string_view stream) {
  const std::deque<MessageFrame> frames = frames_of(stream, stream.size() + 1);
  const std::deque<MessageFrame> in_pieces = frames_of(stream, 1 + stream.size() % 7);
  require(std::equal(frames.begin(), frames.end(), in_pieces.begin(), in_pieces.end(), same),
          "how a stream is cut does not matter");
  for (const MessageFrame& frame : frames) require(frame.body.size() <= kLongest, "no message is longer than allowed");
  // The stream as a message, and as long strings within one.
  rpc::read_message(std::string(stream));
  const std::string padding(rpc::ParsedMessage::kLong, 'x');
  const auto parsed = rpc::ParsedMessage::parse("{\"a\":\"" + padding + std::string(stream) + "\"}");
  if (parsed.json.is_object() && parsed.json.contains("a") && parsed.json["a"].is_string())
    parsed.text(parsed.json["a"]);
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::read(isocnc::fuzz::as_text(data, size));
  return 0;
}
