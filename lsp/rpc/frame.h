#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace isocnc::lsp::rpc {

/// One message as it was framed, or why there is none.
struct Frame {
  enum class Problem : std::uint8_t {
    None,
    NoLength,  ///< A header without a Content-Length that can be read; what follows it is not known to be a message.
    TooLong,   ///< The message is longer than any that is taken; it is passed over.
  };

  Problem problem = Problem::None;
  std::string body;  ///< Empty where there is a problem.
};

/// Cuts a stream of bytes into messages, as the language server protocol and the debug adapter protocol both frame
/// them: header fields, of which Content-Length alone counts, an empty line, and so many bytes. Takes the bytes in any
/// pieces. Behind a header that tells no length it goes on at the next `Content-Length:`.
///
/// Holds no more than the present message and what is known of it: a length that is announced costs nothing before the
/// bytes are there.
class FrameReader {
 public:
  /// A program of 10 million lines, as JSON, is a third of it.
  static constexpr std::size_t kLongestBody = std::size_t{1} << 30;
  static constexpr std::size_t kLongestHeader = 8192;

  explicit FrameReader(std::size_t longest_body = kLongestBody) : longest_body_(longest_body) {}

  /// Reads some more bytes and appends the messages that they complete.
  void read(std::string_view bytes, std::deque<Frame>& frames);
  /// Whether the stream may end here without cutting a message off.
  bool is_between_messages() const { return state_ == State::Header && header_.empty(); }

 private:
  enum class State : std::uint8_t { Header, Body, Skipped, Lost };

  std::string_view read_header(std::string_view bytes, std::deque<Frame>& frames);
  std::string_view read_body(std::string_view bytes, std::deque<Frame>& frames);
  std::string_view skip(std::string_view bytes);
  std::string_view find_header(std::string_view bytes);
  void start_body(std::deque<Frame>& frames);

  const std::size_t longest_body_;
  State state_ = State::Header;
  std::string header_;
  std::string body_;
  std::size_t length_ = 0;   // Of the body, or of what is left to skip.
  std::size_t matched_ = 0;  // Characters of `Content-Length:` that have just been read, while looking for it.
};

/// What stands before a message of this length.
std::string frame_header(std::size_t length);

}  // namespace isocnc::lsp::rpc
