#include "interpreter/geometry/helix.h"

#include <cmath>
#include <numbers>

#include "interpreter/geometry/frame.h"

namespace isocnc::geometry {

Helix helix(const Vec3& from, const Vec3& to, const Vec3& center, const Vec3& normal, double sweep_deg) {
  const Vec3 from_center = from - center;
  Helix result;
  result.sweep = std::abs(sweep_deg) * std::numbers::pi / 180;
  result.out = from_center - normal * normal.dot(from_center);
  result.side = normal.cross(result.out) * (sweep_deg < 0 ? -1 : 1);
  result.center = from - result.out;
  const SineCosine end = sine_and_cosine(std::abs(sweep_deg));
  result.cosine = end.cosine;
  result.sine = end.sine;
  result.rise = to - (result.center + result.cosine * result.out + result.sine * result.side);
  return result;
}

double Helix::length() const { return std::sqrt(sweep * sweep * out.squaredNorm() + rise.squaredNorm()); }

std::array<Range, 3> Helix::extents() const {
  return wave_ranges(center, out, side, rise / sweep, {sweep, cosine, sine});
}

}  // namespace isocnc::geometry
