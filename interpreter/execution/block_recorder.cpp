#include "interpreter/execution/block_recorder.h"

#include <algorithm>

namespace isocnc::execution {

BlockRecorder::BlockRecorder(const syntax::LineTree& line, const State& before, const Setup& setup)
    : Sink(true), state_(before), findings_(line.findings.begin(), line.findings.end()) {
  execute(line, state_, setup, *this);
}

bool BlockRecorder::has_error() const {
  return std::any_of(findings_.begin(), findings_.end(), [](const syntax::Finding& finding) {
    return dialect::definition(finding.id).severity == dialect::Severity::Error;
  });
}

}  // namespace isocnc::execution
