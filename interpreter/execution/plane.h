#pragma once

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/execution/state.h"

namespace isocnc::execution {

/// An arc plane of the frame in force: G17, G18 or G19 (I.3.4.3.a). u and v are its axes in the order in which a
/// counterclockwise arc (G03) turns from one to the other, as seen from the positive end of the normal u x v: i x j,
/// k x i, j x k (D40). Axes are indices of a point: 0 X, 1 Y, 2 Z.
struct Plane {
  int u, v, normal;
  char u_letter, v_letter;                  ///< Letters of the end point.
  char u_center, v_center, stray_center;    ///< Letters of the center: I, J, K.
  dialect::DiagnosticId stray;              ///< Diagnostic for the center letter outside the plane (D39).
  dialect::DiagnosticId undetermined_by_u;  ///< Diagnostic where u alone does not determine the center (D37).
  dialect::DiagnosticId undetermined_by_v;
};

/// The plane of arcs, and of the side to which G41 and G42 offset.
const Plane& plane_in_force(const State& state);

}  // namespace isocnc::execution
