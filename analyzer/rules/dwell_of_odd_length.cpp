#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// G04 P0, and a P long enough to have been meant in milliseconds.
static void check_dwell_of_odd_length(const ExecutedBlock& block, execution::Sink& sink) {
  if (!block.g(GRole::Dwell)) return;
  for (const syntax::Word& word : block.line.words)
    if (word.letter == 'P' && word.owner != syntax::Word::kNoOwner &&
        (word.value == 0 || word.value > block.thresholds.longest_dwell))
      report(sink, "dwell-of-odd-length"_diag, word.span(), word.value);
}

extern const Rule dwell_of_odd_length = {kModal, check_dwell_of_odd_length};

}  // namespace isocnc::rules
