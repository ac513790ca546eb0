#pragma once

#include <charconv>
#include <cstdio>
#include <string_view>

namespace isocnc::bench {

/// Numbers in a program are whole thousandths here (micrometers, millidegrees), so that what is printed is exact and
/// no machine rounds differently.
inline constexpr int kThousand = 1000;

/// Writes a program to standard output, word by word, and counts its lines.
class Writer {
 public:
  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { flush(); }

  /// Text as it stands, a space before it unless it begins the line: `G01`, `(POCKET)`.
  Writer& text(std::string_view text) {
    separate();
    for (const char character : text) put(character);
    return *this;
  }

  /// A letter and a decimal number: `word('X', -6780)` writes `X-6.78`.
  Writer& word(char letter, int thousandths) {
    separate();
    put(letter);
    return decimal(thousandths);
  }

  /// A letter and a whole number: `word_of('S', 5000)` writes `S5000`.
  Writer& word_of(char letter, int value) {
    separate();
    put(letter);
    return whole(value);
  }

  /// A whole number alone.
  Writer& integer(int value) {
    separate();
    return whole(value);
  }

  /// A decimal number that follows `=` or an operator.
  Writer& number(int thousandths) {
    separate();
    return decimal(thousandths);
  }

  void end_line() {
    put('\n');
    at_line_start_ = true;
    ++lines_;
    if (used_ > kBuffer - kLongestLine) flush();
  }

  /// One whole line.
  void line(std::string_view line) {
    text(line);
    end_line();
  }

  int lines() const { return lines_; }

 private:
  static constexpr int kBuffer = 1 << 16;
  static constexpr int kLongestLine = 1 << 10;

  void put(char character) { buffer_[used_++] = character; }

  void separate() {
    if (!at_line_start_) put(' ');
    at_line_start_ = false;
  }

  Writer& whole(int value) {
    used_ = static_cast<int>(std::to_chars(buffer_ + used_, buffer_ + kBuffer, value).ptr - buffer_);
    return *this;
  }

  Writer& decimal(int thousandths) {
    if (thousandths < 0) put('-');
    const int magnitude = thousandths < 0 ? -thousandths : thousandths;
    whole(magnitude / kThousand);
    int rest = magnitude % kThousand;
    if (rest != 0) put('.');
    for (int unit = kThousand / 10; rest != 0; rest %= unit, unit /= 10) put(static_cast<char>('0' + rest / unit));
    return *this;
  }

  void flush() {
    std::fwrite(buffer_, 1, static_cast<std::size_t>(used_), stdout);
    used_ = 0;
  }

  char buffer_[kBuffer];
  int used_ = 0;
  int lines_ = 0;
  bool at_line_start_ = true;
};

}  // namespace isocnc::bench
