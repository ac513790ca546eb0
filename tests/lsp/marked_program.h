#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lsp/protocol/encoding.h"
#include "lsp/rpc/json.h"

namespace isocnc::lsp {

/// A program with marked places: `|` is the cursor, `[...]` an expected range. The marks are not part of the text.
struct MarkedProgram {
  std::string text;
  rpc::Json cursor;  ///< A position of the protocol: {"line", "character"}.
  std::vector<rpc::Json> marked_ranges;

  MarkedProgram(std::string_view marked, protocol::Encoding encoding) {
    rpc::Json begin;
    std::size_t line = 0;
    std::size_t line_start = 0;
    const auto here = [&] {
      const std::string_view before = std::string_view(text).substr(line_start);
      return rpc::Json{{"line", line}, {"character", protocol::units_before(before, before.size(), encoding)}};
    };
    for (const char c : marked) {
      if (c == '|') {
        cursor = here();
      } else if (c == '[') {
        begin = here();
      } else if (c == ']') {
        marked_ranges.push_back({{"start", begin}, {"end", here()}});
      } else {
        text += c;
        if (c != '\n') continue;
        ++line;
        line_start = text.size();
      }
    }
  }
};

/// The text without control characters and bytes outside ASCII, which a message cannot hold or which would end a line.
inline std::string message_text(std::string text) {
  const auto is_strange = [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7E;
  };
  text.erase(std::remove_if(text.begin(), text.end(), is_strange), text.end());
  return text;
}

inline constexpr protocol::Encoding kEncodings[] = {protocol::Encoding::Utf8, protocol::Encoding::Utf16,
                                                    protocol::Encoding::Utf32};

/// The capabilities of a client that requests this encoding.
inline rpc::Json capabilities_with(protocol::Encoding encoding) {
  return {{"general", {{"positionEncodings", {protocol::name_of(encoding)}}}}};
}

}  // namespace isocnc::lsp
