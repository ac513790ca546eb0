#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic_id.h"

/// What programs for other controls write: words and statements that this control reads otherwise, or not at all.
namespace isocnc::dialect {

enum class ForeignControl : std::uint8_t { Fanuc, Siemens, Heidenhain, LinuxCnc, Mach };
inline constexpr std::string_view kForeignControlNames[] = {"Fanuc", "Siemens", "Heidenhain", "LinuxCNC", "Mach"};
inline constexpr std::size_t kForeignControlCount = std::size(kForeignControlNames);

/// A set of controls, one bit each.
using ForeignControls = std::uint8_t;
constexpr ForeignControls bit(ForeignControl control) {
  return static_cast<ForeignControls>(1u << static_cast<unsigned>(control));
}

/// Where the examples of a form stand in a program.
enum class ExamplePlace : std::uint8_t {
  Middle,  ///< With a tool, the spindle on, a position and an F.
  Start,   ///< Before the tool change.
  Change,  ///< In place of the tool change.
  End,     ///< In place of the end of the program.
};

/// A word or statement of other controls, and what this control has instead.
///
/// `mark` and `line` are patterns of the text under the finding's mark, and of its whole line; an empty one fits any
/// text. They are compared in capitals and without comments, leading zeros, the line's number, and blanks except those
/// between two letters. Alternatives are separated by `|`. Small letters stand for text:
///
///     n  a number             c  centers: I5 J0         w  letters, digits and _
///     i  digits               g  several Gs             x  anything, also nothing
///     d  one digit            z  axes: X0 Z0 U0
struct ForeignForm {
  /// The findings that it gives; none for a form that this control runs, with another meaning.
  DiagnosticId diagnostics[3] = {kNoDiagnostic, kNoDiagnostic, kNoDiagnostic};
  std::string_view mark;
  std::string_view line;
  /// The finding's own message names the form already.
  bool keeps_message = false;
  /// The mark is a part of what the message should show: the `=` of `R1=5`.
  bool is_part = false;
  /// `line` is a whole statement, which the parser reports as one.
  bool is_statement = false;
  /// It may move the tool or the zero point, or run lines that do.
  bool may_move = false;
  /// Other controls need it to say what always holds here, or to end what does not exist here: it may be left out.
  bool is_superfluous = false;
  ForeignControls controls = 0;
  ExamplePlace place = ExamplePlace::Middle;
  std::string_view written;  ///< An example: a line with this finding only.
  std::string_view instead;  ///< What to write for it here, one or more lines; may be empty.
  Text there;                ///< What it does there: a verb with its object.
  Text here;                 ///< What this control has instead: a sentence without a full stop.

  constexpr bool runs_here() const { return diagnostics[0] == kNoDiagnostic; }
};

/// All forms; of those that fit a finding, the first counts. In foreign_form_table.cpp.
std::span<const ForeignForm> foreign_forms();

/// The alternatives of `mark` or `line`.
std::vector<std::string_view> alternatives(std::string_view patterns);

/// The form of other controls that a finding shows, or null. The finding marks the bytes from `begin` to `end` of the
/// line.
const ForeignForm* foreign_form(DiagnosticId id, std::string_view line, std::size_t begin, std::size_t end);

/// The statement of other controls that a line consists of, or null.
const ForeignForm* foreign_statement(std::string_view line);

/// The message of a finding that shows a form.
std::string message(const ForeignForm& form, Language language, std::string_view line, std::size_t begin,
                    std::size_t end);

/// The controls that have a form: `Fanuc and Siemens`, `Fanuc and others`.
std::string controls_of(const ForeignForm& form, Language language);

}  // namespace isocnc::dialect
