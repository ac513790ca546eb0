#pragma once

namespace isocnc::dialect {

/// Thresholds above which lint rules report. They do not affect the errors of the control.
struct LintThresholds {
  double longest_dwell = 120;  ///< G04, seconds (W115).
  double axis_angle = 1e-4;    ///< Maximum deviation of axis vectors from the right angle, degrees (W114).
  double vector_error = 1e-3;  ///< Maximum deviation of the length of an axis vector from 1 (W128).
};

}  // namespace isocnc::dialect
