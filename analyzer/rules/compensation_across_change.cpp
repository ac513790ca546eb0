#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// The plane, the frame or the tool changes while G41 or G42 is in force.
static void check_compensation_across_change(const ExecutedBlock& block, execution::Sink& sink) {
  if (!block.compensated() || block.before.is_in_doubt(dialect::ModalGroup::CutterCompensation)) return;
  const double mode = block.before.mode(dialect::ModalGroup::CutterCompensation);
  const syntax::Word* const ended = block.g(GRole::CompensationOff);
  const auto report_change = [&](const syntax::Word& word) {
    if (!ended || ended->begin > word.begin) report(sink, "compensation-across-change"_diag, word.span(), mode);
  };
  if (const syntax::Word* const change = block.m(dialect::kToolChange)) return report_change(*change);
  for (const GRole frame :
       {GRole::FaceByAxes, GRole::DismountFace, GRole::FaceAtTip, GRole::FaceByAngles, GRole::Workpiece}) {
    if (frame == GRole::DismountFace && !block.before.face_mounted)
      continue;  // W002 reports this G27, which has no effect.
    if (const syntax::Word* const word = block.g(frame)) return report_change(*word);
  }
  for (const GRole plane : {GRole::PlaneXY, GRole::PlaneZX, GRole::PlaneYZ})
    if (const syntax::Word* const word = block.g(plane))
      if (block.before.g(dialect::ModalGroup::Plane)->role != plane) return report_change(*word);
}

extern const Rule compensation_across_change = {kModal | kToolChange, check_compensation_across_change};

}  // namespace isocnc::rules
