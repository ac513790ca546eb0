#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "interpreter/simulation/simulation.h"
#include "interpreter/verification/contact.h"
#include "interpreter/verification/surroundings.h"

namespace isocnc::debuggee {

/// A scene, and where its setup stands.
struct PlacedScene {
  std::shared_ptr<const verification::Scene> scene;  ///< Null if nothing is known of the surroundings.
  geometry::Vec3 origin = geometry::Vec3::Zero();    ///< Of the setup's frame; machine frame, mm.
};

/// What surrounds the machine: how near it is to each obstacle, and when it touches one. Everything is judged as the
/// machine moves now, whatever has been changed by hand. The scene is loaded when it is first asked for. The setup
/// stays where the run as it was launched has it.
class Surroundings {
 public:
  using Load = std::function<PlacedScene()>;

  explicit Surroundings(Load load) : load_(std::move(load)) {}
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  /// Whether there is a scene.
  bool are_known() const { return scene() != nullptr; }

  /// The obstacles around the machine as it stands in the simulation, nearest first; none without a scene. Valid until
  /// the next call.
  const std::vector<verification::Neighbor>& neighbors_of(const simulation::Simulation& simulation) const;

  /// Takes the simulation to the end of the block in progress or, between two blocks, of the next one. Returns the
  /// contacts that begin on the way, by time, each with the depth that it reaches in this block. An obstacle that the
  /// tool touches already when a stretch begins is no new contact; a tool that is mounted in an obstacle touches it
  /// when it is moved next.
  std::vector<verification::Contact> pass_block(simulation::Simulation& simulation) const;

 private:
  friend class BlockContacts;

  /// The obstacles around a pose of the machine.
  struct KnownPose {
    execution::ToolCode tool;
    kinematics::Coordinates joints;
    std::vector<verification::Neighbor> neighbors;
  };

  const verification::Scene* scene() const;
  const verification::BodyPairs& bodies_with(const execution::ToolCode& tool,
                                             const simulation::TimedMachine& machine) const;

  Load load_;
  mutable std::optional<PlacedScene> placed_;  ///< None before it has been loaded.
  mutable std::map<execution::ToolCode, verification::BodyPairs> bodies_;
  mutable std::optional<KnownPose> last_;
};

}  // namespace isocnc::debuggee
