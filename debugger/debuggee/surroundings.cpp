#include "debugger/debuggee/surroundings.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "interpreter/verification/contact_log.h"
#include "interpreter/verification/encounter.h"
#include "interpreter/verification/verifier.h"

namespace isocnc::debuggee {

using motion::Stretch;
using simulation::Simulation;
using verification::BodyPairs;
using verification::Contact;
using verification::Encounter;
using verification::Neighbor;

geometry::Frame frame_in_force(const execution::State& state) {
  const geometry::Frame face = state.face_mounted ? state.face : geometry::Frame();
  return {.origin = state.workpiece_origin + face.origin, .axes = face.axes};
}

const verification::Scene* Surroundings::scene() const {
  if (!scene_) scene_ = load_();
  return scene_->get();
}

const BodyPairs& Surroundings::bodies_with(const execution::ToolCode& tool,
                                           const simulation::TimedMachine& machine) const {
  const auto known = bodies_.find(tool);
  if (known != bodies_.end()) return known->second;
  if (!origin_) origin_ = find_origin_();
  return bodies_
      .emplace(tool, verification::pairs_of(*scene(), machine.motion.kinematics,
                                            verification::mounted_tool(*scene(), machine, tool), *origin_))
      .first->second;
}

const std::vector<Neighbor>& Surroundings::neighbors_of(const Simulation& simulation) const {
  static const std::vector<Neighbor> kNone;
  if (!are_known()) return kNone;
  const execution::ToolCode& tool = simulation.run().state.tool;
  const kinematics::Coordinates joints = simulation.sample().joints;
  if (!last_ || last_->tool != tool || last_->joints != joints)
    last_ = {.tool = tool,
             .joints = joints,
             .neighbors = verification::neighbors_at(bodies_with(tool, simulation.machine()),
                                                     simulation.machine().motion.kinematics, joints)};
  return last_->neighbors;
}

static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double Surroundings::clearance_of(const Simulation& simulation) const {
  if (!are_known()) return kUnknown;
  double clearance = std::numeric_limits<double>::infinity();
  for (const Neighbor& each : neighbors_of(simulation)) clearance = std::min(clearance, each.clearance);
  return clearance;
}

double Surroundings::depth_of(const Simulation& simulation) const {
  if (!are_known()) return kUnknown;
  const std::vector<Neighbor>& neighbors = neighbors_of(simulation);
  return neighbors.empty() ? 0 : std::max(0.0, -neighbors.front().distance);
}

/// Gathers the stretches of a block, and finds the contacts that begin on them.
class BlockContacts {
 public:
  BlockContacts(const Surroundings& surroundings, const Simulation& before)
      : surroundings_(surroundings), machine_(before.machine()), tool_(before.run().state.tool) {
    if (const Stretch* const stretch = before.stretch_before()) stretch_before_ = *stretch;
  }

  void take(const running::Event& event, const Stretch* stretch) {
    if (stretch != nullptr) {
      stretches_.push_back(*stretch);
      lines_.push_back(event.line);
    } else if (const auto* const change = std::get_if<running::ToolEvent>(&event.what)) {
      examine();
      tool_ = change->tool;
      stretch_before_.reset();
    }
  }

  std::vector<Contact> contacts(const execution::State& state) {
    frame_ = frame_in_force(state);
    examine();
    return std::move(contacts_);
  }

 private:
  static constexpr std::size_t kBefore = std::numeric_limits<std::size_t>::max();

  /// The encounters of stretches that are contacts.
  std::vector<Encounter> contacts_on(std::span<const Stretch> stretches, const BodyPairs& bodies) const {
    std::vector<Encounter> found = verification::examine(stretches, bodies, machine_.motion.kinematics).encounters;
    std::erase_if(found, [](const Encounter& encounter) { return !encounter.is_contact; });
    return found;
  }

  void examine() {
    if (stretches_.empty()) return;
    const BodyPairs& bodies = surroundings_.bodies_with(tool_, machine_);
    verification::ContactLog log;
    const std::vector<Encounter> found = contacts_on(stretches_, bodies);
    // The stretch before matters only where the first one touches something.
    if (stretch_before_ && !found.empty() && found.front().stretch == 0)
      for (const Encounter& encounter : contacts_on({&*stretch_before_, 1}, bodies))
        log.take(encounter, {.number = 0, .line = kBefore, .frame = frame_}, bodies, tool_);
    for (const Encounter& encounter : found)
      log.take(encounter, {.number = encounter.stretch + 1, .line = lines_[encounter.stretch], .frame = frame_}, bodies,
               tool_);
    log.close_all();
    for (const Contact& contact : log.contacts())
      if (contact.line != kBefore) contacts_.push_back(contact);
    stretch_before_ = stretches_.back();
    stretches_.clear();
    lines_.clear();
  }

  const Surroundings& surroundings_;
  const simulation::TimedMachine& machine_;
  execution::ToolCode tool_;
  std::optional<Stretch> stretch_before_;
  std::vector<Stretch> stretches_;
  std::vector<std::size_t> lines_;  ///< Of the stretches.
  geometry::Frame frame_;
  std::vector<Contact> contacts_;
};

std::vector<Contact> Surroundings::pass_block(Simulation& simulation) const {
  if (!are_known()) {
    simulation.step_block();
    return {};
  }
  const bool was_in_block = simulation.is_in_block();
  const double time = simulation.time();
  BlockContacts block(*this, simulation);
  simulation.trace_stretches([&](const running::Event& event, const Stretch* stretch) { block.take(event, stretch); });
  std::vector<Contact> contacts = block.contacts(simulation.run().state);
  if (was_in_block) std::erase_if(contacts, [time](const Contact& contact) { return !(contact.time > time); });
  return contacts;
}

}  // namespace isocnc::debuggee
