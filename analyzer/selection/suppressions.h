#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "analyzer/check/report.h"
#include "analyzer/selection/selection.h"

namespace isocnc::selection {

/// Whether a run of the machine has looked for a code that only runs report: on a line, or in the whole program.
using LookedFor = std::function<bool(dialect::DiagnosticId id, std::optional<std::size_t> line)>;

/// The directives for isolint in a program's comments, and the findings that they suppress:
///
///     G01 X10 U5 ;isolint: ignore ISO003       this line
///     (isolint: disable W001, W002) ...        from this line on
///     (isolint: enable W001 W002)              up to the line above
///     ;isolint: ignore-file W003 -- a reason   the whole program
///
/// Without codes, a directive means all codes except W190, which reports a directive without effect.
class Suppressions {
 public:
  Suppressions() = default;
  explicit Suppressions(std::string_view text);

  /// Fast test: whether the text may contain a directive for isolint.
  static bool may_have_directives(std::string_view text);
  /// Reads a line; lines must come in ascending order. The constructor reads those of a whole text.
  void read_line(std::size_t number, std::string_view line);
  bool empty() const { return directives_.empty(); }
  /// The report without suppressed findings, and with directives that have no effect (W190). W190 does not report
  /// directives for codes that are off, because those may not have been checked, nor for codes that only runs report,
  /// except what a run has looked for.
  check::Report apply(check::Report report, const Selection& selection, const LookedFor& by_run = {});

 private:
  enum class Kind : std::uint8_t { Ignore, Disable, Enable, IgnoreFile, Unknown };

  struct Code {
    std::optional<dialect::DiagnosticId> id;  ///< Nothing if the code is unknown.
    syntax::Span span;
    bool useful = false;
  };
  struct Directive {
    Kind kind = Kind::Unknown;
    std::size_t line = 0;
    syntax::Span span;
    std::vector<Code> codes;  ///< The codes named; empty: all.
    bool useful = false;
  };
  /// The directive that suppresses each code; null for none.
  using SuppressedBy = std::array<bool*, dialect::kDiagnosticCount>;

  void read_directive(std::size_t number, std::string_view line, std::uint32_t begin, std::uint32_t end);
  static void apply_disable(Directive& directive, SuppressedBy& suppressors);
  static void apply_enable(Directive& directive, SuppressedBy& suppressors);
  void drop_suppressed(std::vector<check::LocatedFinding>& findings);
  void keep_directives_for_unchecked_codes(const Selection& selection, const LookedFor& by_run);
  std::vector<check::LocatedFinding> useless(bool about_w190) const;

  std::vector<Directive> directives_;  // The directives, in the order of the program.
};

/// The report after applying the directives in the program's comments.
check::Report suppress(check::Report report, std::string_view text, const Selection& selection);

}  // namespace isocnc::selection
