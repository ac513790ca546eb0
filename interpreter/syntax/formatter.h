#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/syntax/tree_store.h"

namespace isocnc::syntax {

/// Of an N that our tools write, so that it stays exact wherever it is read: 15 digits.
inline constexpr std::uint64_t kMaxLineNumber = 999'999'999'999'999;

enum class GDigits : std::uint8_t { Keep, One, Two };  ///< As written, G1, G01.

/// How lines are written, beside upper case and blanks, which are the same in every style.
struct LineStyle {
  std::optional<int> max_decimals;  ///< 05.00 becomes 5 and .5 becomes 0.5, where so many decimals hold the number.
  GDigits g_digits = GDigits::Keep;
  bool word_order = false;  ///< N first, arguments as X Y Z A B C I J K P Q R, F behind those of the motion.
};

/// What else is to become of one line, which only the whole program shows.
struct LineChange {
  enum class Motion : std::uint8_t { Keep, Write, Drop };  ///< Its motion G: as it is, written out, left out.

  std::optional<std::uint64_t> line_number;  ///< Its N from now on, at most kMostLineNumber.
  std::optional<std::uint64_t> target;       ///< The label behind its GOTO.
  Motion motion = Motion::Keep;
  std::uint8_t motion_in_force = 0;  ///< With Write: 0 to 3.
};

/// Writes lines as they should be written. Knows one line at a time; equal lines give equal results. Where more than
/// letter case and the blanks between words changes, what is written is parsed again, and taken only when it says the
/// same as before, word for word; a line with a finding of its own keeps every byte.
class Formatter {
 public:
  explicit Formatter(const LineStyle& style) : style_(style) {}

  /// The line as it should be: tree.text itself where that is so already. Valid until the next call.
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
  std::vector<std::uint16_t> order_;  // Of the words.
  std::vector<std::uint16_t> slots_;  // Where in it the arguments of one instruction stand.
  std::size_t comments_written_ = 0;
  TreeStore written_;
};

/// One line, for who has just one. Without a terminator.
std::string formatted(std::string_view line, const LineStyle& style = {});

}  // namespace isocnc::syntax
