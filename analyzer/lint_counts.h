#pragma once

#include <cstddef>
#include <string>

#include "analyzer/check/report.h"
#include "analyzer/command_line.h"
#include "interpreter/system/exit_status.h"

namespace isocnc::analyzer {

/// The numbers of a summary.
struct LintCounts {
  std::size_t errors = 0;
  std::size_t warnings = 0;
  std::size_t infos = 0;
  std::size_t files = 0;
  std::size_t known = 0;  ///< Findings that the baseline knows.
  std::size_t fixed = 0;

  void add(const check::Report& report);
  LintCounts& operator+=(const LintCounts& other);
};

/// The number of fixed findings, such as `3 fixed`.
std::string fixed_in_words(std::size_t fixed, const LintCommandOptions& options);
/// `2 errors, 1 warning in 3 files`
std::string summary_of(const LintCounts& counts, const LintCommandOptions& options);
/// The status that these findings give, after an error message if there are too many warnings.
system::ExitStatus status_of(const LintCounts& counts, const LintCommandOptions& options);

}  // namespace isocnc::analyzer
