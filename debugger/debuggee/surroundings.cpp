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
using verification::StretchPlace;

const verification::Scene* Surroundings::scene() const {
  if (!scene_) scene_ = load_();
  return scene_->get();
}

const geometry::Vec3& Surroundings::origin() const {
  if (!origin_) origin_ = find_origin_();
  return *origin_;
}

/// None without a blank, and where it would take too much memory.
const std::optional<removal::Workpiece>& Surroundings::workpiece() const {
  if (!workpiece_) {
    workpiece_.emplace();
    if (are_known()) *workpiece_ = verification::workpiece_of(*scene(), origin(), {});
    if (*workpiece_ && verification::coarser_spacing(**workpiece_)) workpiece_->reset();
  }
  return *workpiece_;
}

MaterialHistory* Surroundings::material() const {
  if (!material_ && has_material()) material_.emplace(debuggee_, *scene(), *workpiece());
  return material_ ? &*material_ : nullptr;
}

void Surroundings::forget_from(std::uint64_t blocks) {
  if (material_) material_->forget_from(blocks);
}

const BodyPairs& Surroundings::bodies_with(const execution::ToolCode& tool, bool is_place_known,
                                           const timing::TimedMachine& machine) const {
  const std::pair key(tool, is_place_known);
  const auto known = bodies_.find(key);
  if (known != bodies_.end()) return known->second;
  const verification::MountedTool mounted = verification::mounted_tool(*scene(), machine, tool, is_place_known);
  return bodies_.emplace(key, verification::pairs_of(*scene(), machine.motion.kinematics, mounted, origin()))
      .first->second;
}

const std::vector<Neighbor>& Surroundings::neighbors_of(const Simulation& simulation) const {
  static const std::vector<Neighbor> kNone;
  if (!are_known()) return kNone;
  const execution::ToolCode& tool = simulation.tool();
  const bool is_place_known = simulation.is_place_known();
  const kinematics::Coordinates joints = simulation.sample().joints;
  if (!last_ || last_->tool != tool || last_->is_place_known != is_place_known || last_->joints != joints)
    last_ = {.tool = tool,
             .is_place_known = is_place_known,
             .joints = joints,
             .neighbors = verification::neighbors_at(bodies_with(tool, is_place_known, simulation.machine()),
                                                     simulation.machine().motion.kinematics, joints)};
  return last_->neighbors;
}

static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Whether it is known where the tool is: whether it has a length, and where the machine is.
static bool is_tool_placed(const Simulation& simulation) {
  return simulation.is_place_known() && simulation.machine().length_of(simulation.tool()).is_known;
}

double Surroundings::clearance_of(const Simulation& simulation) const {
  if (!are_known() || !is_tool_placed(simulation)) return kUnknown;
  double clearance = std::numeric_limits<double>::infinity();
  for (const Neighbor& each : neighbors_of(simulation)) clearance = std::min(clearance, each.clearance);
  return clearance;
}

double Surroundings::depth_of(const Simulation& simulation) const {
  if (!are_known() || !is_tool_placed(simulation)) return kUnknown;
  const std::vector<Neighbor>& neighbors = neighbors_of(simulation);
  return neighbors.empty() ? 0 : std::max(0.0, -neighbors.front().distance);
}

/// Gathers the stretches of a block, and finds what happens on them.
class BlockPass {
 public:
  BlockPass(const Surroundings& surroundings, const Surroundings::BlockSearch& wanted, const Simulation& before)
      : surroundings_(surroundings),
        wanted_(wanted),
        machine_(before.machine()),
        tool_(before.tool()),
        is_place_known_(before.is_place_known()) {
    if (const Stretch* const stretch = before.stretch_before()) stretch_before_ = *stretch;
    was_place_known_ = before.was_place_known();
    for (const SurroundingsLimit& limit : wanted.limits)
      was_beyond_.push_back(limit.is_of_material() || limit.is_beyond(surroundings.neighbors_of(before)));
  }

  void take(const RecordedPiece& piece) {
    if (piece.stretch) {
      if (piece.timed.is_at_known_place() != is_place_known_) change_place(piece.timed.is_at_known_place());
      stretches_.push_back(*piece.stretch);
      lines_.push_back(piece.timed.event.line);
    } else if (const auto* const change = std::get_if<running::ToolEvent>(&piece.timed.event.what)) {
      change_place(piece.timed.ends_at_known_place);
      tool_ = change->tool;
      changes_tool_ = true;
      stretch_before_.reset();
    }
  }

  Surroundings::PassedBlock finish(const Simulation& after) {
    frame_ = after.run().state.frame_in_force();
    is_in_inches_ = after.run().state.in_inches();
    examine();
    for (std::size_t i = 0; changes_tool_ && i < wanted_.limits.size(); ++i)
      if (!was_beyond_[i] && wanted_.limits[i].is_beyond(surroundings_.neighbors_of(after)))
        passed_.crossings.push_back({.time = after.time(), .limit = i});
    return std::move(passed_);
  }

 private:
  static constexpr std::size_t kBefore = std::numeric_limits<std::size_t>::max();

  /// From here on what is on the spindle is compared, or not.
  void change_place(bool is_known) {
    examine();
    is_place_known_ = is_known;
  }

  void examine() {
    if (stretches_.empty()) return;
    const BodyPairs& bodies = surroundings_.bodies_with(tool_, is_place_known_, machine_);
    if (wanted_.contacts) find_contacts(bodies);
    for (const Stretch& stretch : stretches_)
      for (std::size_t i = 0; i < wanted_.limits.size(); ++i)
        for (const double time : crossings_on(wanted_.limits[i], stretch, bodies))
          passed_.crossings.push_back({.time = time, .limit = i});
    stretch_before_ = stretches_.back();
    was_place_known_ = is_place_known_;
    stretches_.clear();
    lines_.clear();
  }

  std::vector<double> crossings_on(const SurroundingsLimit& limit, const Stretch& stretch,
                                   const BodyPairs& bodies) const {
    if (limit.is_of_material()) return {};
    return crossings_of(limit, stretch, bodies, machine_.motion.kinematics);
  }

  /// The encounters of stretches that are contacts.
  std::vector<Encounter> contacts_on(std::span<const Stretch> stretches, const BodyPairs& bodies) const {
    std::vector<Encounter> found = verification::examine(stretches, bodies, machine_.motion.kinematics).encounters;
    std::erase_if(found, [](const Encounter& encounter) { return !encounter.is_contact(); });
    return found;
  }

  void find_contacts(const BodyPairs& bodies) {
    verification::ContactLog log;
    const std::vector<Encounter> found = contacts_on(stretches_, bodies);
    // The stretch before matters only where the first one touches something.
    if (stretch_before_ && !found.empty() && found.front().stretch == 0) {
      const BodyPairs& compared = surroundings_.bodies_with(tool_, was_place_known_, machine_);
      log.take(
          contacts_on({&*stretch_before_, 1}, compared),
          [&](std::size_t) -> StretchPlace { return {.number = 0, .line = kBefore, .frame = frame_}; }, compared,
          tool_);
    }
    const auto place_of = [&](std::size_t stretch) -> StretchPlace {
      return {.number = stretch + 1, .line = lines_[stretch], .frame = frame_, .is_in_inches = is_in_inches_};
    };
    log.take(found, place_of, bodies, tool_);
    log.close_all();
    // Where a block ends, the next one begins, and its line is shown.
    constexpr double kBeforeEnd = 1e-6;  // s
    const double inside = stretches_.back().start + stretches_.back().duration - kBeforeEnd;
    for (Contact& contact : log.contacts()) {
      if (contact.line != kBefore) {
        passed_.contacts.push_back(contact);
      } else if (-contact.distance > contact.levels.front().depth + kDeeper) {
        contact.worst_time = std::min(contact.worst_time, inside);
        passed_.deeper.push_back(contact);
      }
    }
  }

  const Surroundings& surroundings_;
  const Surroundings::BlockSearch& wanted_;
  const timing::TimedMachine& machine_;
  execution::ToolCode tool_;
  bool is_place_known_;
  std::optional<Stretch> stretch_before_;
  bool was_place_known_ = true;   ///< On that stretch.
  std::vector<bool> was_beyond_;  ///< Each limit, at the start.
  bool changes_tool_ = false;
  std::vector<Stretch> stretches_;
  std::vector<std::size_t> lines_;  ///< Of the stretches.
  geometry::Frame frame_;
  bool is_in_inches_ = false;
  Surroundings::PassedBlock passed_;
};

/// Whether it matters what a block does to the material.
static bool wants_material(const Surroundings::BlockSearch& wanted) {
  return wanted.contacts || std::any_of(wanted.limits.begin(), wanted.limits.end(),
                                        [](const SurroundingsLimit& limit) { return limit.is_of_material(); });
}

Surroundings::PassedBlock Surroundings::pass_block(Simulation& simulation, const BlockSearch& wanted) const {
  if (!are_known()) {
    simulation.step_block();
    return {};
  }
  const bool was_in_block = simulation.is_in_block();
  const double time = simulation.time();
  BlockPass block(*this, wanted, simulation);
  const BlockRecord record = record_block(simulation);
  for (const RecordedPiece& piece : record.pieces) block.take(piece);
  PassedBlock passed = block.finish(simulation);
  if (MaterialHistory* const material = wants_material(wanted) ? this->material() : nullptr) {
    const auto answers = material->examine(was_in_block ? material->record_of(record.block) : record,
                                           {.contacts = wanted.contacts, .limits = wanted.limits});
    passed.contacts.insert(passed.contacts.end(), answers.contacts.begin(), answers.contacts.end());
    passed.deeper.insert(passed.deeper.end(), answers.deeper.begin(), answers.deeper.end());
    passed.crossings.insert(passed.crossings.end(), answers.crossings.begin(), answers.crossings.end());
  }
  if (!was_in_block) return passed;
  const auto is_past = [time](const auto& each) { return !(each.time > time); };
  std::erase_if(passed.contacts, is_past);
  std::erase_if(passed.deeper, [time](const Contact& each) { return !(each.worst_time > time); });
  std::erase_if(passed.crossings, is_past);
  return passed;
}

}  // namespace isocnc::debuggee
