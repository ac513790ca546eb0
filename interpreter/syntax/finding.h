#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include "interpreter/dialect/diagnostic_id.h"

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

/// A problem of a line, as data: its kind, its place on the line and the values found. dialect::message() makes the
/// text when it is shown, in the user's language.
struct Finding {
  dialect::DiagnosticId id = dialect::kNoDiagnostic;
  Span span;
  Span related;  ///< A second place on the same line that explains the first (the first F of two); may be empty.
  std::array<double, dialect::kMaxArguments> values{};

  friend bool operator==(const Finding&, const Finding&) = default;
};

}  // namespace isocnc::syntax
