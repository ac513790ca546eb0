#include "analyzer/rules/rule.h"

namespace isocnc::analyzer::rules {

/// G04 P0, and a P so long that milliseconds may have been meant.
static void check(const Block& block, execution::Sink& sink) {
  constexpr double kLong = 120;
  if (!block.g(4)) return;
  for (const syntax::Word& word : block.line.words)
    if (word.letter == 'P' && word.owner != syntax::Word::kNobody && (word.value == 0 || word.value > kLong))
      report(sink, "dwell-of-odd-length"_diag, word.span(), word.value);
}

extern const Rule dwell_of_odd_length = {kModal, check};

}  // namespace isocnc::analyzer::rules
