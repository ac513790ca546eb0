#include "interpreter/verification/body_pairs.h"

#include <algorithm>
#include <string>

#include "interpreter/dialect/format.h"

namespace isocnc::verification {

using dialect::GivenName;
using geometry::Vec3;
using kinematics::MachineKind;
using removal::ToolPart;

namespace {

/// What a motion may just reach is not hit by it: the board as far as cutting into it is allowed, and the finished
/// part.
constexpr double kSlack = 0.03;  // mm; above kContactDistance, so that such a motion is soon proven to be clear.

/// How deep in the target a cutter is in contact with it, mm.
double depth_below(double tolerance) { return tolerance + kSlack; }

/// What a part is called, with a place for the name of its tool.
dialect::Text name_of(ToolPart part) {
  switch (part) {
    case ToolPart::Cutter:
      return {"the cutter of {}", "la fresa {}"};
    case ToolPart::Shank:
      return {"the shank of {}", "il gambo di {}"};
    case ToolPart::Holder:
      return {"the holder of {}", "il portautensile di {}"};
    case ToolPart::Nose:
      break;
  }
  return {"the spindle nose", "il naso del mandrino"};
}

GivenName body_name(const SceneBody& body) {
  if (body.role == BodyRole::Spoilboard && body.name.empty())
    return GivenName::of({"the spoilboard", "il piano martire"});
  if (body.role == BodyRole::Target && body.name.empty())
    return GivenName::of({"the finished part", "il pezzo finito"});
  return GivenName::of({body.name, body.name});
}

class PairsMaker {
 public:
  PairsMaker(const Scene& scene, const kinematics::Kinematics& kinematics, const MountedTool& tool)
      : scene_(scene), kinematics_(kinematics), tool_(tool) {
    result_.tool_length = tool.length;
  }

  BodyPairs make(const Vec3& origin) {
    add_tool();
    add_machine();
    add_setup(origin);
    for (std::size_t part = 0; part < result_.parts.size(); ++part)
      for (std::size_t obstacle = 0; obstacle < result_.obstacles.size(); ++obstacle) add_pair(part, obstacle);
    return std::move(result_);
  }

 private:
  void add_tool() {
    if (tool_.bodies) {
      add_part(ToolPart::Cutter, tool_.bodies->cutter, 0);
      add_part(ToolPart::Shank, tool_.bodies->shank, 0);
      add_part(ToolPart::Holder, tool_.bodies->holder, 0);
    }
    add_part(ToolPart::Nose, scene_.nose, tool_.length);
  }

  void add_part(ToolPart part, const std::optional<solids::RevolvedBody>& body, double offset) {
    if (!body) return;
    result_.parts.push_back(
        {.of_spindle = part, .revolved = &*body, .offset = offset, .name = part_name(part, tool_.name)});
  }

  void add_body(const SceneBody& body, Link on, const Vec3& shift) {
    result_.parts.push_back({.body = &body, .on = on, .shift = shift, .name = body_name(body)});
  }

  /// Whether a link is between the machine's frame and the spindle.
  bool carries_spindle(Link link) const {
    if (link == Link::B || link == Link::C) return kinematics_.kind != MachineKind::Table;
    return link != Link::Machine;
  }

  void add_machine() {
    for (const SceneBody& body : scene_.machine) {
      if (carries_spindle(body.on)) {
        add_body(body, body.on, Vec3::Zero());
        // The tool moves towards what carries it: along Y and Z past a gantry, and a head turns it towards the ram.
        const Link last = kinematics_.kind == MachineKind::Head ? Link::Z : Link::Y;
        if (body.on > last) continue;
      } else if (body.on != Link::Machine) {
        add_body(body, body.on, Vec3::Zero());
      }
      result_.obstacles.push_back({.body = &body, .shape = body.shape, .on = body.on, .name = body_name(body)});
    }
  }

  void add_setup(const Vec3& origin) {
    for (const SceneBody& body : scene_.setup) {
      if (body.role == BodyRole::Stock) continue;
      Obstacle obstacle{
          .body = &body, .shape = body.shape, .on = kinematics::workpiece_link(kinematics_), .name = body_name(body)};
      if (scene_.is_in_workpiece_frame) obstacle.shift = origin;
      // A board whose ends are not known cannot be compared with the machine around the table.
      if (obstacle.on != Link::Machine && !body.is_endless) add_body(body, obstacle.on, obstacle.shift);
      auto* const box = std::get_if<solids::Cuboid>(&obstacle.shape);
      if (body.role == BodyRole::Spoilboard && box) box->maximum.z() -= kSlack;
      result_.obstacles.push_back(std::move(obstacle));
    }
  }

  /// Whether motions bring both nearer together, and they are not made to touch: what carries the nose touches it,
  /// links that carry one another touch as well, and so do bodies that touch from the start. What turns in a cradle
  /// comes around to what stands on it, and what a head turns to the carriage and the gantry.
  bool may_meet(const MovingPart& part, const Obstacle& obstacle) const {
    const bool is_own = carries_spindle(obstacle.on);
    if (part.revolved) return !(is_own && part.of_spindle == ToolPart::Nose);
    const bool turns = part.on == Link::B || part.on == Link::C;
    const bool turns_in_cradle = part.on == Link::C && obstacle.on == Link::B;
    const bool turns_past = turns && (obstacle.on == Link::X || obstacle.on == Link::Y);
    const bool is_head = kinematics_.kind == MachineKind::Head;
    if (carries_spindle(part.on) ? is_own && !(is_head && turns_past)
                                 : obstacle.on != Link::Machine && !turns_in_cradle)
      return false;
    return !are_among(scene_.at_home.touching, part, obstacle);
  }

  /// Whether two bodies are of a list.
  bool are_among(const std::vector<MachineBodies>& list, const MovingPart& part, const Obstacle& obstacle) const {
    return std::any_of(list.begin(), list.end(), [&](const MachineBodies& each) {
      return part.body == &scene_.machine[each.moving] && obstacle.body == &scene_.machine[each.other];
    });
  }

  void add_pair(std::size_t part_index, std::size_t obstacle_index) {
    const MovingPart& part = result_.parts[part_index];
    const Obstacle& obstacle = result_.obstacles[obstacle_index];
    if (!may_meet(part, obstacle)) return;
    const bool is_of_spindle = part.revolved || carries_spindle(part.on) || carries_spindle(obstacle.on);
    if (is_of_spindle && !tool_.is_place_known) return;
    BodyPair pair{.part = part_index, .obstacle = obstacle_index, .revolved = part.revolved, .limit = kContactDistance};
    if (obstacle.body->role == BodyRole::Target && part.of_spindle == ToolPart::Cutter) {
      const double depth = depth_below(scene_.target_tolerance);
      pair.slack = kSlack;
      if (obstacle.body->core) {
        pair.core = obstacle.body->core.get();
        add(pair, part, obstacle);
        pair.core = nullptr;
      }
      // Where the part is thin, nothing of it is deep, but the part is deep in the cutter.
      std::optional<solids::RevolvedBody> reduced = part.revolved->reduced(depth);
      // Of a thin cutter nothing remains, and of a pointed one not its point: it counts how deep they are.
      constexpr double kRounding = 1e-6;
      if (!reduced || reduced->bottom() > part.revolved->bottom() + depth + kRounding) {
        if (!obstacle.body->core) {
          pair.allowed = depth;
          add(pair, part, obstacle);
          pair.allowed = 0;
        }
        if (!reduced) return;
      }
      pair.revolved = &result_.reduced.emplace_back(*std::move(reduced));
    }
    if (obstacle.body->role == BodyRole::Spoilboard && std::holds_alternative<solids::Cuboid>(obstacle.shape))
      pair.slack = kSlack;
    const bool is_cutting = part.of_spindle == ToolPart::Cutter || part.of_spindle == ToolPart::Shank;
    const BodyRole role = obstacle.body->role;
    pair.is_watched = role == BodyRole::Fixture ||
                      (role == BodyRole::Machine && !are_among(scene_.at_home.near, part, obstacle)) ||
                      (role == BodyRole::Spoilboard && !is_cutting);
    if (pair.is_watched && scene_.clearance > kContactDistance) {
      pair.limit = scene_.clearance;
      pair.reports_near = true;
    }
    add(pair, part, obstacle);
  }

  void add(BodyPair pair, const MovingPart& part, const Obstacle& obstacle) {
    bound(part, obstacle, pair);
    result_.pairs.push_back(pair);
  }

  /// Sets what bounds the speed of a pair.
  void bound(const MovingPart& part, const Obstacle& obstacle, BodyPair& pair) const {
    const bool is_on_workpiece_side = obstacle.on == kinematics::workpiece_link(kinematics_);
    const bool is_head = kinematics_.kind == MachineKind::Head;
    if (part.revolved) {
      if (is_on_workpiece_side) pair.reach_tip = part.revolved->reach(-part.offset);
      const Vec3 arm = Vec3(0, 0, kinematics_.pivot) - kinematics_.spindle_from_b;
      if (is_head) {
        const double z = tool_.length + arm.z() - part.offset;  // Of the B axis, in the body's frame.
        pair.reach_axes = kinematics_.b_from_c.norm() + arm.head<2>().norm() + part.revolved->reach(z);
      } else {
        pair.reach_axes = part.revolved->reach(tool_.length - part.offset);
      }
    } else {
      const bool is_on_spindle = part.on >= kinematics::spindle_link(kinematics_) && carries_spindle(part.on);
      if (is_on_workpiece_side && is_on_spindle) pair.reach_tip = farthest(part, Vec3(0, 0, -tool_.length));
      pair.reach_axes = is_head ? reach_on_head(part) : reach_to_table(part);
      pair.shifts = carries_spindle(part.on);
    }
    const bool is_on_table = obstacle.on == Link::B || obstacle.on == Link::C;
    pair.swings = is_on_table && (part.revolved != nullptr || carries_spindle(part.on));
    // Nothing that turns lies between the spindle and the machine.
    if (!is_head && obstacle.on == Link::Machine && pair.shifts) pair.reach_axes = 0;
  }

  /// The largest distance of a body's points from the rotary axes of the head that turn it.
  double reach_on_head(const MovingPart& part) const {
    const Vec3 b_axis = Vec3(0, 0, kinematics_.pivot) - kinematics_.spindle_from_b;
    if (part.on == Link::B) return farthest(part, b_axis) + kinematics_.b_from_c.norm();
    return part.on == Link::C ? farthest(part, b_axis - kinematics_.b_from_c) : 0;
  }

  /// The largest distance of a body's points from the rotary axes of the table: of a body on the table itself; of one
  /// on the spindle's side, what comes to the distance from the nose to the axes.
  double reach_to_table(const MovingPart& part) const {
    switch (part.on) {
      case Link::X:
      case Link::Y:
        // It does not follow all of the nose's joints. They are no larger than the distance from the nose to the B
        // axis, and from there to the place of the nose with all joints at 0.
        return farthest(part, kinematics_.b_point) + kinematics_.b_point.norm();
      case Link::B:
        if (kinematics_.kind == MachineKind::Table) return farthest(part, kinematics_.b_point);
        break;
      case Link::C:
        if (kinematics_.kind == MachineKind::Table)
          return farthest(part, kinematics_.c_point) + (kinematics_.c_point - kinematics_.b_point).norm();
        break;
      case Link::Machine:
      case Link::Z:
        break;
    }
    return farthest(part, Vec3::Zero());
  }

  /// The largest distance of a body's points from a point of its link's frame.
  static double farthest(const MovingPart& part, const Vec3& from) {
    const solids::BoundingBox box = bounds(part.body->shape);
    const Vec3 center = from - part.shift;
    return (box.min() - center).cwiseAbs().cwiseMax((box.max() - center).cwiseAbs()).norm();
  }

  const Scene& scene_;
  const kinematics::Kinematics& kinematics_;
  const MountedTool& tool_;
  BodyPairs result_;
};

}  // namespace

GivenName part_name(ToolPart part, const std::string& tool) {
  const dialect::Text name = name_of(part);
  return GivenName::of({dialect::format(name, dialect::Language::English, tool),
                        dialect::format(name, dialect::Language::Italian, tool)});
}

std::shared_ptr<const solids::InnerSurface> core_of_target(const BodyShape& shape, double tolerance) {
  const auto* const mesh = std::get_if<std::shared_ptr<const solids::Mesh>>(&shape);
  if (!mesh || !(*mesh)->topology().faces_outwards()) return nullptr;
  return std::make_shared<const solids::InnerSurface>(*mesh, depth_below(tolerance));
}

BodyPairs pairs_of(const Scene& scene, const kinematics::Kinematics& kinematics, const MountedTool& tool,
                   const Vec3& origin) {
  return PairsMaker(scene, kinematics, tool).make(origin);
}

}  // namespace isocnc::verification
