#include "interpreter/dialect/foreign_form.h"

#include <algorithm>
#include <array>
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
  std::string plain;
  for (std::size_t at = 0; at < text.size() && text[at] != ';'; ++at) {
    const std::size_t close = text[at] == '(' ? text.find(')', at) : std::string_view::npos;
    if (close != std::string_view::npos) {
      at = close;
      continue;
    }
    if (is_blank(text[at])) continue;
    const bool follows_blank = at > 0 && is_blank(text[at - 1]);
    if (follows_blank && is_upper(upper(text[at])) && !plain.empty() && is_upper(plain.back())) plain += ' ';
    plain += upper(text[at]);
  }
  std::string result;
  for (std::size_t at = 0; at < plain.size(); ++at) {
    const bool starts_number = result.empty() || (!is_digit(result.back()) && result.back() != '.');
    const bool is_leading_zero = plain[at] == '0' && at + 1 < plain.size() && is_digit(plain[at + 1]);
    if (!starts_number || !is_leading_zero) result += plain[at];
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
      for (std::size_t next = rest.empty() ? text.size() : at; next <= text.size(); ++next)
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

/// Calls `visit` with each alternative, until it returns true. Returns whether it has.
template <class Visit>
bool any_alternative(std::string_view patterns, const Visit& visit) {
  for (std::size_t at = 0; at <= patterns.size();) {
    const std::size_t end = std::min(patterns.find('|', at), patterns.size());
    if (visit(patterns.substr(at, end - at))) return true;
    at = end + 1;
  }
  return false;
}

bool fits(std::string_view patterns, std::string_view text) {
  return patterns.empty() ||
         any_alternative(patterns, [&](std::string_view pattern) { return fits_whole(pattern, text); });
}

/// The patterns of statements by their first character, since programs may have a wrong line after another.
class StatementIndex {
 public:
  StatementIndex() {
    for (const ForeignForm& form : foreign_forms())
      if (form.is_statement)
        any_alternative(form.line, [&](std::string_view pattern) {
          const bool is_letter = pattern.front() < 'a' || pattern.front() > 'z';
          (is_letter ? by_first_[static_cast<unsigned char>(pattern.front())] : others_).push_back({pattern, &form});
          return false;
        });
  }

  const ForeignForm* find(std::string_view line) const {
    if (line.empty()) return nullptr;
    const ForeignForm* const first = find_in(by_first_[static_cast<unsigned char>(line.front())], line);
    const ForeignForm* const other = find_in(others_, line);
    return first && other ? std::min(first, other) : first ? first : other;
  }

 private:
  struct FormPattern {
    std::string_view pattern;
    const ForeignForm* form;
  };

  static const ForeignForm* find_in(const std::vector<FormPattern>& patterns, std::string_view line) {
    const auto found = std::find_if(patterns.begin(), patterns.end(),
                                    [&](const FormPattern& each) { return fits_whole(each.pattern, line); });
    return found == patterns.end() ? nullptr : found->form;
  }

  std::array<std::vector<FormPattern>, 256> by_first_;
  std::vector<FormPattern> others_;  ///< Those that start with a small letter.
};

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

const ForeignForm* foreign_form(DiagnosticId id, std::string_view line, std::size_t begin, std::size_t end) {
  if (line.size() > kLongestLine || begin >= end || end > line.size()) return nullptr;
  const auto concerns = [&](const ForeignForm& form) {
    return !form.keeps_message &&
           std::find(std::begin(form.diagnostics), std::end(form.diagnostics), id) != std::end(form.diagnostics);
  };
  const std::span<const ForeignForm> forms = foreign_forms();
  const auto first = std::find_if(forms.begin(), forms.end(), concerns);
  if (first == forms.end()) return nullptr;
  const std::string mark = canonical(line.substr(begin, end - begin));
  const std::string whole = canonical_line(line);
  for (const ForeignForm& form : forms.subspan(static_cast<std::size_t>(first - forms.begin())))
    if (concerns(form) && fits(form.mark, mark) && fits(form.line, whole)) return &form;
  return nullptr;
}

const ForeignForm* foreign_statement(std::string_view line) {
  static const StatementIndex kStatements;
  return line.size() > kLongestLine ? nullptr : kStatements.find(canonical_line(line));
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
