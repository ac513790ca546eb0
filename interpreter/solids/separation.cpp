#include "interpreter/solids/separation.h"

namespace isocnc::solids {

using geometry::Vec3;

bool DifferenceHull::has(const Vec3& difference) const {
  for (std::size_t i = 0; i < count_; ++i)
    if (corners_[i].difference == difference) return true;
  return false;
}

Vec3 DifferenceHull::on_first() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < count_; ++i) sum += weights_[i] * corners_[i].on_first;
  return sum;
}

Vec3 DifferenceHull::on_second() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < count_; ++i) sum += weights_[i] * corners_[i].on_second;
  return sum;
}

void DifferenceHull::consider(const HullWeights& weights, const Vec3& point) {
  const double square = point.squaredNorm();
  if (!(square < best_)) return;
  best_ = square;
  weights_ = weights;
  nearest_ = point;
}

void DifferenceHull::consider_edge(std::size_t a, std::size_t b) {
  const Vec3& from = corners_[a].difference;
  const Vec3 along = corners_[b].difference - from;
  const double square = along.squaredNorm();
  const double part = square > 0 ? -from.dot(along) / square : -1;
  if (!(part > 0 && part < 1)) return;  // One of the corners.
  HullWeights weights = {};
  weights[a] = 1 - part;
  weights[b] = part;
  consider(weights, from + part * along);
}

void DifferenceHull::consider_face(std::size_t a, std::size_t b, std::size_t c) {
  const Vec3& from = corners_[a].difference;
  const Vec3 first = corners_[b].difference - from;
  const Vec3 second = corners_[c].difference - from;
  const Vec3 normal = first.cross(second);
  const double square = normal.squaredNorm();
  if (!(square > 0)) return;
  const double at_b = normal.dot(second.cross(from)) / square;
  const double at_c = normal.dot(from.cross(first)) / square;
  if (!(at_b > 0 && at_c > 0 && at_b + at_c < 1)) return;  // On an edge.
  HullWeights weights = {};
  weights[a] = 1 - at_b - at_c;
  weights[b] = at_b;
  weights[c] = at_c;
  consider(weights, normal * (normal.dot(from) / square));
}

/// A hull that is nearly flat encloses nothing: the signs would be those of rounding errors, and its faces tell as
/// much.
bool DifferenceHull::encloses_origin() const {
  constexpr double kFlat = 1e-10;
  const auto side = [&](std::size_t a, std::size_t b, std::size_t c, const Vec3& point) {
    const Vec3& from = corners_[a].difference;
    return (corners_[b].difference - from).cross(corners_[c].difference - from).dot(point - from);
  };
  double size = 1;
  for (std::size_t i = 1; i < 4; ++i) size *= (corners_[i].difference - corners_[0].difference).norm();
  if (!(std::abs(side(0, 1, 2, corners_[3].difference)) > kFlat * size)) return false;
  constexpr std::array<std::array<std::size_t, 4>, 4> kFaces = {
      {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
  return std::all_of(kFaces.begin(), kFaces.end(), [&](const auto& face) {
    const double inner = side(face[0], face[1], face[2], corners_[face[3]].difference);
    return inner * side(face[0], face[1], face[2], Vec3::Zero()) > 0;
  });
}

void DifferenceHull::keep_best() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (!(weights_[i] > 0)) continue;
    if (kept != i) corners_[kept] = corners_[i];
    weights_[kept++] = weights_[i];
  }
  count_ = kept;
}

bool DifferenceHull::reduce() {
  if (count_ == 4 && encloses_origin()) {
    nearest_ = Vec3::Zero();
    weights_ = {0.25, 0.25, 0.25, 0.25};
    return true;
  }
  best_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count_; ++i) {
    HullWeights weights = {};
    weights[i] = 1;
    consider(weights, corners_[i].difference);
  }
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t j = i + 1; j < count_; ++j) consider_edge(i, j);
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t j = i + 1; j < count_; ++j)
      for (std::size_t k = j + 1; k < count_; ++k) consider_face(i, j, k);
  keep_best();
  return false;
}

}  // namespace isocnc::solids
