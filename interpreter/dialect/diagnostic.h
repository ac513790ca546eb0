#pragma once

#include <cstdint>
#include <string_view>

namespace isocnc::dialect {

/// Severity of a finding. `Error`: the control stops here. `Warning`: legal, but the control or a machinist would
/// object. `Info`: a fact about the check itself.
enum class Severity : std::uint8_t { Error, Warning, Info };

/// The languages of all texts for users.
enum class Language : std::uint8_t { English, Italian };

/// One text in both languages.
struct Text {
  std::string_view en;
  std::string_view it;

  constexpr std::string_view in(Language language) const { return language == Language::Italian ? it : en; }
};

/// A mistake whose consequence repeats line after line until something that matters to it changes. The findings that it
/// causes are shown as one (D66).
enum class FoldKind : std::uint8_t {
  None,
  FiveAxes,         ///< G49 is missing. Ends where G48 or G49 is written.
  InverseTimeFeed,  ///< Under G93 feed moves lack their F. Ends at one that has it, and where G93 or G94 is written.
  IgnoredFeed,      ///< Under G93 F stands without a feed move. Ends likewise.
};
inline constexpr int kFoldCount = 4;

/// What shows a finding.
enum class Evidence : std::uint8_t {
  Text,   ///< The text of the program.
  Run,    ///< A run alone: of isorun, or of isolint with --verify.
  Scene,  ///< A run in a setup, or with bodies of the machine.
  Stock,  ///< A run in a setup that describes a stock.
};

/// Maximum number of values in one message.
inline constexpr int kMaxArguments = 6;

/// Maximum number of names from outside the program in one message.
inline constexpr int kMaxGivenNames = 2;

/// Maximum number of causes of one code that have a message of their own, beside the usual one.
inline constexpr int kMaxCauses = 7;

/// A cause of a finding with a message of its own, where one text could not say what to write.
struct CauseDef {
  std::string_view cause;  ///< `no-motion`: unique within its code; used in the code.
  Text message;            ///< As DiagnosticDef::message.
  std::string_view wrong;  ///< As DiagnosticDef::wrong: a program with one finding, of this cause.
};

/// One kind of finding: a row of the table of diagnostics, with all its texts.
///
/// A message may name `{text}` (the program text under the finding's mark), `{other}` (that under its second mark), the
/// values in `arguments` by name, and `{who}` and `{whom}`, the names from outside the program that it brings along;
/// `{said}` is the second of them in full, a sentence of the configuration.
/// After a length of a run `{unit}` is its unit, `mm` or, where the block is under G70, `in`; `{inches}` stands where
/// none is needed but there, and is empty or ` (inches)`.
struct DiagnosticDef {
  std::string_view code;  ///< `ISO012`, `E004`, `W001`: stable; used in selections and suppressions.
  std::string_view name;  ///< `head-not-selected`: stable; used in the code and by readers.
  Severity severity = Severity::Error;
  bool is_off = false;  ///< Reported only if selected by the user.
  Evidence evidence = Evidence::Text;
  FoldKind folds = FoldKind::None;            ///< The mistake that may repeat it on the lines below.
  std::string_view section;                   ///< Section of the specification: `I.4.3`.
  std::string_view arguments[kMaxArguments];  ///< Names of the values, in the order in which they are reported.
  Text title;                                 ///< A few words for lists.
  Text message;                               ///< One line, without a full stop; of the usual cause.
  CauseDef causes[kMaxCauses] = {};           ///< The other causes; those without a name are unused.
  Text explanation;        ///< Why the control stops and what to do; the first sentence can be read alone.
  std::string_view wrong;  ///< A program with this one finding; `[!` and `!]` enclose the marked text.
  std::string_view right;  ///< The same program, corrected; it has no finding.

  constexpr bool is_reported_by_runs() const { return evidence != Evidence::Text; }
};

}  // namespace isocnc::dialect
