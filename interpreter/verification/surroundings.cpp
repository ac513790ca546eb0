#include "interpreter/verification/surroundings.h"

#include <algorithm>
#include <optional>

#include "interpreter/motion/planner.h"
#include "interpreter/solids/clearance.h"
#include "interpreter/verification/body_distance.h"
#include "interpreter/verification/encounter.h"

namespace isocnc::verification {

using Eigen::Isometry3d;
using geometry::Vec3;

namespace {

/// The nearest part of each obstacle.
class NeighborList {
 public:
  explicit NeighborList(const BodyPairs& bodies) : bodies_(bodies), nearest_(bodies.obstacles.size()) {}

  void take(const BodyPair& pair, double distance, const Vec3& point, bool touches) {
    const Obstacle& obstacle = bodies_.obstacles[pair.obstacle];
    std::optional<Neighbor>& known = nearest_[pair.obstacle];
    if (!known) known = {.whom = obstacle.name, .role = obstacle.body->role, .described = obstacle.body->described};
    known->touches = known->touches || touches;
    if (pair.is_watched) known->clearance = std::min(known->clearance, distance);
    if (!(distance < known->distance)) return;
    known->who = bodies_.parts[pair.part].name;
    known->distance = distance;
    known->point = point;
  }

  std::vector<Neighbor> sorted() const {
    std::vector<Neighbor> sorted;
    for (const auto& each : nearest_)
      if (each) sorted.push_back(*each);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Neighbor& a, const Neighbor& b) { return a.distance < b.distance; });
    return sorted;
  }

 private:
  const BodyPairs& bodies_;
  std::vector<std::optional<Neighbor>> nearest_;
};

/// The distance of a pair where the joints are at `joints`; `sufficient` as in solids::clearance().
solids::Clearance distance_of(const BodyPair& pair, const BodyPairs& bodies, const kinematics::Kinematics& kinematics,
                              const kinematics::Coordinates& joints, double sufficient) {
  const MovingPart& part = bodies.parts[pair.part];
  const Obstacle& obstacle = bodies.obstacles[pair.obstacle];
  const kinematics::Link carrier = pair.revolved ? spindle_link(kinematics) : part.on;
  Isometry3d place = link_pose(kinematics, obstacle.on, joints).inverse() * link_pose(kinematics, carrier, joints);
  const Vec3 origin = pair.revolved ? Vec3(0, 0, part.offset - bodies.tool_length) : part.shift;
  place.translation() = place * origin - obstacle.shift;
  return pair.revolved ? distance_of(pair, obstacle, {place.translation(), place.linear().col(2)}, sufficient)
                       : distance_of(part, obstacle, place, sufficient);
}

}  // namespace

NeighborsAtHome neighbors_at_home(const Scene& scene, const timing::TimedMachine& machine) {
  const kinematics::Kinematics& kinematics = machine.motion.kinematics;
  const kinematics::Coordinates joints = inverse(kinematics, kinematics::coordinates(machine.home), 0);
  // Only bodies of the machine are made to be so, wherever the setup is, and no tool is mounted.
  Scene bare;
  bare.machine = scene.machine;
  const BodyPairs bodies = pairs_of(bare, kinematics, {}, Vec3::Zero());
  const auto index_of = [&](const SceneBody* body) { return static_cast<std::size_t>(body - bare.machine.data()); };
  NeighborsAtHome found;
  for (const BodyPair& pair : bodies.pairs) {
    const double near = std::max(scene.clearance, kContactDistance);
    const double distance = distance_of(pair, bodies, kinematics, joints, near).upper;
    const MachineBodies both{.moving = index_of(bodies.parts[pair.part].body),
                             .other = index_of(bodies.obstacles[pair.obstacle].body)};
    if (distance <= kContactDistance)
      found.touching.push_back(both);
    else if (distance < near)
      found.near.push_back(both);
  }
  return found;
}

std::vector<Neighbor> neighbors_at(const BodyPairs& bodies, const kinematics::Kinematics& kinematics,
                                   const kinematics::Coordinates& joints) {
  NeighborList nearest(bodies);
  for (const BodyPair& pair : bodies.pairs) {
    const Obstacle& obstacle = bodies.obstacles[pair.obstacle];
    const solids::Clearance found = pair.counted(distance_of(pair, bodies, kinematics, joints, solids::kExact));
    nearest.take(
        pair, found.upper - pair.slack,
        point_on_link(kinematics, workpiece_link(kinematics), obstacle.on, joints, found.on_obstacle + obstacle.shift),
        found.upper <= kContactDistance);
  }
  return nearest.sorted();
}

std::vector<Neighbor> neighbors_along(const BodyPairs& bodies, const kinematics::Machine& machine,
                                      const kinematics::Move& move, double within) {
  motion::Planner planner(machine);
  planner.push(move);
  planner.rest();
  std::vector<motion::Stretch> stretches;
  while (const motion::Stretch* const stretch = planner.next()) stretches.push_back(*stretch);
  BodyPairs wide = bodies;
  for (BodyPair& pair : wide.pairs) {
    pair.limit = std::max(pair.limit, within);
    pair.reports_near = true;
  }
  NeighborList nearest(wide);
  for (const Encounter& encounter : examine(stretches, wide, machine.kinematics).encounters)
    nearest.take(wide.pairs[encounter.pair], encounter.distance, encounter.point, encounter.is_contact());
  return nearest.sorted();
}

}  // namespace isocnc::verification
