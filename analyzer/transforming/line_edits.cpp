#include "analyzer/transforming/line_edits.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "interpreter/text/characters.h"

namespace isocnc::transforming {

using syntax::Span;
using syntax::Word;

/// Numbers nearer than this are the same.
static constexpr double kSameNumber = 1e-9;

static std::size_t decimals_of(std::string_view number) {
  const std::size_t point = number.find('.');
  return point == std::string_view::npos ? 0 : number.size() - point - 1;
}

/// The number with this many decimals, and without a sign that a zero does not need.
static std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_of("123456789") == std::string::npos && text.front() == '-') text.erase(0, 1);
  return text;
}

std::string number_like(std::string_view written, double value, int max_decimals) {
  const bool has_plus = !written.empty() && written.front() == '+';
  const auto minimum = static_cast<int>(decimals_of(written));
  int decimals = minimum;
  const auto error = [&] {
    const double scale = std::pow(10.0, decimals);
    return std::abs(std::round(value * scale) / scale - value);
  };
  while (decimals < max_decimals && error() > kSameNumber) ++decimals;
  std::string text = fixed(value, decimals);
  while (decimals > minimum && text.back() == '0') {
    text.pop_back();
    --decimals;
  }
  if (text.back() == '.') text.pop_back();
  if (!written.empty() && written.back() == '.' && decimals == 0) text += '.';
  if (has_plus && value > 0) text.insert(0, 1, '+');
  return text;
}

/// The number as it is written, with the other sign.
static std::string negated(std::string_view written) {
  switch (written.front()) {
    case '-':
      return std::string(written.substr(1));
    case '+':
      return '-' + std::string(written.substr(1));
    default:
      return '-' + std::string(written);
  }
}

bool LineEdits::is_in_comment(std::size_t column) const {
  return std::any_of(line_.comments.begin(), line_.comments.end(),
                     [&](const Span& comment) { return comment.begin <= column && column < comment.end; });
}

/// The word without blanks and comments in it.
std::string LineEdits::characters_of(const Word& word) const {
  std::string characters;
  for (std::size_t i = word.begin; i < word.end; ++i)
    if (!text::is_blank(line_.text[i]) && !is_in_comment(i)) characters += line_.text[i];
  return characters;
}

/// The comments inside a word, which stay after it.
std::string LineEdits::comments_in(const Word& word) const {
  std::string comments;
  for (const Span& comment : line_.comments)
    if (word.begin < comment.begin && comment.end <= word.end) comments += ' ' + std::string(line_.text_of(comment));
  return comments;
}

void LineEdits::change(const Word& word, char letter, double value, int max_decimals) {
  const bool keeps_value = std::abs(value - word.value) < kSameNumber;
  if (keeps_value && word.letter == letter) return;
  const std::string characters = characters_of(word);
  const std::string number = characters.substr(1);
  const bool is_lower = characters.front() != text::upper(characters.front());
  std::string result(1, is_lower ? static_cast<char>(letter - 'A' + 'a') : letter);
  if (keeps_value) {
    result += number;
  } else if (std::abs(value + word.value) < kSameNumber) {
    result += negated(number);
  } else {
    result += number_like(number, value, max_decimals);
  }
  changes_.push_back({word.span(), result + comments_in(word)});
}

void LineEdits::replace(const Word& word, std::string_view words) {
  changes_.push_back({word.span(), std::string(words) + comments_in(word)});
}

void LineEdits::change_last_digit(const Word& word, char digit) {
  for (std::uint32_t i = word.end; i > word.begin; --i) {
    if (!text::is_digit(line_.text[i - 1]) || is_in_comment(i - 1)) continue;
    if (line_.text[i - 1] != digit) changes_.push_back({{i - 1, i}, std::string(1, digit)});
    return;
  }
}

void LineEdits::insert_after(const Word& word, std::string_view words) {
  const bool is_apart = word.begin == 0 || text::is_blank(line_.text[word.begin - 1]);
  changes_.push_back({{word.end, word.end}, (is_apart ? " " : "") + std::string(words)});
}

void LineEdits::insert_before(const Word& word, std::string_view words) {
  const bool is_apart = word.end == line_.text.size() || text::is_blank(line_.text[word.end]);
  changes_.push_back({{word.begin, word.begin}, std::string(words) + (is_apart ? " " : "")});
}

std::string LineEdits::text() const {
  std::vector<WordChange> changes = changes_;
  std::stable_sort(changes.begin(), changes.end(),
                   [](const WordChange& a, const WordChange& b) { return a.span < b.span; });
  std::string text;
  std::uint32_t copied = 0;
  for (const WordChange& change : changes) {
    text += line_.text_of({copied, change.span.begin});
    text += change.text;
    copied = change.span.end;
  }
  return text += line_.text.substr(copied);
}

}  // namespace isocnc::transforming
