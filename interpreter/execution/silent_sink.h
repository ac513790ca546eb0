#pragma once

#include "interpreter/execution/sink.h"

namespace isocnc::execution {

/// Discards all effects and findings; for callers that need only the state after a block.
class SilentSink final : public Sink {
 public:
  SilentSink() : Sink(false) {}
  void report(const syntax::Finding&) override {}
};

}  // namespace isocnc::execution
