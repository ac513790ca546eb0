#pragma once

#include "interpreter/execution/sink.h"

namespace isocnc::execution {

/// For who wants nothing of a block but the state behind it.
class SilentSink final : public Sink {
 public:
  SilentSink() : Sink(false) {}
  void report(const syntax::Finding&) override {}
};

}  // namespace isocnc::execution
