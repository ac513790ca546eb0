#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lsp/rpc/json.h"

namespace isocnc::rpc {

/// A string of a message, still in its JSON form, which shares ownership of the message. The text of a program may be
/// hundreds of megabytes, so it is decoded on the thread that needs it, and not on the one that dispatches messages.
class LongText {
 public:
  LongText(std::shared_ptr<const std::string> message, std::string_view written)
      : message_(std::move(message)), written_(written) {}

  /// Decodes the text: resolves escapes, turns half surrogate pairs into U+FFFD and keeps other bytes as they are.
  std::string read() const;

 private:
  std::shared_ptr<const std::string> message_;
  std::string_view written_;
};

/// A message as JSON, in which a short placeholder replaces each long string.
class ParsedMessage {
 public:
  /// The length in bytes from which a string counts as long.
  static constexpr std::size_t kLong = 16 * 1024;

  /// Where rpc::parse() gives a discarded value, so is `json`.
  static ParsedMessage parse(std::string text);

  Json json;
  /// The text of one of the strings in `json`, long or not.
  std::string text(const Json& string) const;
  /// A part of `json` with the texts of all its strings.
  Json with_texts(Json part) const;

 private:
  std::vector<LongText> long_texts_;
};

}  // namespace isocnc::rpc
