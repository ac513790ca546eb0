#pragma once

#include <cstdint>
#include <string_view>

namespace isocnc::dialect {

/// How much a finding weighs. `Error`: the control stops here. `Warning`: the control, or a machinist, would frown.
/// `Info`: something that the reader should know of the check itself.
enum class Severity : std::uint8_t { Error, Warning, Info };

/// The languages in which users are spoken to.
enum class Language : std::uint8_t { English, Italian };

/// One text in both languages.
struct Text {
  std::string_view en;
  std::string_view it;

  constexpr std::string_view in(Language language) const { return language == Language::Italian ? it : en; }
};

/// The most values that one message can name.
inline constexpr int kMaxArguments = 3;

/// One kind of finding, as it stands in the table of diagnostics: everything that is ever said about it.
///
/// `message` may name `{text}` (the program text under the finding's mark) and the values in `arguments`, by name.
struct DiagnosticDef {
  std::string_view code;  ///< `ISO012`, `E004`, `W001`: stable, what users select and suppress.
  std::string_view name;  ///< `head-not-selected`: stable, what our code and readers say.
  Severity severity = Severity::Error;
  bool is_off = false;                        ///< Shown only to who selects it.
  bool is_reported_by_runs = false;           ///< By isorun, which follows the tool; isolint does not find it.
  std::string_view section;                   ///< Of the specification, `I.4.3`.
  std::string_view arguments[kMaxArguments];  ///< Names of the values, in the order in which they are reported.
  Text title;                                 ///< A few words for lists.
  Text message;                               ///< One line, without a full stop.
  Text explanation;        ///< Why the control stops and what to do; the first sentence stands alone.
  std::string_view wrong;  ///< A program with this one finding; `[!` and `!]` enclose the marked text.
  std::string_view right;  ///< The same program, mended: no finding at all.
};

}  // namespace isocnc::dialect
