#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/foreign_form.h"
#include "interpreter/dialect/given_name.h"

namespace isocnc::syntax {

/// A range of one line's text: byte columns from 0, end exclusive.
struct Span {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  constexpr bool empty() const { return begin == end; }
  constexpr bool holds(std::uint32_t column) const { return begin <= column && column < end; }
  friend constexpr auto operator<=>(const Span&, const Span&) = default;
};

/// The smallest span that holds both.
constexpr Span hull(Span a, Span b) { return {a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end}; }

/// A problem of a line, as data: its kind, its place on the line and the values found. message() makes the text when it
/// is shown, in the user's language.
struct Finding {
  dialect::DiagnosticId id = dialect::kNoDiagnostic;
  std::uint8_t cause = 0;  ///< Selects the message, dialect::Cause::number.
  /// The values that are lengths are in inches, as the program has them under G70; else in mm.
  bool is_in_inches = false;
  std::optional<dialect::Severity> severity;  ///< Where the author of a rule has chosen one; else that of the table.
  Span span;
  Span related;  ///< A second place on the same line that explains the first (the first F of two); may be empty.
  std::array<double, dialect::kMaxArguments> values{};
  std::array<dialect::GivenName, dialect::kMaxGivenNames> names{};  ///< From outside the program; the first ones count.
  dialect::GivenPlace described;  ///< Where a file beside the program describes what the finding names.

  bool has(dialect::Cause wanted) const { return id == wanted.id && cause == wanted.number; }

  friend bool operator==(const Finding&, const Finding&) = default;
};

/// A finding of this cause.
inline Finding finding_of(dialect::Cause cause, Span span, std::initializer_list<double> values = {},
                          Span related = {}) {
  Finding finding{.id = cause.id, .cause = cause.number, .span = span, .related = related};
  std::copy(values.begin(), values.end(), finding.values.begin());
  return finding;
}

/// The form of other controls that a finding of this line shows, or null.
inline const dialect::ForeignForm* foreign_form(const Finding& finding, std::string_view line) {
  return dialect::foreign_form(finding.id, line, finding.span.begin, finding.span.end);
}

/// The message of a finding of this line.
inline std::string message(const Finding& finding, std::string_view line, dialect::Language language) {
  if (const dialect::ForeignForm* const form = foreign_form(finding, line))
    return dialect::message(*form, language, line, finding.span.begin, finding.span.end);
  const auto text_of = [&](Span span) {
    return line.substr(std::min<std::size_t>(span.begin, line.size()), span.end - span.begin);
  };
  return dialect::message({finding.id, finding.cause}, language,
                          {.text = text_of(finding.span),
                           .other = text_of(finding.related),
                           .values = finding.values,
                           .names = finding.names,
                           .is_in_inches = finding.is_in_inches});
}

}  // namespace isocnc::syntax
