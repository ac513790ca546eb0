#pragma once

#include <cstddef>

#include "interpreter/simulation/run_findings.h"

namespace isocnc::documents {

/// What the last verification of a document has shown. While the document is edited, it stays with the lines that it is
/// about: lines below an edit take it along, and what is about lines whose text has changed is dropped.
class KeptRun {
 public:
  /// As many findings take no noticeable time after an edit.
  static constexpr std::size_t kMaxFindings = 10'000;

  /// Of a run with more findings, those that repeat a mistake are dropped first.
  explicit KeptRun(simulation::RunOutcome outcome);

  const simulation::RunOutcome& outcome() const { return outcome_; }
  /// The number of findings that were dropped, except those that repeat a mistake.
  std::size_t left_out() const { return left_out_; }
  /// Whether it is about the present text and settings.
  bool is_current() const { return is_current_; }
  /// The text or the settings have changed.
  void expire() { is_current_ = false; }

  /// Of the lines from `first` on, `removed` have been replaced by `inserted` others.
  void replace_lines(std::size_t first, std::size_t removed, std::size_t inserted);

 private:
  simulation::RunOutcome outcome_;
  std::size_t left_out_ = 0;
  bool is_current_ = true;
};

}  // namespace isocnc::documents
