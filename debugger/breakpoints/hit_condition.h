#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace isocnc::breakpoints {

/// Which of its hits a breakpoint stops at: `3` or `=3` the third, `>=3` from the third on, `%3` every third.
class HitCondition {
 public:
  /// None where the text is no such condition.
  static std::optional<HitCondition> read(std::string_view text);
  bool admits(std::uint64_t hit) const;

 private:
  enum class Kind : std::uint8_t { Equal, Less, LessEqual, Greater, GreaterEqual, Every };

  Kind kind_ = Kind::Equal;
  std::uint64_t count_ = 0;
};

}  // namespace isocnc::breakpoints
