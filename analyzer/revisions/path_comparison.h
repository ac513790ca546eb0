#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/revisions/revision_comparison.h"

namespace isocnc::revisions {

/// Two revisions, compared for each combination of paths that values of VGPL lead them along.
struct PathComparison {
  /// An error that ends a run before the end of its program.
  struct StoppedRun {
    std::string_view code;
    std::size_t line = 0;  ///< From 0.
  };
  /// Both programs on one path each.
  struct ComparedPaths {
    std::string values;  ///< The values of VGPL that lead there: `VGPL < 1, VGPL > 2`; empty for all.
    double vgpl = 0;     ///< The one that both have been run with.
    bool is_same = false;
    std::optional<StoppedRun> stop;  ///< Of the old program.
    std::string text;                ///< What differs, as text_of() writes it.
    nlohmann::ordered_json json;     ///< And as json_of().
  };

  std::vector<ComparedPaths> paths;
  std::string not_compared;    ///< Values of VGPL that have not been tried, since there are too many.
  std::vector<int> registers;  ///< Those that an IF compares though neither the program nor the caller has set them.

  /// Whether all that has been compared is the same.
  bool is_same() const;
  /// Whether there is nothing else that an IF might tell apart.
  bool is_complete() const { return not_compared.empty() && registers.empty(); }
};

/// Compares on every path, beginning with that of `options.run.vgpl`, up to selection::kMaxVerifiedPaths combinations.
/// `set_registers` are those to which the caller has given a value, one bit each (check::register_bit).
PathComparison compare_on_paths(const RevisionPair& pair, const CompareOptions& options, std::uint32_t set_registers,
                                const comparison::TextStyle& style);

/// For people. Combinations with the same text stand together.
std::string text_of(const PathComparison& compared, const comparison::TextStyle& style);

/// As one line of JSON, with its line end (docs/isodiff.md).
std::string json_of(const PathComparison& compared);

}  // namespace isocnc::revisions
