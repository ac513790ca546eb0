#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "interpreter/syntax/line_tree.h"

namespace isocnc::transforming {

/// How many decimals a number that cannot be exact is rounded to.
struct Decimals {
  static constexpr int kMillimeters = 5;
  static constexpr int kInches = 6;
  static constexpr int kDegrees = 6;
  static constexpr int kVector = 9;  ///< Components of a unit vector.
  static constexpr int kFeed = 4;
};

/// A number near to another one that is written already: with its sign in the same style and no fewer decimals, and
/// with no more than its value needs. Only what needs more than `max_decimals` is rounded.
std::string number_like(std::string_view written, double value, int max_decimals);

/// Changes words of a line, and nothing else in it.
class LineEdits {
 public:
  explicit LineEdits(const syntax::LineTree& line) : line_(line) {}

  /// Gives a word another value, if it is another one, and another letter, if that is another one.
  void change(const syntax::Word& word, char letter, double value, int max_decimals);
  /// Replaces a word by others.
  void replace(const syntax::Word& word, std::string_view words);
  /// Replaces the last digit of a G.
  void change_last_digit(const syntax::Word& word, char digit);
  /// Puts words after a word, or before it, separated from it as it is from its other neighbor.
  void insert_after(const syntax::Word& word, std::string_view words);
  void insert_before(const syntax::Word& word, std::string_view words);

  /// The line with all changes.
  std::string text() const;

 private:
  struct WordChange {
    syntax::Span span;
    std::string text;
  };

  std::string characters_of(const syntax::Word& word) const;
  std::string comments_in(const syntax::Word& word) const;
  bool is_in_comment(std::size_t column) const;

  const syntax::LineTree& line_;
  std::vector<WordChange> changes_;
};

}  // namespace isocnc::transforming
