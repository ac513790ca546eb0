#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/solids/obstacle.h"

namespace isocnc::solids {

/// A node of the tree of boxes over a mesh's triangles.
struct MeshNode {
  BoundingBox box;
  std::uint32_t first = 0;  ///< First triangle of a leaf; of another node, the left child. The right one follows it.
  std::uint32_t count = 0;  ///< Number of triangles; 0 for a node with children.
};

/// Whether triangles enclose a volume. Corners are the same if their coordinates are equal to the last digit.
struct MeshTopology {
  std::size_t open_edges = 0;  ///< Edges of the triangles without a partner that runs the other way.
  std::size_t degenerate = 0;  ///< Triangles without area.
  double volume = 0;           ///< mm^3; positive if the corners run counterclockwise seen from outside.
  bool is_closed() const { return open_edges == 0 && volume != 0; }
  bool faces_outwards() const { return is_closed() && volume > 0; }
};

/// What a closed mesh without hollows encloses, as the corners and faces of a convex solid. Directions are unit
/// vectors.
struct ConvexSolid {
  std::vector<geometry::Vec3> corners;
  std::vector<geometry::Vec3> normals;  ///< Of the faces, outwards.
  std::vector<double> heights;          ///< Of each face along its normal, mm.
  std::vector<geometry::Vec3> edges;    ///< Directions in which two faces meet that are not in one plane.
  geometry::Vec3 middle = geometry::Vec3::Zero();
};

/// A surface of triangles, with a tree of boxes for fast distances. If the surface is closed, what it encloses is
/// solid. Memory is proportional to the number of triangles: some 150 bytes for each, and
/// 24 for each surface.
class Mesh {
 public:
  static constexpr std::size_t kMaxTriangles = 1u << 30;

  /// Meshes of more triangles are not asked whether they are convex.
  static constexpr std::size_t kMaxConvexTriangles = 1024;

  /// Corners are finite; at least one triangle, at most kMaxTriangles. Their order is not kept.
  explicit Mesh(std::vector<Triangle> triangles);

  std::span<const Triangle> triangles() const { return triangles_; }
  std::span<const MeshNode> nodes() const { return nodes_; }  ///< The root comes first.
  const BoundingBox& bounds() const { return nodes_.front().box; }
  const MeshTopology& topology() const { return topology_; }
  /// One corner of each of the surfaces that the mesh consists of: triangles with a common corner are of one surface.
  std::span<const geometry::Vec3> surface_points() const { return surface_points_; }

  /// Whether a closed mesh encloses a point that is not on its surface. False for a mesh that is not closed.
  bool encloses(const geometry::Vec3& point) const;
  /// Null unless the mesh is one closed convex surface, to within 0.002 mm, of at most kMaxConvexTriangles triangles.
  const ConvexSolid* convex() const { return convex_ ? &*convex_ : nullptr; }

 private:
  void split(std::size_t node, std::size_t first, std::size_t count);
  void build();

  std::vector<Triangle> triangles_;
  std::vector<MeshNode> nodes_;
  MeshTopology topology_;
  std::vector<geometry::Vec3> surface_points_;
  std::optional<ConvexSolid> convex_;
};

/// Each corner's number in the order of coordinates, three for each triangle; equal corners have the same.
std::vector<std::uint32_t> corner_numbers(std::span<const Triangle> triangles);

/// Examines triangles; takes time proportional to n log n.
MeshTopology topology_of(std::span<const Triangle> triangles);

}  // namespace isocnc::solids
