#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "analyzer/check/report.h"
#include "analyzer/selection/selection.h"

namespace isocnc::selection {

/// What a program's comments say to isolint, and which findings it silences:
///
///     G01 X10 U5 ;isolint: ignore ISO003       this line
///     (isolint: disable W001, W002) ...        from this line on
///     (isolint: enable W001 W002)              up to the line above
///     ;isolint: ignore-file W003 -- a reason   the whole program
///
/// Without codes, all are meant but W190, which tells of a comment that changes nothing.
class Suppressions {
 public:
  Suppressions() = default;
  explicit Suppressions(std::string_view text);

  /// Whether some line of the text may say something to isolint: else none need be read.
  static bool may_have_directives(std::string_view text);
  /// Reads a line; each must lie below the one before. The constructor reads those of a whole text.
  void read_line(std::uint64_t number, std::string_view line);
  bool empty() const { return directives_.empty(); }
  /// The report less what is silenced, with what changes nothing (W190). A code that is off may not have been looked
  /// for: to silence it is never held against the comment.
  check::Report apply(check::Report report, const Selection& selection);

 private:
  enum class Kind : std::uint8_t { Ignore, Disable, Enable, IgnoreFile, Unknown };

  struct Code {
    std::optional<dialect::DiagnosticId> id;  ///< None when there is no such code.
    syntax::Span span;
    bool useful = false;
  };
  struct Directive {
    Kind kind = Kind::Unknown;
    std::uint64_t line = 0;
    syntax::Span span;
    std::vector<Code> codes;  ///< Empty: all.
    bool useful = false;
  };
  /// Which comment silences each code; null for none.
  using SuppressedBy = std::array<bool*, dialect::kDiagnosticCount>;

  void read_directive(std::uint64_t number, std::string_view line, std::uint32_t begin, std::uint32_t end);
  static void apply_disable(Directive& directive, SuppressedBy& suppressors);
  static void apply_enable(Directive& directive, SuppressedBy& suppressors);
  void drop_suppressed(std::vector<check::LocatedFinding>& findings);
  void keep_directives_for_disabled_codes(const Selection& selection);
  std::vector<check::LocatedFinding> useless(bool about_w190) const;

  std::vector<Directive> directives_;  // In the order of the program.
};

/// The report as the program's comments want it.
check::Report suppress(check::Report report, std::string_view text, const Selection& selection);

}  // namespace isocnc::selection
