#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lsp/rpc/json.h"

namespace isocnc::lsp::rpc {

/// A string of a message, still as JSON writes it, with the message that it lies in. The text of a program may be
/// hundreds of megabytes: it is read by whoever wants it, when and where they do, and not where messages are told
/// apart.
class LongText {
 public:
  LongText(std::shared_ptr<const std::string> message, std::string_view written)
      : message_(std::move(message)), written_(written) {}

  /// The text: escapes read, half surrogate pairs as U+FFFD, other bytes as they are.
  std::string read() const;

 private:
  std::shared_ptr<const std::string> message_;
  std::string_view written_;
};

/// A message as JSON. Its long strings have been left out: a short one stands in the place of each.
class Parsed {
 public:
  /// Strings from this length on are long.
  static constexpr std::size_t kLong = 16 * 1024;

  /// `json` is discarded where rpc::parse would discard it.
  static Parsed parse(std::string text);

  Json json;
  /// The text of one of its strings, long or not.
  std::string text(const Json& string) const;

 private:
  std::vector<LongText> long_texts_;
};

}  // namespace isocnc::lsp::rpc
