#include "lsp/rpc/frame.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <system_error>

#include <fmt/format.h>

namespace isocnc::rpc {

static constexpr std::string_view kLengthField = "content-length:";

static char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

static bool is_length_field(std::string_view line) {
  return line.size() >= kLengthField.size() && std::equal(kLengthField.begin(), kLengthField.end(), line.begin(),
                                                          [](char a, char b) { return a == lower(b); });
}

static std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// A length that overflows counts as the largest number.
static std::optional<std::size_t> number_of(std::string_view digits) {
  std::size_t number = 0;
  const char* const end = digits.data() + digits.size();
  const auto [after, error] = std::from_chars(digits.data(), end, number);
  if (digits.empty() || after != end || error == std::errc::invalid_argument) return std::nullopt;
  return error == std::errc::result_out_of_range ? static_cast<std::size_t>(-1) : number;
}

/// The message length that a header gives; nothing if it gives none, or two that differ.
static std::optional<std::size_t> length_in(std::string_view header) {
  std::optional<std::size_t> length;
  while (!header.empty()) {
    const std::size_t end = std::min(header.find('\n'), header.size() - 1);
    const std::string_view line = header.substr(0, end + 1);
    header.remove_prefix(end + 1);
    if (!is_length_field(line)) continue;
    std::string_view value = line.substr(kLengthField.size());
    if (value.ends_with('\n')) value.remove_suffix(1);
    const auto number = number_of(trimmed(value));
    if (!number || (length && *length != *number)) return std::nullopt;
    length = number;
  }
  return length;
}

void FrameReader::read(std::string_view bytes, std::deque<MessageFrame>& frames) {
  while (!bytes.empty()) {
    switch (state_) {
      case ReadState::Header:
        bytes = read_header(bytes, frames);
        break;
      case ReadState::Body:
        bytes = read_body(bytes, frames);
        break;
      case ReadState::Skipped:
        bytes = skip(bytes);
        break;
      case ReadState::Lost:
        bytes = find_header(bytes);
        break;
    }
  }
}

/// Reads up to the empty line that ends a header. Lines should end with CR and LF; LF will do.
std::string_view FrameReader::read_header(std::string_view bytes, std::deque<MessageFrame>& frames) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    header_.push_back(bytes[i]);
    if (bytes[i] == '\n' && (header_.ends_with("\n\r\n") || header_.ends_with("\n\n"))) {
      start_body(frames);
      return bytes.substr(i + 1);
    }
    if (header_.size() < kLongestHeader) continue;
    header_.clear();
    state_ = ReadState::Lost;
    frames.push_back({MessageFrame::FramingError::NoLength, {}});
    return bytes.substr(i + 1);
  }
  return {};
}

void FrameReader::start_body(std::deque<MessageFrame>& frames) {
  const auto length = length_in(header_);
  header_.clear();
  length_ = length.value_or(0);
  if (!length) {
    state_ = ReadState::Lost;
    frames.push_back({MessageFrame::FramingError::NoLength, {}});
  } else if (length_ > longest_body_) {
    state_ = ReadState::Skipped;
    frames.push_back({MessageFrame::FramingError::TooLong, {}});
  } else if (length_ == 0) {
    frames.push_back({});
  } else {
    state_ = ReadState::Body;
  }
}

std::string_view FrameReader::read_body(std::string_view bytes, std::deque<MessageFrame>& frames) {
  const std::size_t taken = std::min(bytes.size(), length_ - body_.size());
  body_.append(bytes.substr(0, taken));
  if (body_.size() == length_) {
    frames.push_back({MessageFrame::FramingError::None, std::move(body_)});
    body_.clear();
    state_ = ReadState::Header;
  }
  return bytes.substr(taken);
}

std::string_view FrameReader::skip(std::string_view bytes) {
  const std::size_t taken = std::min(bytes.size(), length_);
  length_ -= taken;
  if (length_ == 0) state_ = ReadState::Header;
  return bytes.substr(taken);
}

/// Looks for the next `Content-Length:`, wherever it stands: no line end need come before it.
std::string_view FrameReader::find_header(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = lower(bytes[i]);
    matched_ = c == kLengthField[matched_] ? matched_ + 1 : c == kLengthField[0] ? 1 : 0;
    if (matched_ < kLengthField.size()) continue;
    matched_ = 0;
    header_ = kLengthField;
    state_ = ReadState::Header;
    return bytes.substr(i + 1);
  }
  return {};
}

std::string frame_header(std::size_t length) { return fmt::format("Content-Length: {}\r\n\r\n", length); }

}  // namespace isocnc::rpc
