#include "interpreter/dialect/diagnostic_id.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "interpreter/dialect/any_case.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/letters.h"

namespace isocnc::dialect {

std::optional<DiagnosticId> find_diagnostic(std::string_view code_or_name) {
  for (std::size_t i = 0; i < kDiagnosticCount; ++i)
    if (equal_words(kDiagnostics[i].code, code_or_name) || equal_words(kDiagnostics[i].name, code_or_name))
      return DiagnosticId{static_cast<std::uint8_t>(i)};
  return std::nullopt;
}

std::string format_value(double value) {
  constexpr double kHuge = 1e18;
  if (!std::isfinite(value)) return fmt::format("{}", value);
  if (std::abs(value) >= kHuge) return fmt::format("{:.6g}", value);
  std::string text = written_number(value, 4);
  // A value below the printed decimals must not read as 0.
  return text == "0" && value != 0 ? fmt::format("{:.3g}", value) : text;
}

std::string_view unit_of_length(bool is_in_inches, Language language) {
  static constexpr Text kInches = {"in", "pollici"};
  return is_in_inches ? kInches.in(language) : "mm";
}

std::string_view inches_note(bool is_in_inches, Language language) {
  static constexpr Text kNote = {" (inches)", " (pollici)"};
  return is_in_inches ? kNote.in(language) : std::string_view();
}

/// Shortens a long piece of program text, which would push the message off the screen; the mark shows it whole.
static std::string shortened(std::string_view text) {
  constexpr std::size_t kMaxShownBytes = 40;
  if (text.size() <= kMaxShownBytes) return std::string(text);
  std::size_t end = kMaxShownBytes - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return std::string(text.substr(0, end)) + "...";
}

/// Replaces invisible characters by their number: U+00A0.
static std::string spelled_out(std::string_view text) {
  struct Invisible {
    std::string_view bytes, name;
  };
  static constexpr Invisible kInvisible[] = {
      {"\xC2\xA0", "U+00A0"},     {"\xC2\xAD", "U+00AD"},     {"\xE2\x80\x89", "U+2009"}, {"\xE2\x80\x8B", "U+200B"},
      {"\xE2\x80\x8C", "U+200C"}, {"\xE2\x80\x8D", "U+200D"}, {"\xE2\x80\x8E", "U+200E"}, {"\xE2\x80\x8F", "U+200F"},
      {"\xE2\x80\xAF", "U+202F"}, {"\xE3\x80\x80", "U+3000"}, {"\xEF\xBB\xBF", "U+FEFF"},
  };
  std::string result;
  while (!text.empty()) {
    const auto invisible = std::find_if(std::begin(kInvisible), std::end(kInvisible),
                                        [&](const Invisible& it) { return text.starts_with(it.bytes); });
    if (invisible != std::end(kInvisible)) {
      result += invisible->name;
      text.remove_prefix(invisible->bytes.size());
      continue;
    }
    const auto byte = static_cast<unsigned char>(text.front());
    if (byte < 0x20 && byte != '\t') {
      result += fmt::format("U+{:04X}", byte);
    } else {
      result += text.front();
    }
    text.remove_prefix(1);
  }
  return result;
}

std::string quote(std::string_view text) { return spelled_out(shortened(text)); }

static std::string letter_at(std::string_view letters, double index) {
  return std::string(letters.substr(std::min(static_cast<std::size_t>(index), letters.size()), 1));
}

/// A value as a message shows it. The name of the argument says what it is: the number of an axis (`axis`,
/// `otheraxis`), of the center's coordinate on an axis (`center`), of a G (`g`), or a number.
static std::string shown_value(std::string_view name, double value) {
  if (name.ends_with("axis")) return letter_at(kAxisLetters, value);
  if (name.ends_with("center")) return letter_at("IJK", value);
  if (name == "g") return fmt::format("G{:02}", static_cast<int>(value));
  return format_value(value);
}

std::size_t cause_count(const DiagnosticDef& def) {
  const auto is_unused = [](const CauseDef& cause) { return cause.cause.empty(); };
  return 1 + static_cast<std::size_t>(std::find_if(std::begin(def.causes), std::end(def.causes), is_unused) -
                                      std::begin(def.causes));
}

const Text& message_text(Cause cause) {
  const DiagnosticDef& def = definition(cause.id);
  return cause.number == 0 ? def.message : def.causes[cause.number - 1].message;
}

std::string message(Cause cause, Language language, const Quoted& quoted) {
  const DiagnosticDef& def = definition(cause.id);
  const std::string_view pattern = message_text(cause).in(language);
  std::string result;
  result.reserve(pattern.size() + 32);
  for (std::size_t at = 0; at < pattern.size();) {
    const std::size_t open = pattern.find('{', at);
    const std::size_t close = open == std::string_view::npos ? std::string_view::npos : pattern.find('}', open);
    if (close == std::string_view::npos) return result.append(pattern.substr(at));
    result.append(pattern.substr(at, open - at));
    const std::string_view name = pattern.substr(open + 1, close - open - 1);
    if (name == "text") result.append(quote(quoted.text));
    if (name == "other") result.append(quote(quoted.other));
    if (name == "unit") result.append(unit_of_length(quoted.is_in_inches, language));
    if (name == "inches") result.append(inches_note(quoted.is_in_inches, language));
    if (name == "who" && !quoted.names.empty()) result.append(quote(quoted.names[0].in(language)));
    if (name == "whom" && quoted.names.size() > 1) result.append(quote(quoted.names[1].in(language)));
    if (name == "said" && quoted.names.size() > 1) result.append(spelled_out(quoted.names[1].in(language)));
    for (std::size_t i = 0; i < quoted.values.size() && i < kMaxArguments; ++i)
      if (def.arguments[i] == name) result.append(shown_value(name, quoted.values[i]));
    at = close + 1;
  }
  return result;
}

std::string_view severity_name(Severity severity, Language language) {
  static constexpr Text kNames[] = {{"error", "errore"}, {"warning", "avviso"}, {"info", "nota"}};
  return kNames[static_cast<std::size_t>(severity)].in(language);
}

std::string_view first_sentence(std::string_view explanation) {
  for (std::size_t at = explanation.find(". "); at != std::string_view::npos; at = explanation.find(". ", at + 1)) {
    const char next = explanation[at + 2];
    const bool abbreviation = at >= 3 && explanation.substr(at - 3, 3) == "e.g";
    if (!abbreviation && !(next >= 'a' && next <= 'z')) return explanation.substr(0, at + 1);
  }
  return explanation;
}

}  // namespace isocnc::dialect
