#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "analyzer/check/outcome.h"
#include "analyzer/check/report.h"
#include "interpreter/execution/sink.h"

namespace isocnc::check {

/// The folds that a step of a block ends: what matters to them changes.
constexpr FoldSet folds_ended_by(execution::BlockStep step) {
  using execution::BlockStep;
  if (step == BlockStep::InterpolationMode) return fold_bit(dialect::FoldKind::FiveAxes);
  const bool concerns_feed = step == BlockStep::InverseTimeFeed || step == BlockStep::FeedMode;
  return concerns_feed ? fold_bit(dialect::FoldKind::InverseTimeFeed) | fold_bit(dialect::FoldKind::IgnoredFeed) : 0;
}

/// Numbers the mistakes behind the findings of consecutive outcomes. Findings have the same number if their codes fold
/// alike, the same paths lead to them, and no line between them ends the fold (D66).
class MistakeNumbers {
 public:
  /// The next outcome; number() follows for each of its findings, then finish().
  void start(const Outcome& outcome);
  /// The number of the mistake behind a finding with this line and path in the outcome; -1 if it stands for itself.
  std::int32_t number(std::size_t line, dialect::DiagnosticId id, std::int32_t path);
  void finish();

 private:
  /// A mistake that may have more findings below.
  struct Open {
    Decisions path;
    std::int32_t number = 0;
    std::size_t line = 0;  ///< Of its last finding, counted in `outcome_`.
    const Outcome* outcome = nullptr;
  };

  void end_folds_up_to(std::size_t line);

  const Outcome* outcome_ = nullptr;
  std::size_t next_end_ = 0;
  std::array<std::vector<Open>, dialect::kFoldCount> open_;
  std::int32_t count_ = 0;
};

/// Folds findings: of each mistake and severity the first is kept, and the later ones become its repetitions.
class Folder {
 public:
  static constexpr std::size_t kLeftOut = std::numeric_limits<std::size_t>::max() - 1;

  /// Adds repetitions to `report`, and to its findings.
  explicit Folder(Report& report) : report_(report) {}

  /// Returns whether the finding repeats one before it. Otherwise the caller keeps it as `report.findings[index]`, or
  /// nowhere, with kLeftOut. Must be called in the order of the lines.
  bool fold(const LocatedFinding& located, dialect::Severity severity, std::size_t index) {
    return fold(located.mistake, {located.line, located.finding.id, located.finding.span}, severity, index);
  }
  /// The same for a finding of this mistake, which would be this repetition.
  bool fold(std::int32_t mistake, const Repetition& repetition, dialect::Severity severity, std::size_t index);

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  Report& report_;
  std::vector<std::array<std::size_t, 3>> firsts_;  // The index of the first finding, by mistake and severity.
};

/// The report with one finding for each mistake and severity. Leave out what is not shown before.
Report folded(Report report);
/// The first repetition of a finding on this line or below; null if there is none.
const Repetition* repetition_from(std::size_t line, const LocatedFinding& located, const Report& report);
/// The number of findings in folded(report).
std::size_t folded_size(const Report& report);

}  // namespace isocnc::check
