#include "interpreter/configuration/make_scene.h"

#include <string>
#include <utility>
#include <variant>

#include "interpreter/configuration/tool_bodies.h"
#include "interpreter/system/paths.h"
#include "interpreter/verification/body_pairs.h"
#include "interpreter/verification/surroundings.h"

namespace isocnc::configuration {

using geometry::Vec3;
using verification::BodyDescription;
using verification::BodyRole;
using verification::BodyShape;
using verification::Link;
using verification::Scene;
using verification::SceneBody;

/// A spoilboard without an area reaches as far from the origin in X and Y.
static constexpr double kBoardReach = 1e5;
static constexpr double kBoardThickness = 100;

static BodyDescription described(const std::filesystem::path& file, const DescriptionPlace& place) {
  return {.file = system::generic_name(file), .line = place.shown.line - 1, .column = place.byte};
}

static Vec3 corner(const std::vector<double>& row) { return {row[0], row[1], row[2]}; }

static Link link_named(std::string_view name) {
  if (name == "X") return Link::X;
  if (name == "Y") return Link::Y;
  if (name == "Z") return Link::Z;
  if (name == "C") return Link::C;
  if (name == "B") return Link::B;
  return Link::Machine;
}

static solids::Cylinder cylinder_of(const DescribedCylinder& described, const Vec3& shift) {
  const Vec3 axis = described.axis.value_or(Vec3(0, 0, 1));
  return {.at = {.origin = described.at.value_or(Vec3::Zero()) + shift, .axis = axis.stableNormalized()},
          .height = described.height,
          .radius = described.diameter / 2};
}

namespace {

/// Makes the bodies that one file describes.
class BodyMaker {
 public:
  BodyMaker(const std::filesystem::path& file, const std::filesystem::path& folder, const ShapeSource& shapes)
      : file_(file), folder_(folder), shapes_(shapes) {}

  void add(const DescribedBody& body, BodyRole role, std::vector<SceneBody>& bodies) const {
    std::optional<BodyShape> shape = shape_of(body.shape);
    if (!shape) return;
    bodies.push_back({.name = body.name,
                      .role = role,
                      .on = link_named(body.on),
                      .shape = *std::move(shape),
                      .described = described(file_, body.place)});
  }

  void add(const DescribedTarget& target, Scene& scene) const {
    const DescribedShape shape{.box = {}, .cylinder = {}, .mesh = target.mesh, .at = target.at};
    const std::size_t others = scene.setup.size();
    add(DescribedBody{.name = {}, .shape = shape, .place = target.place}, BodyRole::Target, scene.setup);
    scene.target_tolerance = target.tolerance;
    if (scene.setup.size() > others)
      scene.setup.back().core = verification::core_of_target(scene.setup.back().shape, target.tolerance);
  }

  void add(const DescribedStock& stock, Scene& scene) const {
    if (!stock.from)
      return add(DescribedBody{.name = {}, .shape = stock.shape, .place = stock.place}, BodyRole::Stock, scene.setup);
    scene.left_stock =
        stock::LeftStock{.stock = shapes_.stock({.shape = *stock.from, .at = {}, .file = file_, .folder = folder_}),
                         .shift = stock.shape.at.value_or(Vec3::Zero()),
                         .is_turned_over = stock.is_turned_over.value_or(false),
                         .quarter_turns = stock.quarter_turns.value_or(0)};
    if (!scene.left_stock->stock) return;
    const solids::BoundingBox box = stock::bounds_of(*scene.left_stock);
    scene.setup.push_back({.name = {},
                           .role = BodyRole::Stock,
                           .on = Link::Machine,
                           .shape = solids::Cuboid{box.min(), box.max()},
                           .described = described(file_, stock.place)});
  }

  void add(const DescribedSpoilboard& board, std::vector<SceneBody>& bodies) const {
    const double top = board.top - board.allow;
    solids::Cuboid box{{-kBoardReach, -kBoardReach, top - kBoardThickness}, {kBoardReach, kBoardReach, top}};
    if (board.area) {
      box.minimum.head<2>() = Eigen::Vector2d((*board.area)[0][0], (*board.area)[0][1]);
      box.maximum.head<2>() = Eigen::Vector2d((*board.area)[1][0], (*board.area)[1][1]);
    }
    bodies.push_back({.name = {},
                      .role = BodyRole::Spoilboard,
                      .on = Link::Machine,
                      .shape = box,
                      .described = described(file_, board.place),
                      .is_endless = !board.area});
  }

 private:
  std::optional<BodyShape> shape_of(const DescribedShape& shape) const {
    const Vec3 shift = shape.at.value_or(Vec3::Zero());
    if (shape.box) return solids::Cuboid{corner((*shape.box)[0]) + shift, corner((*shape.box)[1]) + shift};
    if (shape.cylinder) return cylinder_of(*shape.cylinder, shift);
    if (!shape.mesh) return std::nullopt;
    std::shared_ptr<const solids::Mesh> mesh =
        shapes_.mesh({.shape = *shape.mesh, .at = shape.at, .file = file_, .folder = folder_});
    return mesh ? std::optional<BodyShape>(std::move(mesh)) : std::nullopt;
  }

  const std::filesystem::path& file_;
  const std::filesystem::path& folder_;
  const ShapeSource& shapes_;
};

}  // namespace

static void add_machine(const MachineConfiguration& machine, const ShapeSource& shapes, Scene& scene) {
  for (const Tool& tool : machine.tools.value_or(std::vector<Tool>())) {
    auto bodies = tool_bodies(machine, tool);
    auto* const made = std::get_if<verification::ToolBodies>(&bodies);
    if (made == nullptr || !tool.length) continue;
    made->described = described(machine.file, tool.place);
    scene.tools.emplace(tool.code, std::move(*made));
  }
  if (machine.nose) {
    auto nose = stack_body(*machine.nose, 0);
    if (auto* const made = std::get_if<solids::RevolvedBody>(&nose)) scene.nose = std::move(*made);
  }
  const BodyMaker maker(machine.file, machine.folder, shapes);
  for (const DescribedBody& body : machine.bodies) maker.add(body, BodyRole::Machine, scene.machine);
}

static void add_setup(const LocatedSetup& located, const ShapeSource& shapes, Scene& scene) {
  const DescribedSetup& setup = located.setup;
  scene.name = system::generic_name(located.file);
  scene.is_in_workpiece_frame = setup.frame == "workpiece";
  scene.clearance = setup.clearance;
  scene.resolution = setup.resolution;
  const BodyMaker maker(located.file, located.folder, shapes);
  for (const DescribedBody& fixture : setup.fixtures) maker.add(fixture, BodyRole::Fixture, scene.setup);
  if (setup.spoilboard) maker.add(*setup.spoilboard, scene.setup);
  if (setup.target) maker.add(*setup.target, scene);
  if (setup.stock) maker.add(*setup.stock, scene);
}

Scene make_scene(const MachineConfiguration& machine, const std::optional<LocatedSetup>& located,
                 const ShapeSource& shapes) {
  Scene scene;
  add_machine(machine, shapes, scene);
  scene.name = system::generic_name(machine.file);
  scene.has_setup = located.has_value();
  if (located) add_setup(*located, shapes, scene);
  scene.at_home = verification::neighbors_at_home(scene, machine.timed);
  return scene;
}

}  // namespace isocnc::configuration
