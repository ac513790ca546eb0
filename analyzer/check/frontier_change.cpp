#include "analyzer/check/frontier_change.h"

#include <cmath>

#include "interpreter/geometry/increment.h"

namespace isocnc::check {

using execution::Axis;
using execution::kAxisCount;
using geometry::Pose;

/// The maximum of a shift: the part of the exact range that PositionUse::far leaves free.
static constexpr double kFarthestShift = geometry::kFarthestStep / 2;

static double& coordinate(Pose& pose, int axis) { return axis < 3 ? pose.tip[axis] : axis == 3 ? pose.b : pose.c; }
static double coordinate(const Pose& pose, int axis) { return axis < 3 ? pose.tip[axis] : axis == 3 ? pose.b : pose.c; }

static bool has(execution::AxisSet axes, int axis) {
  return (axes & execution::axis_bit(static_cast<Axis>(axis))) != 0;
}

void PositionShift::drop(execution::AxisSet dropped) {
  axes &= static_cast<execution::AxisSet>(~dropped);
  for (int axis = 0; axis < kAxisCount; ++axis)
    if (!has(axes, axis)) coordinate(by, axis) = 0;
}

bool PositionShift::add(const PositionShift& other) {
  PositionShift sum = *this;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (!has(other.axes, axis)) continue;
    double& distance = coordinate(sum.by, axis);
    distance = geometry::advanced(distance, coordinate(other.by, axis));
    if (std::abs(distance) > kFarthestShift) return false;
    const execution::AxisSet bit = execution::axis_bit(static_cast<Axis>(axis));
    sum.axes = static_cast<execution::AxisSet>(distance == 0 ? sum.axes & ~bit : sum.axes | bit);
  }
  *this = sum;
  return true;
}

static void apply_to(Pose& pose, const PositionShift& shift) {
  for (int axis = 0; axis < kAxisCount; ++axis)
    if (has(shift.axes, axis))
      coordinate(pose, axis) = geometry::advanced(coordinate(pose, axis), coordinate(shift.by, axis));
}

void PositionShift::apply(Frontier& frontier) const {
  if (empty()) return;
  frontier.change_each([&](Groups& groups) {
    for (Group& group : groups) apply_to(group.state.position, *this);
  });
}

/// The shift from one position to another, which gives exactly that position; nothing where they are not whole steps,
/// or too far apart.
static std::optional<PositionShift> shift_between(const Pose& from, const Pose& to) {
  PositionShift shift;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const double before = coordinate(from, axis);
    const double after = coordinate(to, axis);
    if (before == after) continue;
    if (!geometry::is_on_step(before) || !geometry::is_on_step(after)) return std::nullopt;
    const double distance = geometry::advanced(after, -before);
    if (std::abs(distance) > kFarthestShift) return std::nullopt;
    coordinate(shift.by, axis) = distance;
    shift.axes |= execution::axis_bit(static_cast<Axis>(axis));
  }
  return shift;
}

/// Any group of the frontier; null if there is none.
static const Group* any_group(const Frontier& frontier) {
  if (!frontier.live.empty()) return &frontier.live[0];
  return frontier.waiting().empty() ? nullptr : &frontier.waiting().begin()->second[0];
}

/// The shift that turns `from` into `to`, if they differ in positions alone; nothing otherwise.
static std::optional<PositionShift> shift_between(const Frontier& from, const Frontier& to) {
  const Group* const before = any_group(from);
  const Group* const after = any_group(to);
  if (!before || !after) return from == to ? std::optional(PositionShift{}) : std::nullopt;
  const auto shift = shift_between(before->state.position, after->state.position);
  if (!shift) return std::nullopt;
  Frontier shifted = from;
  shift->apply(shifted);
  return shifted == to ? shift : std::nullopt;
}

/// A state with the position of another.
static execution::State placed_at(const geometry::Pose& position, execution::State state) {
  state.position = position;
  return state;
}

bool PassedState::passes(const execution::PlainEffects& row, const Group& before,
                         const rules::HouseRules* rules) const {
  execution::State alike = placed_at(before.state.position, state);
  execution::PlainRun::copy_unread(before.state, row, alike);
  if (alike != before.state || memory.judges_plain_motions(state)) return false;
  return !rules || (!rules->judges_plain_motions(house, state) &&
                    rules->guard(house, state) == rules->guard(before.house, before.state));
}

void PassedState::pass(const execution::PlainEffects& row, const execution::State& after,
                       const rules::HouseRules* rules) {
  execution::State passed = after;
  execution::PlainRun::copy_passed_on(state, row, passed);
  state = passed;
  memory.take(row, state);
  if (rules) rules->take(row, state, house);
}

bool PassedState::equals(const Group& group) const {
  return memory == group.memory && house == group.house && placed_at(group.state.position, state) == group.state;
}

void PassedState::apply(Group& group) const {
  group.state = placed_at(group.state.position, state);
  group.memory = memory;
  group.house = house;
}

void FrontierChange::apply(Frontier& frontier) const {
  shift.apply(frontier);
  if (state) state->apply(frontier.live[0]);
}

bool FrontierChange::passes(const PositionUse& use, const std::optional<execution::PlainEffects>& row,
                            const Frontier& before, const rules::HouseRules* rules) const {
  if (!shift.empty() && (use.far || (shift.axes & use.read) != 0 || (use.by_several && (shift.axes & use.set) != 0)))
    return false;
  return !state || (row && state->passes(*row, before.live[0], rules));
}

void FrontierChange::pass(const PositionUse& use, const std::optional<execution::PlainEffects>& row,
                          const Frontier& after, const rules::HouseRules* rules) {
  shift.drop(use.set);
  if (!state) return;
  state->pass(*row, after.live[0].state, rules);
  if (state->equals(after.live[0])) state.reset();
}

std::optional<FrontierChange> change_between(const Frontier& from, const Frontier& to) {
  if (const auto shift = shift_between(from, to)) return FrontierChange{.shift = *shift};
  if (from.live.size() != 1 || to.live.size() != 1) return std::nullopt;
  Frontier alike = to;
  Group& group = alike.live[0];
  static constexpr execution::PlainEffects kAnyRow{.letters = dialect::kLinearLetters};
  execution::PlainRun::copy_unread(from.live[0].state, kAnyRow, group.state);
  group.memory = from.live[0].memory;
  group.house = from.live[0].house;
  const auto shift = shift_between(from, alike);
  if (!shift) return std::nullopt;
  return FrontierChange{.shift = *shift, .state = PassedState::of(to.live[0])};
}

void note_line(const syntax::LineTree& line, const execution::State& before, const execution::State& after,
               bool is_judged, PositionUse& use) {
  bool moves = false;
  bool changes_frame = before.face_mounted != after.face_mounted || before.face != after.face;
  for (const syntax::Instruction& instruction : line.instructions) {
    const bool is_g = instruction.kind == syntax::InstructionKind::G;
    const dialect::GCode* const code = is_g ? instruction.g() : nullptr;
    moves |= instruction.is_motion();
    changes_frame |= is_g && (!code || code->is_frame());
  }
  if (!moves && !changes_frame) return;
  use.far |= is_far(before.position) || is_far(after.position);
  using dialect::ModalGroup;
  const bool is_length_known = !after.is_in_doubt(ModalGroup::Units) && !after.is_in_doubt(ModalGroup::Distance);
  const bool is_clear = !is_judged && !changes_frame && before.unknown == after.unknown && after.motion() != nullptr &&
                        is_length_known;  // Otherwise the axes that move are set to 0.
  if (is_clear && after.incremental()) return;
  dialect::LetterSet letters = 0;
  for (const syntax::Word& word : line.words)
    if (dialect::contains(dialect::kCoordinateLetters, word.letter)) letters |= dialect::letter_bit(word.letter);
  // A straight move under G49 is legal from any start. Otherwise the start matters: for an arc, or for a rotary axis
  // that must not turn.
  const bool is_straight = after.motion() && !after.motion()->is_arc();
  const execution::AxisSet read = !is_clear     ? execution::kAllAxes
                                  : is_straight ? execution::axes_of(letters & dialect::kRotaryLetters)
                                                : execution::kAllAxes;
  use.read |= static_cast<execution::AxisSet>(read & ~use.set);
  if (is_clear) use.set |= execution::axes_of(letters);
}

}  // namespace isocnc::check
