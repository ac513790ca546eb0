#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/dialect/given_name.h"

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

/// The other causes, as `stray-argument/no-motion`, in the order of the table.
inline constexpr std::string_view kCauseNames[] = {
#include <cause_names.inc>
};

/// A diagnostic, and which of its messages tells what to do about it.
struct Cause {
  DiagnosticId id = kNoDiagnostic;
  std::uint8_t number = 0;  ///< 0: the usual cause; else an index into DiagnosticDef::causes, plus 1.

  // NOLINTNEXTLINE(google-explicit-constructor): a diagnostic alone stands for its usual cause.
  constexpr Cause(DiagnosticId diagnostic, std::uint8_t cause = 0) : id(diagnostic), number(cause) {}

  friend bool operator==(const Cause&, const Cause&) = default;
};

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

/// `"stray-argument/no-motion"_cause`: a misspelt name does not compile.
consteval Cause operator""_cause(const char* name, std::size_t length) {
  const std::string_view wanted(name, length);
  const std::string_view diagnostic = wanted.substr(0, wanted.find('/') + 1);
  std::uint8_t number = 0;
  for (const std::string_view each : kCauseNames) {
    if (each.starts_with(diagnostic)) ++number;
    if (each == wanted) return {operator""_diag(name, diagnostic.size() - 1), number};
  }
  detail::no_diagnostic_has_this_name();
  return kNoDiagnostic;
}
}  // namespace literals

inline const DiagnosticDef& definition(DiagnosticId id) { return kDiagnostics[static_cast<std::size_t>(id)]; }

/// The diagnostic with this code (`ISO012`, any case) or name (`head-not-selected`).
std::optional<DiagnosticId> find_diagnostic(std::string_view code_or_name);

/// Number of causes of a diagnostic, the usual one included.
std::size_t cause_count(const DiagnosticDef& def);

/// The message of a cause, without what it quotes.
const Text& message_text(Cause cause);

/// Program text as messages quote it: shortened, and with names for invisible characters.
std::string quote(std::string_view text);

/// What a message quotes.
struct Quoted {
  std::string_view text = {};   ///< The program text under the finding's mark.
  std::string_view other = {};  ///< That under its second mark.
  std::span<const double> values = {};
  std::span<const GivenName> names = {};  ///< `{who}` and `{whom}`.
  bool is_in_inches = false;              ///< What `{unit}` and `{inches}` say.
};

/// The message of a cause in `language`.
std::string message(Cause cause, Language language, const Quoted& quoted);

/// A value as messages show it: at most four decimals, no trailing zeros.
std::string format_value(double value);

/// `mm`; under G70 `in` (`pollici`).
std::string_view unit_of_length(bool is_in_inches, Language language);

/// Empty; under G70 ` (inches)`.
std::string_view inches_note(bool is_in_inches, Language language);

/// `error`, `warning`, `info` (`errore`, `avviso`, `nota`).
std::string_view severity_name(Severity severity, Language language);

/// The explanation's first sentence, which can be read alone.
std::string_view first_sentence(std::string_view explanation);

}  // namespace isocnc::dialect
