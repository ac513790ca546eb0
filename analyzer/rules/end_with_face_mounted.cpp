#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// M02 without G27 before it.
static void check_end_with_face_mounted(const ExecutedBlock& block, execution::Sink& sink) {
  const syntax::Word* const end = block.m(dialect::kProgramEnd);
  if (end && block.after.face_mounted && !block.after.is_in_doubt(dialect::ModalGroup::Face))
    report(sink, "end-with-face-mounted"_diag, end->span());
}

extern const Rule end_with_face_mounted = {kFunction, check_end_with_face_mounted};

}  // namespace isocnc::rules
