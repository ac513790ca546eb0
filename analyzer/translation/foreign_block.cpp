#include "analyzer/translation/foreign_block.h"

#include <algorithm>
#include <cmath>

#include <fast_float/fast_float.h>

namespace isocnc::translation {

int ForeignWord::tenths() const {
  const double scaled = value * 10;
  const double rounded = std::round(scaled);
  if (is_formula || !(rounded >= 0 && rounded < 100'000) || std::abs(scaled - rounded) > 1e-6) return -1;
  return static_cast<int>(rounded);
}

const ForeignWord* ForeignBlock::find(char letter) const {
  const auto found =
      std::find_if(words.begin(), words.end(), [&](const ForeignWord& word) { return word.letter == letter; });
  return found == words.end() ? nullptr : &*found;
}

namespace {

constexpr bool is_blank_byte(char c) { return c == ' ' || c == '\t'; }
constexpr bool is_digit_byte(char c) { return c >= '0' && c <= '9'; }
constexpr char upper_byte(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
constexpr char lower_byte(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr bool is_letter_byte(char c) { return upper_byte(c) >= 'A' && upper_byte(c) <= 'Z'; }

/// Reads one line from left to right.
class BlockReader {
 public:
  BlockReader(std::string_view line, SourceControl control) : line_(line), control_(control) { block_.text = line; }

  ForeignBlock read() {
    skip_blanks();
    if (peek() == '%') {
      block_.is_tape_mark = true;
      return std::move(block_);
    }
    if (peek() == '/') {
      block_.skip_at = at_++;
      while (is_digit_byte(peek())) ++at_;
    }
    for (skip_blanks(); at_ < line_.size(); skip_blanks()) read_next();
    return std::move(block_);
  }

 private:
  char peek() const { return at_ < line_.size() ? line_[at_] : '\0'; }
  void skip_blanks() {
    while (is_blank_byte(peek())) ++at_;
  }

  void read_next() {
    const char c = peek();
    if (c == '(') return read_parenthesis();
    if (c == ';') return read_to_end();
    if (c == '#' || c == '[') return read_assignment();
    if (is_letter_byte(c)) return read_word();
    const std::size_t start = at_++;
    while (at_ < line_.size() && (static_cast<unsigned char>(peek()) & 0xC0) == 0x80)
      ++at_;  // The rest of a character.
    mark(BlockOddity::Unreadable, start, at_);
  }

  /// The first mark of a line stays.
  void mark(BlockOddity oddity, std::size_t start, std::size_t end) {
    if (block_.oddity != BlockOddity::None) return;
    block_.oddity = oddity;
    block_.oddity_at = start;
    block_.oddity_end = end;
  }

  void read_parenthesis() {
    const std::size_t close = line_.find(')', at_);
    const std::size_t end = close == std::string_view::npos ? line_.size() : close + 1;
    block_.comments.push_back(line_.substr(at_, end - at_));
    at_ = end;
  }

  void read_to_end() {
    const std::string_view rest = line_.substr(at_);
    if (rest.find_first_not_of("; \t") != std::string_view::npos) block_.comments.push_back(rest);
    at_ = line_.size();
  }

  /// From here to the next comment, which is no assignment's.
  std::size_t statement_end() const { return std::min(line_.find_first_of("(;", at_), line_.size()); }

  void read_assignment() {
    const std::size_t end = statement_end();
    mark(BlockOddity::Assignment, at_, end);
    at_ = end;
  }

  /// Skips a variable or an expression, and whether there was one.
  bool skip_formula() {
    const std::size_t start = at_;
    while (peek() == '-' || peek() == '+' || is_blank_byte(peek())) ++at_;
    while (peek() == '#') ++at_;
    if (peek() == '[') {
      int depth = 0;
      do {
        depth += peek() == '[' ? 1 : peek() == ']' ? -1 : 0;
        ++at_;
      } while (depth > 0 && at_ < line_.size());
      return true;
    }
    if (peek() == '<') {
      at_ = std::min(line_.find('>', at_), line_.size() - 1) + 1;
      return true;
    }
    if (at_ > start && line_[at_ - 1] == '#') {
      while (is_digit_byte(peek())) ++at_;
      return true;
    }
    at_ = start;
    return false;
  }

  void read_word() {
    const std::size_t start = at_;
    const char letter = upper_byte(line_[at_++]);
    if (letter == 'O' && control_ == SourceControl::LinuxCnc) return read_flow(start);
    ForeignWord word{.letter = letter, .at = start};
    if (skip_formula()) {
      word.is_formula = true;
    } else if (!read_number(word)) {
      return read_statement(start);
    }
    word.end = at_;
    block_.words.push_back(std::move(word));
  }

  /// Reads digits, sign and point, with blanks among them.
  bool read_number(ForeignWord& word) {
    bool has_digit = false;
    std::size_t end = at_;
    for (std::size_t i = at_; i < line_.size(); ++i) {
      const char c = line_[i];
      if (is_blank_byte(c)) continue;
      const bool is_sign = (c == '+' || c == '-') && word.digits.empty();
      const bool is_point = c == '.' && !word.has_point;
      if (!is_sign && !is_point && !is_digit_byte(c)) break;
      word.digits += c;
      word.has_point |= is_point;
      has_digit |= is_digit_byte(c);
      end = i + 1;
    }
    if (!has_digit) return false;
    at_ = end;
    const std::size_t plus = word.digits.front() == '+' ? 1 : 0;
    const char* const last = word.digits.data() + word.digits.size();
    const auto result = fast_float::from_chars(word.digits.data() + plus, last, word.value);
    return result.ec == std::errc{} && result.ptr == last && std::isfinite(word.value);
  }

  /// A letter that no number follows: a keyword such as IF, or a slip.
  void read_statement(std::size_t start) {
    at_ = start;
    while (is_letter_byte(peek())) ++at_;
    const bool is_keyword = at_ - start > 1;
    const std::size_t end = is_keyword ? statement_end() : at_;
    mark(is_keyword ? BlockOddity::Statement : BlockOddity::Unreadable, start, end);
    at_ = end;
  }

  void read_flow(std::size_t start) {
    skip_blanks();
    if (peek() == '<') {
      const std::size_t end = std::min(line_.find('>', at_), line_.size() - 1) + 1;
      block_.flow_label = line_.substr(at_, end - at_);
      at_ = end;
    } else {
      while (is_digit_byte(peek()) || peek() == '#') block_.flow_label += line_[at_++];
    }
    skip_blanks();
    while (is_letter_byte(peek())) block_.flow += lower_byte(line_[at_++]);
    at_ = statement_end();
    mark(BlockOddity::Statement, start, at_);
  }

  std::string_view line_;
  SourceControl control_;
  std::size_t at_ = 0;
  ForeignBlock block_;
};

}  // namespace

ForeignBlock read_foreign_block(std::string_view line, SourceControl control) {
  return BlockReader(line, control).read();
}

}  // namespace isocnc::translation
