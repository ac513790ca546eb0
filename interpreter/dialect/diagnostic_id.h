#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::dialect {

/// Index of a row of the table of diagnostics. Created from a name only, so that every id is in the table.
enum class DiagnosticId : std::uint8_t {};

/// Value of a field that names no diagnostic.
inline constexpr DiagnosticId kNoDiagnostic{255};

/// The names in the order of the table. The build takes them from `diagnostic_table.cpp`, so that a changed text there
/// leaves this header as it is.
inline constexpr std::string_view kDiagnosticNames[] = {
#include <diagnostic_names.inc>
};

inline constexpr std::size_t kDiagnosticCount = std::size(kDiagnosticNames);
static_assert(kDiagnosticCount < 255);

/// The table, in `diagnostic_table.cpp`.
extern const DiagnosticDef kDiagnostics[kDiagnosticCount];

namespace detail {
/// Never defined: the call makes a misspelt name fail to compile.
void no_diagnostic_has_this_name();
}  // namespace detail

inline namespace literals {
/// `"head-not-selected"_diag`: a misspelt name does not compile.
consteval DiagnosticId operator""_diag(const char* name, std::size_t length) {
  for (std::size_t i = 0; i < kDiagnosticCount; ++i)
    if (kDiagnosticNames[i] == std::string_view(name, length)) return DiagnosticId{static_cast<std::uint8_t>(i)};
  detail::no_diagnostic_has_this_name();
  return kNoDiagnostic;
}
}  // namespace literals

inline const DiagnosticDef& definition(DiagnosticId id) { return kDiagnostics[static_cast<std::size_t>(id)]; }

/// The diagnostic with this code (`ISO012`, any case) or name (`head-not-selected`).
std::optional<DiagnosticId> find_diagnostic(std::string_view code_or_name);

/// The message in `language`, with `text` (the program text under the mark) and the values inserted.
std::string message(DiagnosticId id, Language language, std::string_view text, std::span<const double> values);

/// A value as messages show it: at most four decimals, no trailing zeros.
std::string format_value(double value);

/// `error`, `warning`, `info` (`errore`, `avviso`, `nota`).
std::string_view severity_name(Severity severity, Language language);

/// The explanation's first sentence, which can be read alone.
std::string_view first_sentence(std::string_view explanation);

}  // namespace isocnc::dialect
