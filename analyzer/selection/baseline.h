#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "analyzer/check/report.h"

namespace isocnc::selection {

/// Known findings that are not to be reported again. They are identified by fingerprint (fingerprint.h), so that edits
/// elsewhere in a program do not bring them back.
class Baseline {
 public:
  /// An empty baseline for `file`. Programs are named relative to its folder, so that the directory from which isolint
  /// is started does not matter.
  explicit Baseline(const std::filesystem::path& file);

  /// The baseline in a file, or the error in it: `FILE:LINE: reason`.
  static std::variant<Baseline, std::string> read(const std::filesystem::path& file, dialect::Language language);

  /// Adds the findings of a folded report, line by line.
  void add(std::string_view program, std::string_view text, const check::Report& report);
  /// The report without the findings that the baseline knows; not folded yet.
  check::Report without_known(check::Report report, std::string_view program, std::string_view text) const;
  std::string to_json() const;

 private:
  friend class BaselineReader;

  /// The number of findings per code and line text.
  using LineCounts = std::map<std::pair<dialect::DiagnosticId, std::uint64_t>, std::uint64_t>;

  std::string name_of(std::string_view program) const;

  std::filesystem::path folder_;
  std::map<std::string, LineCounts> programs_;
};

}  // namespace isocnc::selection
