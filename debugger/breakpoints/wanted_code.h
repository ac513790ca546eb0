#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "interpreter/syntax/line_tree.h"

namespace isocnc::breakpoints {

/// A code that a function breakpoint waits for: M, T or G with its number.
struct WantedCode {
  char letter = 'M';
  std::uint32_t number = 0;

  friend bool operator==(const WantedCode&, const WantedCode&) = default;

  /// None where the name is no such code.
  static std::optional<WantedCode> read(std::string_view name);
  bool is_in(const syntax::LineTree& tree) const;
};

}  // namespace isocnc::breakpoints
