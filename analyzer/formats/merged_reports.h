#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::formats {

/// A report that isolint has written of a part of the files, as --format json or sarif.
struct ReportFile {
  std::string name;
  std::string_view text;
};

/// The report of all files, to the byte as if they had been checked together, and the number of its findings.
struct MergedReport {
  std::string text;
  std::size_t files = 0;  ///< Files with findings; in SARIF all files.
  std::size_t errors = 0;
  std::size_t warnings = 0;
  std::size_t infos = 0;
};

/// Joins reports of one format; or returns the reason why they cannot be joined, with the name of the file. A finding
/// that several reports have is in the result once.
std::variant<MergedReport, std::string> merge_reports(std::span<const ReportFile> reports, dialect::Language language);

}  // namespace isocnc::formats
