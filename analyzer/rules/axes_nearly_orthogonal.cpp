#include <algorithm>
#include <cmath>
#include <numbers>

#include "analyzer/rules/rule.h"
#include "interpreter/geometry/frame.h"

namespace isocnc::rules {

/// Face axes that the control accepts as orthogonal, but that are not exactly so (D26).
static void check_axes_nearly_orthogonal(const ExecutedBlock& block, execution::Sink& sink) {
  const syntax::Word* word = block.g(GRole::FaceAtTip);
  if (!word) word = block.g(GRole::FaceByAxes);
  if (!word || !block.after.face_mounted || block.after.face_undefined) return;
  const geometry::Mat3& axes = block.after.face.axes;
  double worst = 0;
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}}) {
    const double cosine = std::abs(axes.col(a).dot(axes.col(b)));
    if (cosine < geometry::kOrthogonalCosine) worst = std::max(worst, cosine);
  }
  const double angle = std::asin(worst) * 180 / std::numbers::pi;
  if (angle > block.thresholds.axis_angle) report(sink, "axes-nearly-orthogonal"_diag, word->span(), angle);
}

extern const Rule axes_nearly_orthogonal = {kModal, check_axes_nearly_orthogonal};

}  // namespace isocnc::rules
