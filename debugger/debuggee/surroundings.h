#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "debugger/debuggee/material_history.h"
#include "debugger/debuggee/surroundings_limit.h"
#include "interpreter/simulation/simulation.h"
#include "interpreter/verification/contact.h"
#include "interpreter/verification/surroundings.h"

namespace isocnc::debuggee {

/// What surrounds the machine: how near it is to each obstacle, when it touches one, and what remains of the blank.
/// Everything is judged as the machine moves now, whatever has been changed by hand. The scene is loaded when it is
/// first asked for, and nothing is cut before somebody asks about material. The setup stays where the run as it was
/// launched has it.
class Surroundings {
 public:
  /// Loads the scene; null if nothing is known of the surroundings.
  using LoadScene = std::function<std::shared_ptr<const verification::Scene>()>;
  /// Finds the origin of the setup's frame; machine frame, mm.
  using FindOrigin = std::function<geometry::Vec3()>;

  /// Refers to the debuggee. Both functions are called once, when they are needed.
  Surroundings(const Debuggee& debuggee, LoadScene load, FindOrigin find_origin)
      : debuggee_(debuggee), load_(std::move(load)), find_origin_(std::move(find_origin)) {}
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  /// Whether there is a scene.
  bool are_known() const { return scene() != nullptr; }

  /// The obstacles around the machine as it stands in the simulation, nearest first; none without a scene. Valid until
  /// the next call.
  const std::vector<verification::Neighbor>& neighbors_of(const simulation::Simulation& simulation) const;

  /// The smallest distance of what should stay away from an obstacle, mm; infinite if nothing should, NaN without a
  /// scene and where it is not known where the tool is.
  double clearance_of(const simulation::Simulation& simulation) const;
  /// How deep the machine is in an obstacle, mm; 0 if it is in none, NaN as above.
  double depth_of(const simulation::Simulation& simulation) const;

  /// Whether there is a blank to be cut.
  bool has_material() const { return workpiece().has_value(); }
  /// What remains of it; null without a blank. Moments are those of simulations of the debuggee's run.
  MaterialHistory* material() const;
  /// Whether somebody has asked for it, so that it is cut. For tests.
  bool is_material_cut() const { return material_.has_value(); }
  /// The run has been changed where this many blocks had been executed.
  void forget_from(std::uint64_t blocks);

  /// What happens on the way through a block.
  struct PassedBlock {
    /// Contacts that begin, by time, each with the depth that it reaches in this block.
    std::vector<verification::Contact> contacts;
    std::vector<verification::Contact> deeper;  ///< Those that go on from before the block and get deeper in it.
    /// Where the machine comes to be beyond one of the limits: within a motion, at the end of a tool change or, for
    /// limits of the material, at the begin of a block.
    std::vector<LimitCrossing> crossings;
  };
  /// What is looked for in a block.
  struct BlockSearch {
    bool contacts = false;
    std::vector<SurroundingsLimit> limits;
  };
  /// Takes the simulation to the end of the block in progress or, between two blocks, of the next one. An obstacle that
  /// the stretch before touches is no new contact; a tool that is mounted in an obstacle touches it when it is moved
  /// next. Contacts with the material are those of error severity, as a verification tells them.
  PassedBlock pass_block(simulation::Simulation& simulation, const BlockSearch& wanted) const;

 private:
  friend class BlockPass;

  /// The obstacles around a pose of the machine.
  struct KnownPose {
    execution::ToolCode tool;
    bool is_place_known = true;
    kinematics::Coordinates joints;
    std::vector<verification::Neighbor> neighbors;
  };

  const verification::Scene* scene() const;
  const geometry::Vec3& origin() const;
  const std::optional<removal::Workpiece>& workpiece() const;
  const verification::BodyPairs& bodies_with(const execution::ToolCode& tool, bool is_place_known,
                                             const timing::TimedMachine& machine) const;

  const Debuggee& debuggee_;
  LoadScene load_;
  FindOrigin find_origin_;
  mutable std::optional<std::shared_ptr<const verification::Scene>> scene_;  ///< None before it has been loaded.
  mutable std::optional<geometry::Vec3> origin_;                             ///< None before it has been found.
  mutable std::map<std::pair<execution::ToolCode, bool>, verification::BodyPairs> bodies_;  ///< As for bodies_with().
  mutable std::optional<KnownPose> last_;
  mutable std::optional<std::optional<removal::Workpiece>> workpiece_;  ///< None before it has been asked for.
  mutable std::optional<MaterialHistory> material_;                     ///< None before it has been asked for.
};

}  // namespace isocnc::debuggee
