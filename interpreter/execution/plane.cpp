#include "interpreter/execution/plane.h"

namespace isocnc::execution {

using namespace dialect::literals;

static constexpr Plane kPlaneXY = {.u = 0,
                                   .v = 1,
                                   .normal = 2,
                                   .u_letter = 'X',
                                   .v_letter = 'Y',
                                   .u_center = 'I',
                                   .v_center = 'J',
                                   .stray_center = 'K',
                                   .stray = "stray-center-k"_diag,
                                   .undetermined_by_u = "center-undetermined-g17-i"_diag,
                                   .undetermined_by_v = "center-undetermined-g17-j"_diag};
static constexpr Plane kPlaneZX = {.u = 2,
                                   .v = 0,
                                   .normal = 1,
                                   .u_letter = 'Z',
                                   .v_letter = 'X',
                                   .u_center = 'K',
                                   .v_center = 'I',
                                   .stray_center = 'J',
                                   .stray = "stray-center-j"_diag,
                                   .undetermined_by_u = "center-undetermined-g18-k"_diag,
                                   .undetermined_by_v = "center-undetermined-g18-i"_diag};
static constexpr Plane kPlaneYZ = {.u = 1,
                                   .v = 2,
                                   .normal = 0,
                                   .u_letter = 'Y',
                                   .v_letter = 'Z',
                                   .u_center = 'J',
                                   .v_center = 'K',
                                   .stray_center = 'I',
                                   .stray = "stray-center-i"_diag,
                                   .undetermined_by_u = "center-undetermined-g19-j"_diag,
                                   .undetermined_by_v = "center-undetermined-g19-k"_diag};

const Plane& plane_in_force(const State& state) {
  // Numbers are compared, since every arc asks.
  static constexpr std::uint16_t kZX = dialect::g_code(dialect::GRole::PlaneZX).number;
  static constexpr std::uint16_t kYZ = dialect::g_code(dialect::GRole::PlaneYZ).number;
  const std::uint16_t number = state.mode(dialect::ModalGroup::Plane);
  return number == kZX ? kPlaneZX : number == kYZ ? kPlaneYZ : kPlaneXY;
}

}  // namespace isocnc::execution
