#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// The plane, the frame or the tool changes while G41 or G42 is in force.
static void check_compensation_across_change(const Block& block, execution::Sink& sink) {
  if (!block.compensated()) return;
  const double mode = block.before.mode(dialect::ModalGroup::CutterCompensation);
  const syntax::Word* const ended = block.g(40);
  const auto report_change = [&](const syntax::Word& word) {
    if (!ended || ended->begin > word.begin) report(sink, "compensation-across-change"_diag, word.span(), mode);
  };
  if (const syntax::Word* const change = block.m(dialect::kToolChange)) return report_change(*change);
  for (const int frame : {24, 27, 28, 29, 92}) {
    if (frame == 27 && !block.before.face_mounted) continue;  // W002 reports this G27, which has no effect.
    if (const syntax::Word* const word = block.g(frame)) return report_change(*word);
  }
  for (const int plane : {17, 18, 19})
    if (const syntax::Word* const word = block.g(plane))
      if (block.before.mode(dialect::ModalGroup::Plane) != plane) return report_change(*word);
}

extern const Rule compensation_across_change = {kModal | kToolChange, check_compensation_across_change};

}  // namespace isocnc::rules
