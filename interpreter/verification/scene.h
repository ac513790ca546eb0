#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "interpreter/dialect/given_name.h"
#include "interpreter/execution/setup.h"
#include "interpreter/kinematics/links.h"
#include "interpreter/solids/inner_surface.h"
#include "interpreter/solids/mesh.h"
#include "interpreter/solids/obstacle.h"
#include "interpreter/solids/revolved_body.h"
#include "interpreter/stock/blank.h"

namespace isocnc::verification {

using kinematics::Link;

/// What a body is for.
enum class BodyRole : std::uint8_t {
  Fixture,     ///< A cup, a clamp, a stop.
  Spoilboard,  ///< The board below the workpiece, as far as nothing may go into it.
  Target,      ///< The finished part.
  Stock,       ///< The blank. It is cut, and compared with what should not meet it.
  Machine,     ///< A part of the machine.
};

/// A mesh may be shared by several bodies.
using BodyShape = std::variant<solids::Cuboid, solids::Cylinder, std::shared_ptr<const solids::Mesh>>;

/// The place in a file where a body is described.
using BodyDescription = dialect::FilePlace;

/// A solid body on a part of the machine, in machine coordinates with all joints at 0, mm.
struct SceneBody {
  std::string name;  ///< As the user calls it.
  BodyRole role = BodyRole::Fixture;
  Link on = Link::Machine;
  BodyShape shape;
  BodyDescription described;
  bool is_endless = false;  ///< It has no ends that are known: the shape is only large.
  /// Of a target: what no cutter may reach (core_of_target()). Null unless the shape is a closed mesh.
  std::shared_ptr<const solids::InnerSurface> core;
};

/// The bodies of a tool: z = 0 at the tip, growing to the spindle nose at z = `length`, mm.
struct ToolBodies {
  double length = 0;                           ///< From the spindle nose to the tip.
  std::optional<solids::RevolvedBody> cutter;  ///< None: its shape is not known.
  std::optional<solids::RevolvedBody> shank;   ///< From the end of the cutter to the holder.
  std::optional<solids::RevolvedBody> holder;  ///< Up to the spindle nose.
  std::optional<double> max_depth;             ///< How deep it may cut at once, mm.
  BodyDescription described;
};

/// Two bodies of a machine, as indices into Scene::machine.
struct MachineBodies {
  std::size_t moving = 0;
  std::size_t other = 0;

  friend bool operator==(const MachineBodies&, const MachineBodies&) = default;
};

/// Bodies of a machine that are made to be near each other, as they are where it stands at home.
struct NeighborsAtHome {
  std::vector<MachineBodies> touching;  ///< As a gantry and its rails: they are not compared.
  std::vector<MachineBodies> near;      ///< Nearer than Scene::clearance: they have no near misses.
};

/// What surrounds a program: the bodies that a motion may bring together. A value, immutable once made; meshes are
/// shared.
struct Scene {
  std::map<execution::ToolCode, ToolBodies> tools;
  std::optional<solids::RevolvedBody> nose;  ///< z = 0 at the spindle nose, growing away from the tool.
  std::vector<SceneBody> machine;            ///< Bodies of the machine.
  NeighborsAtHome at_home;                   ///< What neighbors_at_home() has found.
  /// Bodies of the setup: fixtures, spoilboard, target, stock. They stand on the machine, or, on a table that turns, on
  /// the table; `on` is not used. Their frame is that of the first G92, or of the machine.
  std::vector<SceneBody> setup;
  bool is_in_workpiece_frame = true;  ///< The frame of `setup`: that of the first G92, else the machine's.
  double clearance = 2;               ///< What is nearer, without a contact, is a near miss (W154); mm.
  std::optional<double> resolution;   ///< How fine the stock is simulated, mm; none: as it fits.
  /// What an earlier setup has left, if that is the blank: the stock in `setup` is then the box around it.
  std::optional<stock::LeftStock> left_stock;
  double target_tolerance = 0;  ///< Gouges of the target up to this depth are accepted, mm.
  std::string name;             ///< The file that describes the setup, or the machine; as shown to users.
  bool has_setup = true;        ///< Otherwise these are the bodies of the machine alone.
};

/// The box around a shape, in its frame, mm.
solids::BoundingBox bounds(const BodyShape& shape);

}  // namespace isocnc::verification
