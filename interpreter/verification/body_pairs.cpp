#include "interpreter/verification/body_pairs.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace isocnc::verification {

using dialect::GivenName;
using geometry::Vec3;
using kinematics::MachineKind;

namespace {

/// What a motion may just reach is not hit by it: the board as far as cutting into it is allowed, and the finished
/// part.
constexpr double kSlack = 0.03;  // mm; above kContactDistance, so that such a motion is soon proven to be clear.

struct PartName {
  dialect::Text of_tool;
  dialect::Text alone;
};

PartName name_of(PartKind kind) {
  switch (kind) {
    case PartKind::Cutter:
      return {{"the cutter of {}", "la fresa {}"}, {"the cutter", "la fresa"}};
    case PartKind::Shank:
      return {{"the shank of {}", "il gambo di {}"}, {"the shank", "il gambo"}};
    case PartKind::Holder:
      return {{"the holder of {}", "il portautensile di {}"}, {"the holder", "il portautensile"}};
    case PartKind::Nose:
    case PartKind::MachineBody:
      break;
  }
  return {{"the spindle nose", "il naso del mandrino"}, {"the spindle nose", "il naso del mandrino"}};
}

GivenName part_name(PartKind kind, const std::string& tool) {
  const PartName name = name_of(kind);
  if (tool.empty()) return GivenName::of(name.alone);
  const std::string english = fmt::format(fmt::runtime(name.of_tool.en), tool);
  const std::string italian = fmt::format(fmt::runtime(name.of_tool.it), tool);
  return GivenName::of({english, italian});
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
      add_part(PartKind::Cutter, tool_.bodies->cutter, 0);
      add_part(PartKind::Shank, tool_.bodies->shank, 0);
      add_part(PartKind::Holder, tool_.bodies->holder, 0);
    }
    add_part(PartKind::Nose, scene_.nose, tool_.length);
  }

  void add_part(PartKind kind, const std::optional<solids::RevolvedBody>& body, double offset) {
    if (!body) return;
    const std::string& tool = kind == PartKind::Nose ? std::string() : tool_.name;
    result_.parts.push_back({.kind = kind, .revolved = &*body, .offset = offset, .name = part_name(kind, tool)});
  }

  /// Whether a link is between the machine's frame and the spindle.
  bool carries_spindle(Link link) const {
    if (link == Link::B || link == Link::C) return kinematics_.kind != MachineKind::Table;
    return link != Link::Machine;
  }

  void add_machine() {
    for (const SceneBody& body : scene_.machine) {
      if (carries_spindle(body.on)) {
        result_.parts.push_back({.kind = PartKind::MachineBody, .body = &body, .name = body_name(body)});
        // A head that tilts may turn the tool into what carries it.
        const bool is_own = kinematics_.kind == MachineKind::Head && body.on <= Link::Z;
        if (!is_own) continue;
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
      auto* const box = std::get_if<solids::Cuboid>(&obstacle.shape);
      if (body.role == BodyRole::Spoilboard && box) {
        box->maximum.z() -= kSlack;
        obstacle.slack = kSlack;
      }
      result_.obstacles.push_back(std::move(obstacle));
    }
  }

  void add_pair(std::size_t part_index, std::size_t obstacle_index) {
    const MovingPart& part = result_.parts[part_index];
    const Obstacle& obstacle = result_.obstacles[obstacle_index];
    const bool is_own = carries_spindle(obstacle.on);
    if (!part.revolved || (is_own && part.kind == PartKind::Nose)) return;
    BodyPair pair{.part = part_index, .obstacle = obstacle_index, .revolved = part.revolved, .limit = kContactDistance};
    if (obstacle.body->role == BodyRole::Target && part.kind == PartKind::Cutter) {
      std::optional<solids::RevolvedBody> reduced = part.revolved->reduced(std::max(scene_.target_tolerance, kSlack));
      if (!reduced) return;
      pair.revolved = &result_.reduced.emplace_back(*std::move(reduced));
    }
    const bool is_cutting = part.kind == PartKind::Cutter || part.kind == PartKind::Shank;
    const BodyRole role = obstacle.body->role;
    const bool is_watched =
        role == BodyRole::Fixture || role == BodyRole::Machine || (role == BodyRole::Spoilboard && !is_cutting);
    if (is_watched && scene_.clearance > kContactDistance) {
      pair.limit = scene_.clearance;
      pair.reports_near = true;
    }
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
      pair.reach_axes = farthest(*part.body, is_head);
    }
    pair.swings = obstacle.on == Link::B || obstacle.on == Link::C;
    if (!is_head && obstacle.on == Link::Machine) pair.reach_axes = 0;  // Nothing that turns lies between.
  }

  /// The largest distance of a machine body's points from the rotary axes of a head, or from the spindle nose.
  double farthest(const SceneBody& body, bool is_head) const {
    const Vec3 b_axis = Vec3(0, 0, kinematics_.pivot) - kinematics_.spindle_from_b;
    const Vec3 center = !is_head             ? Vec3(Vec3::Zero())
                        : body.on == Link::B ? b_axis
                                             : Vec3(b_axis - kinematics_.b_from_c);
    if (is_head && body.on <= Link::Z) return 0;
    const solids::BoundingBox box = bounds(body.shape);
    const Vec3 corner = (box.min() - center).cwiseAbs().cwiseMax((box.max() - center).cwiseAbs());
    return corner.norm() + (is_head && body.on == Link::B ? kinematics_.b_from_c.norm() : 0);
  }

  const Scene& scene_;
  const kinematics::Kinematics& kinematics_;
  const MountedTool& tool_;
  BodyPairs result_;
};

}  // namespace

BodyPairs pairs_of(const Scene& scene, const kinematics::Kinematics& kinematics, const MountedTool& tool,
                   const Vec3& origin) {
  return PairsMaker(scene, kinematics, tool).make(origin);
}

}  // namespace isocnc::verification
