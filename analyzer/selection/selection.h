#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/check/report.h"
#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::selection {

/// What somebody wishes to be told: the command line, or a configuration. Codes are written as `ISO031`, as
/// `arc-center-mismatch`, as the beginning of codes (`W1` is all that begin so), or as `ALL`; several with commas
/// between them. Capitals do not matter.
struct SelectionOptions {
  std::vector<std::string> select;      ///< These alone; none is all that were shown before.
  std::vector<std::string> ignore;      ///< Not these.
  std::vector<std::string> severities;  ///< `W001=error`; `off` is a severity, too.
};

/// Which codes are shown, and how much each weighs. At first all are, by the table of diagnostics.
class Selection {
 public:
  Selection();

  /// Follows the wishes, which outweigh what was followed before. Of wishes for the same code, the one that names it
  /// more exactly decides; of two that are equally exact, `ignore`, and the later severity. Returns what is wrong with
  /// them, for people: then none has been followed.
  std::vector<std::string> follow(const SelectionOptions& options, dialect::Language language);

  /// None when the code is off.
  std::optional<dialect::Severity> severity(dialect::DiagnosticId id) const {
    return severities_[static_cast<std::size_t>(id)];
  }
  bool shows(dialect::DiagnosticId id) const { return severity(id).has_value(); }
  /// The report without findings that are off, and each of the others with its severity.
  check::Report shown(check::Report report) const;

 private:
  std::array<std::optional<dialect::Severity>, dialect::kDiagnosticCount> severities_;
};

/// `unknown code: ISO31; did you mean ISO031? (--list-rules)`
std::string unknown_code(std::string_view code, dialect::Language language);

}  // namespace isocnc::selection
