#include "debugger/breakpoints/breakpoints.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "debugger/debuggee/block_effect.h"

namespace isocnc::breakpoints {

static bool are_same(const FunctionBreakpoint& a, const FunctionBreakpoint& b) { return a.code == b.code; }
static bool are_same(const DataBreakpoint& a, const DataBreakpoint& b) { return a.watched.name == b.watched.name; }

/// Breakpoints that are set again as they were keep their hits.
template <class Some>
static void go_on_counting(std::vector<Some>& breakpoints, std::vector<Some>& before) {
  for (Some& breakpoint : breakpoints) {
    const auto old = std::find_if(before.begin(), before.end(), [&](const Some& each) {
      return are_same(each, breakpoint) && each.rules.text == breakpoint.rules.text;
    });
    if (old != before.end()) std::swap(breakpoint.counter, old->counter);
  }
}

void Breakpoints::set_functions(std::vector<FunctionBreakpoint> breakpoints) {
  go_on_counting(breakpoints, functions_);
  functions_ = std::move(breakpoints);
}

void Breakpoints::set_data(std::vector<DataBreakpoint> breakpoints) {
  go_on_counting(breakpoints, data_);
  data_ = std::move(breakpoints);
  ++revision_;
}

std::vector<debuggee::SurroundingsLimit> Breakpoints::limits() const {
  std::vector<debuggee::SurroundingsLimit> limits;
  for (const DataBreakpoint& each : data_)
    if (each.watched.limit) limits.push_back(*each.watched.limit);
  return limits;
}

void Breakpoints::judge_limit(std::size_t limit, const expressions::Moment& moment, std::uint64_t block,
                              RunDirection direction, BreakpointOutcome& outcome) {
  for (DataBreakpoint& each : data_)
    if (each.watched.limit && limit-- == 0) return reach(each, moment, block, direction, outcome);
}

std::string Breakpoints::name_of(std::int64_t id) const {
  const auto found = std::find_if(data_.begin(), data_.end(), [id](const auto& each) { return each.id == id; });
  return found == data_.end() ? std::string() : found->watched.name;
}

bool Breakpoints::has_thresholds() const {
  return std::any_of(data_.begin(), data_.end(), [](const auto& each) { return each.watched.threshold.has_value(); });
}

void Breakpoints::set_lines(std::vector<LineBreakpoint> breakpoints, std::size_t line_count) {
  for (LineBreakpoint& breakpoint : breakpoints) {
    const auto [begin, end] = lines_.equal_range(breakpoint.line);
    const auto old =
        std::find_if(begin, end, [&](const auto& each) { return each.second.rules.text == breakpoint.rules.text; });
    if (old != end) std::swap(breakpoint.counter, old->second.counter);
  }
  lines_.clear();
  bits_.assign(line_count / 64 + 1, 0);
  for (LineBreakpoint& breakpoint : breakpoints) {
    const std::size_t line = breakpoint.line;
    if (line >= line_count) continue;
    bits_[line / 64] |= std::uint64_t{1} << (line % 64);
    lines_.emplace(line, std::move(breakpoint));
  }
}

void Breakpoints::reach(Breakpoint& breakpoint, const expressions::Moment& moment, std::uint64_t block,
                        RunDirection direction, BreakpointOutcome& outcome) {
  const BreakpointRules& rules = breakpoint.rules;
  if (rules.condition && !rules.condition->holds_at(moment)) return;
  if (direction == RunDirection::Backward && rules.message) return;
  if (rules.hits && !rules.hits->admits(breakpoint.counter.count(block))) return;
  if (rules.message) {
    outcome.messages.push_back(rules.message->at(moment));
  } else {
    outcome.stopped.push_back(breakpoint.id);
  }
}

void Breakpoints::judge_line(const expressions::Moment& moment, std::uint64_t block, RunDirection direction,
                             BreakpointOutcome& outcome) {
  const auto [begin, end] = lines_.equal_range(moment.line);
  for (auto each = begin; each != end; ++each) reach(each->second, moment, block, direction, outcome);
}

void Breakpoints::judge_functions(const syntax::LineTree& tree, const expressions::Moment& moment, std::uint64_t block,
                                  RunDirection direction, BreakpointOutcome& outcome) {
  for (FunctionBreakpoint& each : functions_)
    if (each.code.is_in(tree)) reach(each, moment, block, direction, outcome);
}

void Breakpoints::start_trail(const expressions::Moment& moment, expressions::ValueTrail& trail) const {
  trail.width = data_.size();
  trail.values.clear();
  read_data(moment, trail);
}

void Breakpoints::read_data(const expressions::Moment& moment, expressions::ValueTrail& trail) const {
  for (const DataBreakpoint& each : data_)
    trail.values.push_back(each.watched.limit ? 0 : each.watched.value.at(moment));
}

void Breakpoints::read_arc(const debuggee::BlockEffect& effect, const expressions::Moment& moment,
                           expressions::ValueTrail& trail) const {
  if (effect.has_error) return;
  execution::State state = effect.state;
  for (const geometry::Pose& point : effect.on_arc) {
    state.position = point;
    read_data({.state = state,
               .registers = effect.registers,
               .vgpl = moment.vgpl,
               .line = moment.line,
               .override_percent = moment.override_percent,
               .playback = moment.playback},
              trail);
  }
}

void Breakpoints::judge_data(const expressions::ValueTrail& trail, const expressions::Moment& moment,
                             std::uint64_t block, RunDirection direction, BreakpointOutcome& outcome) {
  // Other breakpoints may have been set since the trail was begun.
  if (data_.empty() || trail.width != data_.size() || trail.values.size() % trail.width != 0) return;
  for (std::size_t i = 0; i < data_.size(); ++i)
    if (data_[i].watched.find_change(trail, i)) reach(data_[i], moment, block, direction, outcome);
}

std::string Breakpoints::description(std::int64_t id, const expressions::ValueTrail& trail) const {
  for (std::size_t i = 0; i < data_.size() && i < trail.width; ++i) {
    if (data_[i].id != id) continue;
    if (const auto change = data_[i].watched.find_change(trail, i))
      return fmt::format("{}: {} -> {}", data_[i].watched.name, expressions::show_value(change->first),
                         expressions::show_value(change->second));
  }
  return {};
}

void Breakpoints::forget_hits_from(std::uint64_t block) {
  for (auto& [line, breakpoint] : lines_) breakpoint.counter.forget_from(block);
  for (FunctionBreakpoint& each : functions_) each.counter.forget_from(block);
  for (DataBreakpoint& each : data_) each.counter.forget_from(block);
}

}  // namespace isocnc::breakpoints
