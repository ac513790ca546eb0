#include "interpreter/solids/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "interpreter/solids/mesh_edges.h"

namespace isocnc::solids {

using geometry::Vec3;

namespace {

constexpr std::size_t kLeafSize = 4;

BoundingBox extent_of(std::span<const Triangle> triangles) {
  BoundingBox box;
  for (const Triangle& triangle : triangles) box.extend(triangle.bounds());
  return box;
}

bool comes_before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Where edges run up and down in equal number between the same corners, each has its partner.
std::size_t count_open(const std::vector<detail::MeshEdge>& edges) {
  std::size_t open = 0;
  for (std::size_t i = 0; i < edges.size();) {
    const std::size_t next = detail::end_of_same(edges, i);
    std::size_t up = 0;
    for (std::size_t k = i; k < next; ++k) up += edges[k].runs_up ? 1 : 0;
    const std::size_t down = next - i - up;
    open += std::max(up, down) - std::min(up, down);
    i = next;
  }
  return open;
}

/// One corner of each set of triangles that hang together by their corners. Requires the numbers of the corners.
std::vector<Vec3> points_of_surfaces(std::span<const Triangle> triangles, const std::vector<std::uint32_t>& corners) {
  std::vector<std::uint32_t> parents(corners.size());
  for (std::uint32_t i = 0; i < parents.size(); ++i) parents[i] = i;
  const auto root = [&](std::uint32_t corner) {
    while (parents[corner] != corner) corner = parents[corner] = parents[parents[corner]];
    return corner;
  };
  for (std::size_t i = 0; i < corners.size(); ++i) parents[root(corners[i])] = root(corners[i - i % 3]);
  std::vector<Vec3> points;
  std::vector<bool> is_known(corners.size());
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const std::uint32_t surface = root(corners[i]);
    if (!is_known[surface]) points.push_back(triangles[i / 3].corners[0]);
    is_known[surface] = true;
  }
  return points;
}

MeshTopology topology_of(std::span<const Triangle> triangles, const std::vector<std::uint32_t>& corners) {
  MeshTopology topology;
  topology.open_edges = count_open(detail::sorted_edges(corners));
  if (triangles.empty()) return topology;
  const Vec3 origin = triangles.front().corners[0];
  for (const Triangle& triangle : triangles) {
    if (!(triangle.area_vector().norm() > 0)) ++topology.degenerate;
    topology.volume += triangle.area_vector().dot(triangle.corners[0] - origin) / 6;
  }
  return topology;
}

/// Unit vectors that differ by less are the same: faces that were flat before their corners were rounded are.
constexpr double kSameDirection = 1e-6;

/// Adds a direction that is not known yet, but for its sign where that does not matter.
bool add_direction(std::vector<Vec3>& known, const Vec3& direction, bool has_sign) {
  const bool is_known = std::any_of(known.begin(), known.end(), [&](const Vec3& each) {
    return (each - direction).norm() <= kSameDirection || (!has_sign && (each + direction).norm() <= kSameDirection);
  });
  if (!is_known) known.push_back(direction);
  return !is_known;
}

/// The solid that a closed mesh encloses, if no corner is above any of its faces, but for what files round away: STL
/// has single precision.
std::optional<ConvexSolid> convex_solid(std::span<const Triangle> triangles, const MeshTopology& topology,
                                        const std::vector<std::uint32_t>& corner_numbers) {
  ConvexSolid solid;
  std::vector<Vec3>& corners = solid.corners;
  BoundingBox box;
  for (const Triangle& triangle : triangles)
    for (const Vec3& corner : triangle.corners) {
      corners.push_back(corner);
      box.extend(corner);
    }
  std::sort(corners.begin(), corners.end(), comes_before);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  solid.middle = box.center();
  const double farthest = std::max(box.max().cwiseAbs().maxCoeff(), box.min().cwiseAbs().maxCoeff());
  const double flat = std::max(0.002, 1e-6 * farthest);  // mm
  std::vector<Vec3> normals(triangles.size(), Vec3::Zero());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& triangle = triangles[i];
    const Vec3 area = triangle.area_vector();
    if (!(area.norm() > 0)) continue;
    const Vec3 normal = normals[i] = area.normalized() * (topology.volume > 0 ? 1 : -1);
    const double height = triangle.highest(normal);
    if (std::any_of(corners.begin(), corners.end(), [&](const Vec3& each) { return normal.dot(each) > height + flat; }))
      return {};
    if (add_direction(solid.normals, normal, true)) solid.heights.push_back(height);
  }
  const std::vector<detail::MeshEdge> edges = detail::sorted_edges(corner_numbers);
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    end = detail::end_of_same(edges, first);
    const std::uint32_t start = edges[first].start;
    const bool is_flat =
        end == first + 2 && (normals[start / 3] - normals[edges[first + 1].start / 3]).norm() <= kSameDirection;
    const Triangle& triangle = triangles[start / 3];
    const Vec3 edge = triangle.corners[start % 3 == 2 ? 0 : start % 3 + 1] - triangle.corners[start % 3];
    if (!is_flat) add_direction(solid.edges, edge.normalized(), false);
  }
  return solid;
}

}  // namespace

std::vector<detail::MeshEdge> detail::sorted_edges(const std::vector<std::uint32_t>& corners) {
  std::vector<MeshEdge> edges;
  edges.reserve(corners.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t from = corners[i];
    const std::uint32_t to = corners[i % 3 == 2 ? i - 2 : i + 1];
    if (from != to) edges.push_back({std::min(from, to), std::max(from, to), i, from < to});
  }
  std::sort(edges.begin(), edges.end(), [](const MeshEdge& a, const MeshEdge& b) {
    return std::tuple(a.low, a.high, a.start) < std::tuple(b.low, b.high, b.start);
  });
  return edges;
}

std::size_t detail::end_of_same(const std::vector<MeshEdge>& edges, std::size_t first) {
  std::size_t end = first + 1;
  while (end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high) ++end;
  return end;
}

std::vector<std::uint32_t> corner_numbers(std::span<const Triangle> triangles) {
  const auto corner = [&](std::uint32_t i) -> const Vec3& { return triangles[i / 3].corners[i % 3]; };
  std::vector<std::uint32_t> order(3 * triangles.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return comes_before(corner(a), corner(b)); });
  std::vector<std::uint32_t> numbers(order.size());
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && corner(order[i]) != corner(order[i - 1])) ++number;
    numbers[order[i]] = number;
  }
  return numbers;
}

MeshTopology topology_of(std::span<const Triangle> triangles) {
  return topology_of(triangles, corner_numbers(triangles));
}

Mesh::Mesh(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  const std::vector<std::uint32_t> corners = corner_numbers(triangles_);
  topology_ = topology_of(triangles_, corners);
  surface_points_ = points_of_surfaces(triangles_, corners);
  if (topology_.is_closed() && surface_points_.size() == 1 && triangles_.size() <= kMaxConvexTriangles)
    convex_ = convex_solid(triangles_, topology_, corners);
  build();
}

/// Halves the triangles by their number, along the longest side of their box, so that the depth is bounded whatever
/// they look like.
void Mesh::build() {
  struct TreePart {
    std::size_t node;
    std::size_t first;
    std::size_t count;
  };
  nodes_.reserve(triangles_.size());
  nodes_.emplace_back();
  std::vector<TreePart> parts = {{0, 0, triangles_.size()}};
  while (!parts.empty()) {
    const TreePart part = parts.back();
    parts.pop_back();
    split(part.node, part.first, part.count);
    if (nodes_[part.node].count > 0) continue;
    const std::size_t left = part.count / 2;
    parts.push_back({nodes_[part.node].first, part.first, left});
    parts.push_back({nodes_[part.node].first + std::size_t{1}, part.first + left, part.count - left});
  }
  nodes_.shrink_to_fit();
}

void Mesh::split(std::size_t node, std::size_t first, std::size_t count) {
  const std::span<Triangle> part = std::span(triangles_).subspan(first, count);
  nodes_[node].box = extent_of(part);
  if (count <= kLeafSize) {
    nodes_[node].first = static_cast<std::uint32_t>(first);
    nodes_[node].count = static_cast<std::uint32_t>(count);
    return;
  }
  Eigen::Index axis = 0;
  nodes_[node].box.sizes().maxCoeff(&axis);
  std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count / 2), part.end(),
                   [&](const Triangle& a, const Triangle& b) { return a.middle()[axis] < b.middle()[axis]; });
  nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
}

namespace {

/// On which side of the line from `a` to `b`, seen along Z, the point lies. The corners are taken in one order for both
/// triangles of an edge, so that rounding puts the point on exactly one side.
bool lies_left(const Vec3& a, const Vec3& b, const Vec3& point) {
  const bool is_swapped = comes_before(b, a);
  const Vec3& from = is_swapped ? b : a;
  const Vec3& to = is_swapped ? a : b;
  const double side = (to.x() - from.x()) * (point.y() - from.y()) - (to.y() - from.y()) * (point.x() - from.x());
  return (side > 0) != is_swapped;
}

/// How often the ray from the point upwards passes the triangle: 1 from inside outwards, -1 from outside inwards, for
/// corners that run counterclockwise seen from outside.
int passes(const Triangle& triangle, const Vec3& point) {
  const auto& [a, b, c] = triangle.corners;
  const bool left = lies_left(a, b, point);
  if (lies_left(b, c, point) != left || lies_left(c, a, point) != left) return 0;
  const Vec3 normal = triangle.area_vector();
  const double above = normal.dot(a - point) / normal.z();
  if (!(above > 0)) return 0;
  return left ? 1 : -1;
}

}  // namespace

bool Mesh::encloses(const Vec3& point) const {
  if (!topology_.is_closed()) return false;
  int winding = 0;
  std::vector<std::uint32_t> open = {0};
  while (!open.empty()) {
    const MeshNode& node = nodes_[open.back()];
    open.pop_back();
    const BoundingBox& box = node.box;
    if (point.x() < box.min().x() || point.x() > box.max().x() || point.y() < box.min().y() ||
        point.y() > box.max().y() || point.z() > box.max().z())
      continue;
    for (std::uint32_t i = 0; i < node.count; ++i) winding += passes(triangles_[node.first + i], point);
    if (node.count == 0) open.insert(open.end(), {node.first, node.first + 1});
  }
  return winding != 0;
}

}  // namespace isocnc::solids
