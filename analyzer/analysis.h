#pragma once

#include <cstdint>
#include <vector>

#include "analyzer/checker.h"
#include "interpreter/syntax/document.h"

namespace isocnc::analyzer {

/// The check of a document that is being edited. It remembers where the check stood before each chunk of lines; after
/// an edit it checks the chunks that changed, and those behind them until it stands where it stood before. The report
/// is the one that a fresh check would give.
class Analysis {
 public:
  /// Both must outlive the analysis.
  Analysis(const syntax::Document& document, const execution::Setup& setup);

  /// Brings the analysis up to date with the document, whatever has been edited.
  void update();
  Report report() const;
  /// Where the check stands before a line, with the states of all paths through it.
  Frontier frontier_before(std::size_t line) const;
  /// Lines executed by the last update: what an edit costs.
  std::uint64_t lines_checked() const { return lines_checked_; }

 private:
  struct Checked {
    std::uint64_t version = 0;  ///< Of the document's chunk.
    Frontier before;
    Outcome outcome;  ///< Lines counted from the start of the chunk.
  };

  JumpMap find_jumps() const;

  const syntax::Document& document_;
  const execution::Setup& setup_;
  JumpMap jumps_;
  std::vector<Checked> chunks_;
  Frontier end_;
  std::uint64_t lines_checked_ = 0;
};

}  // namespace isocnc::analyzer
