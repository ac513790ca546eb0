#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/syntax/tree_store.h"

namespace isocnc::syntax {

/// Maximum line number (N) that the tools write. It has 15 digits, so that every reader represents it exactly.
inline constexpr std::uint64_t kMaxLineNumber = 999'999'999'999'999;

enum class GDigits : std::uint8_t { Keep, One, Two };  ///< As written, G1, G01.

/// Style of the lines. Upper case and single blanks between words are the same in every style.
struct LineStyle {
  std::optional<int> max_decimals;  ///< 05.00 becomes 5 and .5 becomes 0.5, if the number fits in this many decimals.
  GDigits g_digits = GDigits::Keep;
  bool word_order = false;  ///< N first, arguments as X Y Z A B C I J K P Q R, F after those of the motion.
};

/// Changes of one line that depend on the whole program.
struct LineChange {
  enum class MotionEdit : std::uint8_t { Keep, Write, Drop };  ///< The line's motion G: unchanged, added, removed.

  std::optional<std::uint64_t> line_number;  ///< New N of the line, at most kMaxLineNumber.
  std::optional<std::uint64_t> target;       ///< New label after the line's GOTO.
  MotionEdit motion = MotionEdit::Keep;
  bool keeps_order = false;          ///< Whether the words stay in their order, whatever the style.
  std::uint8_t motion_in_force = 0;  ///< Number of the G to write with MotionEdit::Write: 0 to 3.
};

/// Formats lines. Handles one line at a time; equal lines give equal results. Where more than letter case and the
/// blanks between words changes, the result is parsed again, and used only if it has the same meaning, word for word. A
/// line with a finding of its own keeps every byte.
class Formatter {
 public:
  explicit Formatter(const LineStyle& style) : style_(style) {}

  /// The formatted line; tree.text itself if it is formatted already. Valid until the next call.
  std::string_view format(const LineTree& tree, const LineChange& change = {});

 private:
  enum class Order : std::uint8_t { AsWritten, Canonical };

  std::string_view rewrite(const LineTree& tree, const LineChange& change);
  bool write(const LineTree& tree, const LineChange& change, Order order);
  void start(const LineTree& tree);
  std::string_view written() const { return {line_.data(), line_.size()}; }
  void choose_order(const LineTree& tree, const LineChange& change);
  void sort_arguments(const LineTree& tree, const Instruction& instruction);
  void move_feed(const LineTree& tree);
  void write_words(const LineTree& tree, const LineChange& change);
  void write_word(const LineTree& tree, std::uint16_t index);
  void write_characters(std::string_view text);
  void write_new_number(std::uint64_t number);
  void write_motion(std::uint8_t number);
  void write_comments_before(const LineTree& tree, std::uint32_t column);
  void write_comment(const LineTree& tree, Span comment);
  void write_gap(std::string_view text, std::uint32_t column);
  void separate();
  void put(std::string_view text);
  void settle_decimals(std::size_t number);
  void drop_leading_zeros(std::size_t number);
  void settle_g_digits(std::size_t number);

  LineStyle style_;
  Buffer<char> line_;
  std::vector<std::uint16_t> order_;  // Indices of the words in the order of writing.
  std::vector<std::uint16_t> slots_;  // Positions in `order_` of the arguments of one instruction.
  std::size_t comments_written_ = 0;
  TreeStore written_;
};

/// Formats a single line without terminator.
std::string formatted(std::string_view line, const LineStyle& style = {});

}  // namespace isocnc::syntax
