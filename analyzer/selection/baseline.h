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

/// Findings that were there before somebody began to mind them, and are not to be reported again. They are recognized
/// as fingerprints are (fingerprint.h), so that edits elsewhere in a program do not bring them back.
class Baseline {
 public:
  /// A baseline that will stand in `file`: programs are named from its folder, so that it does not matter where
  /// isolint is started.
  explicit Baseline(const std::filesystem::path& file);

  /// What a file holds, or what is wrong with it: `FILE:LINE: reason`.
  static std::variant<Baseline, std::string> read(const std::filesystem::path& file, dialect::Language language);

  void add(std::string_view program, std::string_view text, const check::Report& report);
  /// The report less the findings that the baseline knows.
  check::Report without_known(check::Report report, std::string_view program, std::string_view text) const;
  std::string to_json() const;

 private:
  friend class BaselineReader;

  /// How many findings of a code there are on lines of one text.
  using Counts = std::map<std::pair<dialect::DiagnosticId, std::uint64_t>, std::uint64_t>;

  std::string name_of(std::string_view program) const;

  std::filesystem::path folder_;
  std::map<std::string, Counts> programs_;
};

}  // namespace isocnc::selection
