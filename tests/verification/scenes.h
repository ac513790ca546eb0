#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/solids/tool_shapes.h"
#include "interpreter/verification/surroundings.h"
#include "interpreter/verification/verified_run.h"

namespace isocnc::verification {

/// The triangles of a box, corners counterclockwise seen from outside.
inline std::shared_ptr<const solids::Mesh> mesh_of(const solids::Cuboid& box) {
  const auto corner = [&](int index) {
    return geometry::Vec3((index & 1) != 0 ? box.maximum.x() : box.minimum.x(),
                          (index & 2) != 0 ? box.maximum.y() : box.minimum.y(),
                          (index & 4) != 0 ? box.maximum.z() : box.minimum.z());
  };
  constexpr int kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::vector<solids::Triangle> triangles;
  for (const auto& quad : kQuads) {
    triangles.push_back({{corner(quad[0]), corner(quad[1]), corner(quad[2])}});
    triangles.push_back({{corner(quad[0]), corner(quad[2]), corner(quad[3])}});
  }
  return std::make_shared<const solids::Mesh>(std::move(triangles));
}

/// A scene and the machine that runs in it. The tool T101001 is a flat cutter of radius 10, 60 long, in a holder of
/// diameter 50 that is 40 high; the nose above it has a diameter of 120.
struct Shop {
  Scene scene;
  timing::TimedMachine machine;

  explicit Shop(kinematics::MachineKind kind = kinematics::MachineKind::ThreeAxis) {
    machine.motion = timing::unbounded_machine();
    machine.motion.kinematics = {.kind = kind, .pivot = 150, .b_point = {0, 0, -50}, .c_point = {0, 0, -50}};
    machine.home = {.tip = {0, 0, 400}};
    machine.tool_lengths[kTool] = 100;
    ToolBodies& tool = scene.tools[kTool];
    tool.length = 100;
    tool.cutter = body(solids::flat_body(10, 60));
    const solids::StackRow holder{.height = 40, .lower_diameter = 50, .upper_diameter = 50};
    tool.holder = body(solids::stacked_body({&holder, 1}, 60));
    const solids::StackRow nose{.height = 120, .lower_diameter = 120, .upper_diameter = 120};
    scene.nose = body(solids::stacked_body({&nose, 1}, 0));
  }

  static constexpr execution::ToolCode kTool{1, 1, 1};

  static solids::RevolvedBody body(solids::BodyOrProblem made) {
    return std::get<solids::RevolvedBody>(std::move(made));
  }

  SceneBody& box(std::string name, const geometry::Vec3& minimum, const geometry::Vec3& maximum,
                 BodyRole role = BodyRole::Fixture) {
    return scene.setup.emplace_back(SceneBody{
        .name = std::move(name), .role = role, .shape = solids::Cuboid{.minimum = minimum, .maximum = maximum}});
  }

  SceneBody& pin(std::string name, const geometry::Vec3& foot, const geometry::Vec3& axis, double height,
                 double radius) {
    return scene.setup.emplace_back(
        SceneBody{.name = std::move(name),
                  .shape = solids::Cylinder{.at = {.origin = foot, .axis = axis}, .height = height, .radius = radius}});
  }

  VerifiedRun run(const std::string& program, WorkTogether work_together = {}) const {
    running::RunOptions options;
    options.setup.home = machine.home;
    Scene made = scene;
    made.at_home = neighbors_at_home(made, machine);
    for (SceneBody& body : made.setup)
      if (body.role == BodyRole::Target) body.core = core_of_target(body.shape, made.target_tolerance);
    return verified_run(program, options, machine, &made, std::move(work_together));
  }
};

}  // namespace isocnc::verification
