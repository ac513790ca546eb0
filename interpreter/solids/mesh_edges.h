#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// Used in this folder only.
namespace isocnc::solids::detail {

/// An edge of a triangle between two corners, by their numbers (corner_numbers()): low < high.
struct MeshEdge {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t start = 0;  ///< Index of the corner that it starts at, three for each triangle.
  bool runs_up = false;
};

/// The edges with a length, those between the same corners one after another.
std::vector<MeshEdge> sorted_edges(const std::vector<std::uint32_t>& corners);

/// The end of those between the same corners as the one at `first`.
std::size_t end_of_same(const std::vector<MeshEdge>& edges, std::size_t first);

}  // namespace isocnc::solids::detail
