#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace isocnc::rpc {

/// The body of one message, or the reason why there is none.
struct MessageFrame {
  enum class FramingError : std::uint8_t {
    None,
    NoLength,  ///< The header has no valid Content-Length, so that the end of the message is unknown.
    TooLong,   ///< The message is longer than the maximum; it is skipped.
  };

  FramingError error = FramingError::None;
  std::string body;  ///< Empty if there is an error.
};

/// Cuts a stream of bytes into messages, as the language server protocol and the debug adapter protocol both frame
/// them: header fields, of which only Content-Length counts, an empty line, and that number of bytes. Takes the bytes
/// in pieces of any size. After a header without a length it goes on at the next `Content-Length:`.
///
/// Holds at most the bytes received of the present message: a large Content-Length takes no memory until the bytes
/// arrive.
class FrameReader {
 public:
  /// In bytes. A program of 10 million lines, as JSON, takes a third of it.
  static constexpr std::size_t kLongestBody = std::size_t{1} << 30;

  explicit FrameReader(std::size_t longest_body = kLongestBody) : longest_body_(longest_body) {}

  /// Reads more bytes and appends the messages that they complete.
  void read(std::string_view bytes, std::deque<MessageFrame>& frames);

 private:
  static constexpr std::size_t kLongestHeader = 8192;

  enum class ReadState : std::uint8_t { Header, Body, Skipped, Lost };

  std::string_view read_header(std::string_view bytes, std::deque<MessageFrame>& frames);
  std::string_view read_body(std::string_view bytes, std::deque<MessageFrame>& frames);
  std::string_view skip(std::string_view bytes);
  std::string_view find_header(std::string_view bytes);
  void start_body(std::deque<MessageFrame>& frames);

  const std::size_t longest_body_;
  ReadState state_ = ReadState::Header;
  std::string header_;
  std::string body_;
  std::size_t length_ = 0;   // Length of the body, or the number of bytes left to skip.
  std::size_t matched_ = 0;  // Number of characters of `Content-Length:` matched so far in state Lost.
};

/// The header of a message whose body has this length in bytes.
std::string frame_header(std::size_t length);

}  // namespace isocnc::rpc
