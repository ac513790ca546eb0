#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// An F on a line with G00, which ignores it (I.3.7, D43); in G93 W003 reports it.
static void check_feed_on_rapid(const ExecutedBlock& block, execution::Sink& sink) {
  const syntax::LineTree& line = block.line;
  if (line.feed < 0 || !block.motion() || block.motion()->is_feed_move() || block.after.inverse_time()) return;
  const syntax::Word& feed = line.words[static_cast<std::size_t>(line.feed)];
  if (feed.value > 0) report(sink, "feed-on-rapid"_diag, feed.span());
}

extern const Rule feed_on_rapid = {kMotion, check_feed_on_rapid};

}  // namespace isocnc::rules
