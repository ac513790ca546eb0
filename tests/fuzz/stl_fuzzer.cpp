#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "interpreter/solids/clearance.h"
#include "interpreter/solids/stl.h"
#include "interpreter/solids/tool_shapes.h"
#include "require.h"

namespace isocnc::fuzz {

using geometry::Vec3;
using solids::Triangle;

static bool same_corners(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (a[i].corners[j].cast<float>() != b[i].corners[j].cast<float>()) return false;
  return true;
}

static void read(std::string_view bytes) {
  const solids::TrianglesOrProblem read = solids::read_stl(bytes);
  if (const auto* const problem = std::get_if<solids::StlProblem>(&read)) {
    require(problem->offset <= bytes.size(), "a problem lies within the file");
    require(problem->triangle <= bytes.size() / 50, "no more triangles than the file has bytes for");
    return;
  }
  const auto& triangles = std::get<std::vector<Triangle>>(read);
  require(!triangles.empty() && triangles.size() <= bytes.size() / 50, "the triangles are in the bytes");
  for (const Triangle& triangle : triangles)
    for (const Vec3& corner : triangle.corners) require(corner.allFinite(), "coordinates are finite");
  const auto again = solids::read_stl(solids::write_stl(triangles));
  require(same_corners(std::get<std::vector<Triangle>>(again), triangles), "what is written is read");

  const solids::Mesh mesh(triangles);
  require(mesh.nodes().size() <= 2 * triangles.size(), "the tree is as large as its triangles");
  const auto tool = std::get<solids::RevolvedBody>(solids::bull_body(5, 1, 50));
  const Vec3 corner = triangles.front().corners[0];
  const solids::Clearance at_corner = solids::clearance(tool, {corner - Vec3(0, 0, 20), Vec3(0, 0, 1)}, mesh);
  require(at_corner.upper <= 0, "a tool around a corner touches");
  const solids::Clearance above = solids::clearance(tool, {corner + Vec3(0, 0, 7), Vec3(0, 0, 1)}, mesh);
  require(above.lower <= 7, "no bound above the distance of a corner");
  mesh.encloses(corner + Vec3(1, 2, 3));
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::read(isocnc::fuzz::as_text(data, size));
  return 0;
}
