#include "debugger/session/backward_search.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "debugger/debuggee/block_effect.h"
#include "interpreter/kinematics/travel.h"

namespace isocnc::session {

/// Blocks of a window, and of one in which motions are planned.
static constexpr std::uint64_t kWindow = 8192;
static constexpr std::uint64_t kMotionWindow = 256;

/// Blocks before this one have begun. Where an error has ended the program, its block counts.
static std::uint64_t end_of_past(const simulation::Simulation& present) {
  const bool has_failed = present.has_ended() && present.run().ending == running::Ending::Error;
  return present.blocks() + (has_failed ? 1 : 0);
}

BackwardSearch::BackwardSearch(SessionState& state)
    : state_(state),
      start_(end_of_past(state.debuggee->present())),
      start_time_(state.debuggee->present().time()),
      searched_from_(start_) {}

std::optional<BackwardSearch::Hit> BackwardSearch::search_window() {
  const bool plans_motions = state_.exception_filters.judge_motions(state_.debuggee->machine());
  const bool looks_into_blocks = state_.block_watch().is_on();
  const std::uint64_t window = plans_motions || looks_into_blocks ? kMotionWindow : kWindow;
  const std::uint64_t from = searched_from_ > window ? searched_from_ - window : 0;
  std::optional<Hit> last;
  state_.debuggee->find_back(from, searched_from_, [&](const running::Block& block) {
    const auto hit = judge(block);
    if (hit) last = hit;
    return hit.has_value();
  });
  if (plans_motions)
    if (const auto block = find_overtravel_from(from); block && (!last || *block >= last->block))
      last = Hit{.block = *block};
  if (looks_into_blocks)
    if (auto hit = find_moment_from(from); hit && (!last || hit->block >= last->block)) last = std::move(hit);
  searched_from_ = from;
  return last;
}

std::optional<std::uint64_t> BackwardSearch::find_overtravel_from(std::uint64_t block) const {
  const debuggee::Debuggee& debuggee = *state_.debuggee;
  return debuggee.find_simulated_back(block, searched_from_, [&](simulation::Simulation& simulation) {
    bool is_beyond = false;
    simulation.trace_block([&](const kinematics::Move& move) {
      is_beyond = is_beyond || !kinematics::overtravels(debuggee.machine().motion, move).empty();
    });
    return is_beyond;
  });
}

/// The last moment within one of the blocks at which a run stops. In the block where the search began, it is before
/// that.
std::optional<BackwardSearch::Hit> BackwardSearch::find_moment_from(std::uint64_t block) const {
  const breakpoints::BlockWatch watch = state_.block_watch();
  std::optional<Hit> last;
  state_.debuggee->find_simulated_back(block, searched_from_, [&](simulation::Simulation& simulation) {
    const simulation::Simulation before = simulation;
    std::vector<breakpoints::InnerMoment> moments = watch.pass_block(simulation);
    for (; !moments.empty(); moments.pop_back()) {
      breakpoints::InnerMoment& moment = moments.back();
      if (before.blocks() + 1 >= start_ && !(moment.time < start_time_)) continue;
      simulation::Simulation there = before;
      moment.time > there.time() ? there.advance_in_block(moment.time) : there.step_instruction();
      const auto verdict = watch.judge(moment, state_.moment_of(there), before.blocks(),
                                       breakpoints::RunDirection::Backward, state_.language());
      if (!verdict.stops()) continue;
      last = Hit{.block = before.blocks(), .moment = std::move(moment)};
      return true;
    }
    return false;
  });
  return last;
}

double BackwardSearch::part_searched() const {
  return 1 - static_cast<double>(searched_from_) / static_cast<double>(std::max<std::uint64_t>(start_, 1));
}

static expressions::Moment moment_before(const running::Block& block) {
  return {.state = block.state, .registers = block.registers, .vgpl = block.vgpl, .line = block.line};
}

/// A block counts by itself, or by what it changes. In the second case the run stops after it.
std::optional<BackwardSearch::Hit> BackwardSearch::judge(const running::Block& block) {
  const bool is_stop = stops_before(block);
  if (changes_data(block)) return Hit{.block = block.number + 1, .is_change = true};
  if (is_stop) return Hit{.block = block.number};
  const debuggee::Debuggee& debuggee = *state_.debuggee;
  const breakpoints::ExceptionFilters& filters = state_.exception_filters;
  if (filters.judge_blocks() &&
      filters.find_exception(block, moment_before(block), debuggee.setup(), state_.language()))
    return Hit{.block = block.number};
  return std::nullopt;
}

/// Breakpoints in its line, or on its codes.
bool BackwardSearch::stops_before(const running::Block& block) {
  breakpoints::Breakpoints& breakpoints = state_.breakpoints;
  breakpoints::Breakpoints::BreakpointOutcome outcome;
  if (breakpoints.has_line(block.line))
    breakpoints.judge_line(moment_before(block), block.number, breakpoints::RunDirection::Backward, outcome);
  if (breakpoints.has_functions())
    breakpoints.judge_functions(block.tree, moment_before(block), block.number, breakpoints::RunDirection::Backward,
                                outcome);
  return !outcome.stopped.empty();
}

bool BackwardSearch::changes_data(const running::Block& block) {
  breakpoints::Breakpoints& breakpoints = state_.breakpoints;
  if (!breakpoints.has_data() || block.number + 1 >= start_) return false;
  const debuggee::BlockEffect effect = debuggee::effect_of(block, state_.debuggee->setup());
  const expressions::Moment after{
      .state = effect.state, .registers = effect.registers, .vgpl = block.vgpl, .line = block.line};
  breakpoints.start_trail(moment_before(block), trail_);
  breakpoints.read_arc(effect, after, trail_);
  breakpoints.read_data(after, trail_);
  breakpoints::Breakpoints::BreakpointOutcome outcome;
  breakpoints.judge_data(trail_, after, block.number, breakpoints::RunDirection::Backward, outcome);
  return !effect.has_error && !outcome.stopped.empty();
}

}  // namespace isocnc::session
