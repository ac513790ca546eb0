#include "analyzer/lint_counts.h"

#include <string_view>

#include <fmt/format.h>

#include "analyzer/lint_output.h"

namespace isocnc::analyzer {

using dialect::Language;

void LintCounts::add(const check::Report& report) {
  for (const check::LocatedFinding& located : report.findings) {
    switch (located.severity()) {
      case dialect::Severity::Error:
        ++errors;
        break;
      case dialect::Severity::Warning:
        ++warnings;
        break;
      case dialect::Severity::Info:
        ++infos;
        break;
    }
  }
}

LintCounts& LintCounts::operator+=(const LintCounts& other) {
  errors += other.errors;
  warnings += other.warnings;
  infos += other.infos;
  files += other.files;
  known += other.known;
  fixed += other.fixed;
  return *this;
}

std::string fixed_in_words(std::size_t fixed, const LintCommandOptions& options) {
  const bool italian = options.reader_language() == Language::Italian;
  if (options.diff) return fmt::format("{} {}", fixed, italian ? "correggibili" : "would be fixed");
  return fmt::format("{} {}", fixed, italian ? (fixed == 1 ? "corretto" : "corretti") : "fixed");
}

std::string summary_of(const LintCounts& counts, const LintCommandOptions& options) {
  const bool italian = options.reader_language() == Language::Italian;
  const auto plural = [](std::size_t n, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
  };
  std::string line =
      italian ? plural(counts.errors, "errore", "errori") + ", " + plural(counts.warnings, "avviso", "avvisi")
              : plural(counts.errors, "error", "errors") + ", " + plural(counts.warnings, "warning", "warnings");
  if (counts.infos > 0) line += ", " + plural(counts.infos, italian ? "nota" : "note", italian ? "note" : "notes");
  line += " in " + plural(counts.files, "file", italian ? "file" : "files");
  if (!options.baseline.empty())
    line += fmt::format("; {} {}", counts.known, italian ? "nella baseline" : "in the baseline");
  if (options.fix || options.diff) line += "; " + fixed_in_words(counts.fixed, options);
  return line;
}

system::ExitStatus status_of(const LintCounts& counts, const LintCommandOptions& options) {
  const bool too_many = options.max_warnings && counts.warnings > *options.max_warnings;
  if (options.exit_zero) return system::ExitStatus::Success;
  if (too_many)
    complain(options.reader_language() == Language::Italian
                 ? fmt::format("troppi avvisi: {}, ammessi {}", counts.warnings, *options.max_warnings)
                 : fmt::format("too many warnings: {}, and {} allowed", counts.warnings, *options.max_warnings));
  return too_many || counts.errors > 0 ? system::ExitStatus::Findings : system::ExitStatus::Success;
}

}  // namespace isocnc::analyzer
