#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/check/report.h"
#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::selection {

/// Which findings to report, from the command line or a configuration. Codes are written as `ISO031`, as
/// `arc-center-mismatch`, as a prefix of codes (`W1`) or as `ALL`; several are separated by commas. Case does not
/// matter.
struct SelectionOptions {
  std::vector<std::string> select;      ///< The only codes shown; empty: all that were shown before.
  std::vector<std::string> ignore;      ///< Codes not shown.
  std::vector<std::string> severities;  ///< Such as `W001=error`; `off` is also a severity.
};

/// Which codes are shown, and with which severity. Initially the table of diagnostics decides.
class Selection {
 public:
  Selection();

  /// Applies options on top of those applied before. For the same code the more specific entry wins; between equally
  /// specific ones, `ignore`, then the later severity. Returns error messages; if there are any, nothing has been
  /// applied.
  std::vector<std::string> follow(const SelectionOptions& options, dialect::Language language);

  /// Nothing if the code is off.
  std::optional<dialect::Severity> severity(dialect::DiagnosticId id) const {
    return severities_[static_cast<std::size_t>(id)];
  }
  /// The same for one finding: a house rule's own severity counts unless options have given its code one.
  std::optional<dialect::Severity> severity(const syntax::Finding& finding) const {
    const bool counts = finding.severity && shows(finding.id) && !weighed_[static_cast<std::size_t>(finding.id)];
    return counts ? finding.severity : severity(finding.id);
  }
  bool shows(dialect::DiagnosticId id) const { return severity(id).has_value(); }
  /// The report without findings that are off; each of the others has its selected severity.
  check::Report shown(check::Report report) const;

 private:
  std::array<std::optional<dialect::Severity>, dialect::kDiagnosticCount> severities_;
  std::array<bool, dialect::kDiagnosticCount> weighed_{};  ///< Whether options have given the code a severity.
};

/// `unknown code: ISO31; did you mean ISO031? (--list-rules)`
std::string unknown_code(std::string_view code, dialect::Language language);

}  // namespace isocnc::selection
