#include "interpreter/dialect/foreign_form.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace isocnc::dialect {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - ('a' - 'A')) : c; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Longer lines have usually lost their line ends: they show no single habit.
constexpr std::size_t kLongestLine = 1'000;

/// The text in capitals, without comments, leading zeros, and blanks except those between letters.
std::string canonical(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size() && text[at] != ';'; ++at) {
    const std::size_t close = text[at] == '(' ? text.find(')', at) : std::string_view::npos;
    if (close != std::string_view::npos) {
      at = close;
      continue;
    }
    if (is_blank(text[at])) continue;
    const char c = upper(text[at]);
    if (result.empty()) {
      result = c;
      continue;
    }
    const bool follows_blank = at > 0 && is_blank(text[at - 1]);
    if (follows_blank && is_upper(c) && is_upper(result.back())) result += ' ';
    const char before = result.size() > 1 ? result[result.size() - 2] : ' ';
    const bool follows_leading_zero = result.back() == '0' && !is_digit(before) && before != '.';
    if (follows_leading_zero && is_digit(c))
      result.back() = c;
    else
      result += c;
  }
  return result;
}

/// The canonical line without its number, with N or, in conversational language, without it.
std::string canonical_line(std::string_view line) {
  std::string text = canonical(line);
  const std::size_t begin = text.starts_with('N') ? 1 : 0;
  const std::size_t end = std::min(text.find_first_not_of("0123456789", begin), text.size());
  return end > begin ? text.substr(end) : text;
}

/// The end of the number at `at`; `at` where there is none.
std::size_t end_of_number(std::string_view text, std::size_t at) {
  const std::size_t begin = at;
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  const std::size_t digits = at;
  while (at < text.size() && (is_digit(text[at]) || text[at] == '.')) ++at;
  return at == digits ? begin : at;
}

/// The end of the words at `at` that start with one of these letters.
std::size_t end_of_words(std::string_view text, std::size_t at, std::string_view letters) {
  while (at < text.size() && letters.find(text[at]) != std::string_view::npos) {
    const std::size_t end = end_of_number(text, at + 1);
    if (end == at + 1) break;
    at = end;
  }
  return at;
}

std::size_t end_of_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

std::size_t end_of_name(std::string_view text, std::size_t at) {
  while (at < text.size() && (is_upper(text[at]) || is_digit(text[at]) || text[at] == '_')) ++at;
  return at;
}

/// The end of what a small letter of a pattern stands for, from `at` on; `at` where it is not there.
std::size_t end_of_part(char part, std::string_view text, std::size_t at) {
  switch (part) {
    case 'n':
      return end_of_number(text, at);
    case 'i':
      return end_of_digits(text, at);
    case 'd':
      return at < text.size() && is_digit(text[at]) ? at + 1 : at;
    case 'w':
      return end_of_name(text, at);
    case 'c':
      return end_of_words(text, at, "IJK");
    case 'g':
      return end_of_words(text, at, "G");
    case 'z':
      return end_of_words(text, at, "XYZUVWABC");
    default:
      return at;
  }
}

/// Whether a pattern without alternatives fits the text.
bool fits_whole(std::string_view pattern, std::string_view text) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const char part = pattern[i];
    if (part == 'x') {
      const std::string_view rest = pattern.substr(i + 1);
      if (rest.empty()) return true;
      const bool starts_with_text = rest.front() < 'a' || rest.front() > 'z';
      const auto next_start = [&](std::size_t from) { return starts_with_text ? text.find(rest.front(), from) : from; };
      for (std::size_t next = next_start(at); next <= text.size(); next = next_start(next + 1))
        if (fits_whole(rest, text.substr(next))) return true;
      return false;
    }
    const bool is_letter = part < 'a' || part > 'z';
    if (is_letter && (at == text.size() || text[at] != part)) return false;
    const std::size_t end = is_letter ? at + 1 : end_of_part(part, text, at);
    if (end == at) return false;
    at = end;
  }
  return at == text.size();
}

using Characters = std::bitset<256>;

/// The characters that a pattern's text may start with.
Characters first_characters(std::string_view pattern) {
  Characters firsts;
  const char part = pattern.front();
  if (part < 'a' || part > 'z') return firsts.set(static_cast<unsigned char>(part));
  if (part == 'x') return firsts.set();
  for (std::size_t i = 0; i < firsts.size(); ++i) {
    const char text[] = {static_cast<char>(i), '1'};  // A letter of a word, with its number.
    firsts[i] = end_of_part(part, {text, std::size(text)}, 0) > 0;
  }
  return firsts;
}

/// Alternatives of a pattern, and what their texts may start with: few marks and lines need more than that.
class Patterns {
 public:
  explicit Patterns(std::string_view patterns) : alternatives_(alternatives(patterns)) {
    for (const std::string_view pattern : alternatives_) firsts_ |= first_characters(pattern);
  }

  bool empty() const { return alternatives_.empty(); }

  /// Whether one of them fits the text, or there is none.
  bool fit(std::string_view text) const {
    if (empty()) return true;
    if (text.empty() || !firsts_[static_cast<unsigned char>(text.front())]) return false;
    return std::any_of(alternatives_.begin(), alternatives_.end(),
                       [&](std::string_view pattern) { return fits_whole(pattern, text); });
  }

 private:
  std::vector<std::string_view> alternatives_;
  Characters firsts_;
};

/// The forms by what they are looked for with, since programs may have a wrong line after another. Each list is in the
/// order of the table.
class FormIndex {
 public:
  struct IndexedForm {
    const ForeignForm* form;
    Patterns mark;
    Patterns line;
  };

  FormIndex() {
    for (const ForeignForm& form : foreign_forms()) {
      const IndexedForm entry = {&form, Patterns(form.mark), Patterns(form.line)};
      if (form.is_statement) statements_.push_back(entry);
      if (form.keeps_message) continue;
      for (const DiagnosticId id : form.diagnostics)
        if (id != kNoDiagnostic) by_diagnostic_[static_cast<std::size_t>(id)].push_back(entry);
    }
  }

  const std::vector<IndexedForm>& of(DiagnosticId id) const { return by_diagnostic_[static_cast<std::size_t>(id)]; }
  const std::vector<IndexedForm>& statements() const { return statements_; }

 private:
  std::array<std::vector<IndexedForm>, kDiagnosticCount> by_diagnostic_;
  std::vector<IndexedForm> statements_;
};

const FormIndex& form_index() {
  static const FormIndex kIndex;
  return kIndex;
}

/// The text that the message shows for a mark: the mark, or the whole that it is a part of.
std::string_view shown_part(const ForeignForm& form, std::string_view line, std::size_t begin, std::size_t end) {
  if (!form.is_part) return line.substr(begin, end - begin);
  const auto is_name = [&](std::size_t at) { return is_digit(line[at]) || is_upper(upper(line[at])); };
  const auto ends_word = [&](std::size_t at) { return at == line.size() || is_blank(line[at]) || line[at] == ';'; };
  if (line[begin] == '=') {
    while (begin > 0 && is_blank(line[begin - 1])) --begin;
    while (begin > 0 && is_name(begin - 1)) --begin;
    while (end < line.size() && is_blank(line[end])) ++end;
  }
  while (!ends_word(end)) ++end;
  // CR = 5: up to the end of the value.
  std::size_t equals = end;
  while (equals < line.size() && is_blank(line[equals])) ++equals;
  if (equals < line.size() && line[equals] == '=') {
    end = equals + 1;
    while (end < line.size() && is_blank(line[end])) ++end;
    while (!ends_word(end)) ++end;
  }
  return line.substr(begin, end - begin);
}

}  // namespace

std::vector<std::string_view> alternatives(std::string_view patterns) {
  std::vector<std::string_view> result;
  for (std::size_t at = 0; at < patterns.size();) {
    const std::size_t end = std::min(patterns.find('|', at), patterns.size());
    result.push_back(patterns.substr(at, end - at));
    at = end + 1;
  }
  return result;
}

const ForeignForm* foreign_form(DiagnosticId id, std::string_view line, std::size_t begin, std::size_t end) {
  if (line.size() > kLongestLine || begin >= end || end > line.size()) return nullptr;
  const std::vector<FormIndex::IndexedForm>& entries = form_index().of(id);
  if (entries.empty()) return nullptr;
  const std::string mark = canonical(line.substr(begin, end - begin));
  std::optional<std::string> whole;
  for (const FormIndex::IndexedForm& entry : entries) {
    if (!entry.mark.fit(mark)) continue;
    if (!whole && !entry.line.empty()) whole = canonical_line(line);
    if (entry.line.empty() || entry.line.fit(*whole)) return entry.form;
  }
  return nullptr;
}

const ForeignForm* foreign_statement(std::string_view line) {
  if (line.size() > kLongestLine) return nullptr;
  const std::vector<FormIndex::IndexedForm>& statements = form_index().statements();
  const std::string whole = canonical_line(line);
  const auto found = std::find_if(statements.begin(), statements.end(),
                                  [&](const FormIndex::IndexedForm& entry) { return entry.line.fit(whole); });
  return found == statements.end() ? nullptr : found->form;
}

std::string controls_of(const ForeignForm& form, Language language) {
  static constexpr Text kAnd = {" and ", " e "};
  static constexpr Text kOthers = {"others", "altri"};
  std::string text;
  std::size_t count = 0;
  for (std::size_t i = 0; i < kForeignControlCount; ++i) {
    if ((form.controls & bit(static_cast<ForeignControl>(i))) == 0) continue;
    ++count;
    if (count == 1) text += kForeignControlNames[i];
    if (count == 2) {
      const bool is_last = form.controls >> (i + 1) == 0;
      text += kAnd.in(language);
      text += is_last ? kForeignControlNames[i] : kOthers.in(language);
    }
  }
  return text;
}

std::string message(const ForeignForm& form, Language language, std::string_view line, std::size_t begin,
                    std::size_t end) {
  static constexpr Text kMessage = {"on {0} {1} {2}; here {3}", "su {0} {1} {2}; qui {3}"};
  return fmt::format(fmt::runtime(kMessage.in(language)), controls_of(form, language),
                     quote(shown_part(form, line, begin, end)), form.there.in(language), form.here.in(language));
}

}  // namespace isocnc::dialect
