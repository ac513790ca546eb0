#pragma once

#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "interpreter/comparison/comparison.h"
#include "interpreter/dialect/diagnostic.h"

namespace isocnc::comparison {

/// The name of the kind in JSON: `moved`.
std::string_view name_of(ChangeKind kind);

/// What has changed, in words: `moved by up to 0.2 mm`.
std::string in_words(const BehaviorChange& change, dialect::Language language);

/// Two compared runs.
struct ComparedRuns {
  const RecordedRun& old_run;
  const RecordedRun& new_run;
  std::span<const BehaviorChange> changes;
};

/// How text is written for people.
struct TextStyle {
  dialect::Language language = dialect::Language::English;
  bool color = false;  ///< By escape sequences of terminals.

  /// The sequence, or nothing without colors.
  std::string_view paint(std::string_view sequence) const { return color ? sequence : std::string_view(); }
};

inline constexpr std::string_view kReset = "\x1b[0m";
inline constexpr std::string_view kBold = "\x1b[1m";

/// Seconds to a tenth and millimeters to a thousandth; smaller differences are not shown.
bool shows_seconds(double difference);
bool shows_mm(double difference);

/// The changes for people, a line each, grouped by tool and operation in the order of the run. An operation is what
/// stands between two tool changes.
std::string changes_text(const ComparedRuns& runs, const TextStyle& style);
/// The totals that differ, a line each: cycle time, lengths of paths, extents.
std::string totals_text(const ComparedRuns& runs, dialect::Language language);
/// Where both programs stop, which ends the comparison; empty if they do not.
std::string stop_text(const ComparedRuns& runs, dialect::Language language);
/// The number of changes, or that there is none; a line.
std::string count_text(const ComparedRuns& runs, const TextStyle& style);

/// The changes as JSON (docs/isodiff.md).
nlohmann::ordered_json changes_json(const ComparedRuns& runs, dialect::Language language);
/// A run as JSON: its cycle time, lengths, extents and tools.
nlohmann::ordered_json run_json(const RecordedRun& run);
/// Both runs and their changes as one line of JSON, with its line end.
std::string json_of(const ComparedRuns& runs, dialect::Language language);

}  // namespace isocnc::comparison
