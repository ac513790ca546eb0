#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/translation/source_control.h"

namespace isocnc::translation {

/// A word of another control: a letter and a number.
struct ForeignWord {
  char letter = 0;  ///< Upper case.
  double value = 0;
  std::string digits;  ///< The number as written, without blanks.
  std::size_t at = 0;  ///< Byte of the line.
  std::size_t end = 0;
  bool has_point = false;
  bool is_formula = false;  ///< A variable or an expression stands in the place of the number.

  /// The number of a G or M in tenths, such as 541 for G54.1; -1 if it is none.
  int tenths() const;
};

/// What a block holds that is no word.
enum class BlockOddity : std::uint8_t {
  None,
  Assignment,  ///< `#1=5`
  Statement,   ///< `IF`, `GOTO`, `o100 call`
  Unreadable,  ///< A character that starts nothing, or a letter without a number.
};

/// The line of a program of another control, split into words and comments. It holds no meaning. Reading cannot fail:
/// what is no word is in `oddity`.
struct ForeignBlock {
  std::string_view text;  ///< The line, without its end.
  std::vector<ForeignWord> words;
  std::vector<std::string_view> comments;  ///< With their parentheses, or from the semicolon on.
  std::optional<std::size_t> skip_at;      ///< Byte of a `/` that lets the operator skip the block.
  bool is_tape_mark = false;               ///< A line that starts with `%`.
  BlockOddity oddity = BlockOddity::None;
  std::size_t oddity_at = 0;
  std::size_t oddity_end = 0;
  std::string flow;        ///< The keyword of an O line of LinuxCNC, in lower case: `sub`, `endif`.
  std::string flow_label;  ///< Its number or name.

  /// The first word with the letter; null if there is none.
  const ForeignWord* find(char letter) const;
};

ForeignBlock read_foreign_block(std::string_view line, SourceControl control);

}  // namespace isocnc::translation
