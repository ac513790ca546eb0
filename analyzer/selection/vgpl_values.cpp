#include "analyzer/selection/vgpl_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "analyzer/check/jump_map.h"
#include "interpreter/verification/verified_run.h"

namespace isocnc::selection {

using syntax::Comparison;
using verification::Gap;
using verification::Unverified;

static constexpr double kInfinity = std::numeric_limits<double>::infinity();

static bool compares_vgpl(const syntax::Jump& jump) {
  return jump.condition_is_known() && jump.variable == syntax::Jump::kVgplVariable;
}

/// The comparison that is true where this one is false.
static Comparison opposite(Comparison comparison) {
  switch (comparison) {
    case Comparison::Equal:
      return Comparison::NotEqual;
    case Comparison::NotEqual:
      return Comparison::Equal;
    case Comparison::Less:
      return Comparison::GreaterEqual;
    case Comparison::GreaterEqual:
      return Comparison::Less;
    case Comparison::Greater:
      return Comparison::LessEqual;
    case Comparison::LessEqual:
      return Comparison::Greater;
    case Comparison::Invalid:
      break;
  }
  return Comparison::Invalid;
}

/// A value between two others, the integer nearest to 0 if there is one; none if no value is between them.
static std::optional<double> value_between(double low, double high) {
  if (low < 0 && high > 0) return 0;
  const double integer = low >= 0 ? std::floor(low) + 1 : std::ceil(high) - 1;
  if (low < integer && integer < high) return integer;
  // Above 2^53 all numbers are integers, and the next one is farther away than 1.
  const double inside = std::isinf(low) || std::isinf(high)
                            ? std::nextafter(low >= 0 ? low : high, low >= 0 ? high : low)
                            : low / 2 + high / 2;
  if (low < inside && inside < high && std::isfinite(inside)) return inside;
  return std::nullopt;
}

VgplValues::VgplValues(std::string_view text) : VgplValues(text, {}) {}

VgplValues::VgplValues(std::string_view text, const std::vector<double>& more_constants) : constants_(more_constants) {
  check::each_event_in(text, [&](const check::FlowEvent& event) {
    if (event.kind == check::FlowEvent::Kind::Label) return;
    const bool is_jump = event.kind == check::FlowEvent::Kind::Jump;
    steps_.push_back({.line = event.line, .assigned = is_jump ? 0 : event.reg, .jump = event.jump});
    if (is_jump && compares_vgpl(event.jump)) constants_.push_back(event.jump.value);
  });
  std::sort(constants_.begin(), constants_.end());
  constants_.erase(std::unique(constants_.begin(), constants_.end()), constants_.end());
  cut_into_cells();
}

void VgplValues::cut_into_cells() {
  const auto add = [&](std::optional<double> value) {
    cells_.push_back({.value = value.value_or(0), .is_open = value.has_value()});
  };
  double below = -kInfinity;
  for (const double constant : constants_) {
    add(value_between(std::exchange(below, constant), constant));
    add(std::isfinite(constant) ? std::optional(constant) : std::nullopt);
  }
  add(value_between(below, kInfinity));
  for (const bool of_integers : {true, false})
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if ((cells_[i].value == std::floor(cells_[i].value)) == of_integers) order_.push_back(i);
}

/// The index of a constant's cell.
std::size_t VgplValues::cell_of(double constant) const {
  const auto place = std::lower_bound(constants_.begin(), constants_.end(), constant);
  return 2 * static_cast<std::size_t>(place - constants_.begin()) + 1;
}

VgplValues::MetJumps VgplValues::met_by(const simulation::TakenPath& run) const {
  MetJumps met;
  met.jumps.reserve(run.decisions.size());
  check::RegisterSet assigned = 0;
  auto decision = run.decisions.begin();
  for (std::size_t i = 0; i < steps_.size() && decision != run.decisions.end(); ++i) {
    const FlowStep& step = steps_[i];
    if (step.assigned > 0) {
      if (run.has_executed(step.line)) assigned |= check::register_bit(step.assigned);
      continue;
    }
    if (step.line != decision->line) continue;
    met.jumps.push_back({.step = i, .taken = (decision++)->taken});
    const bool is_on_register = step.jump.condition_is_known() && step.jump.variable > 0;
    if (is_on_register && (assigned & check::register_bit(step.jump.variable)) == 0) met.on_registers.push_back(i);
  }
  return met;
}

void VgplValues::take(const simulation::TakenPath& run) {
  MetJumps met = met_by(run);
  for (const std::size_t step : met.on_registers) {
    const auto [known, is_new] = register_jumps_.emplace(steps_[step].jump.variable, step);
    if (!is_new) known->second = std::min(known->second, step);
  }
  close(cells_along(met.jumps));
  runs_.push_back(std::move(met.jumps));
}

std::vector<int> VgplValues::unassigned_registers(const simulation::TakenPath& run) const {
  std::vector<int> registers;
  for (const std::size_t step : met_by(run).on_registers) registers.push_back(steps_[step].jump.variable);
  std::sort(registers.begin(), registers.end());
  registers.erase(std::unique(registers.begin(), registers.end()), registers.end());
  return registers;
}

VgplValues::CellSet VgplValues::cells_along(const simulation::TakenPath& run) const {
  return cells_along(met_by(run).jumps);
}

/// The cells whose values decide all these jumps alike.
VgplValues::CellSet VgplValues::cells_along(const std::vector<MetJump>& met) const {
  std::size_t first = 0;
  std::size_t last = cells_.size() - 1;
  std::vector<std::size_t> excluded;
  for (const MetJump& each : met) {
    const syntax::Jump& jump = steps_[each.step].jump;
    if (!compares_vgpl(jump)) continue;
    const std::size_t cell = cell_of(jump.value);
    const Comparison comparison = each.taken ? jump.comparison : opposite(jump.comparison);
    if (comparison == Comparison::NotEqual) excluded.push_back(cell);
    if (comparison == Comparison::Equal || comparison == Comparison::GreaterEqual) first = std::max(first, cell);
    if (comparison == Comparison::Equal || comparison == Comparison::LessEqual) last = std::min(last, cell);
    if (comparison == Comparison::Greater) first = std::max(first, cell + 1);
    if (comparison == Comparison::Less) last = std::min(last, cell - 1);
  }
  std::sort(excluded.begin(), excluded.end());
  CellSet along(cells_.size());
  for (std::size_t i = first; i <= last; ++i) along[i] = !std::binary_search(excluded.begin(), excluded.end(), i);
  return along;
}

VgplValues::CellSet VgplValues::open_cells() const {
  CellSet open(cells_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) open[i] = cells_[i].is_open;
  return open;
}

void VgplValues::close(const CellSet& cells) {
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].is_open = cells_[i].is_open && !cells[i];
}

std::optional<double> VgplValues::next() const {
  const auto place = std::find_if(order_.begin(), order_.end(), [&](std::size_t i) { return cells_[i].is_open; });
  return place == order_.end() ? std::nullopt : std::optional(cells_[*place].value);
}

/// The jump at which the value that comes next leaves the paths of all runs: an index into steps_.
std::optional<std::size_t> VgplValues::open_jump() const {
  const std::optional<double> value = next();
  if (!value) return std::nullopt;
  std::size_t deepest = 0;
  for (const std::vector<MetJump>& run : runs_) {
    const auto leaves = std::find_if(run.begin(), run.end(), [&](const MetJump& each) {
      const syntax::Jump& jump = steps_[each.step].jump;
      return compares_vgpl(jump) && running::holds(jump, *value) != each.taken;
    });
    if (leaves != run.end()) deepest = std::max(deepest, leaves->step);
  }
  return deepest;
}

/// The jump of VGPL, if there is one, and the first one of each register, from above. Indices into steps_.
std::vector<std::size_t> VgplValues::open_jumps() const {
  std::vector<std::size_t> jumps;
  for (const auto& [variable, step] : register_jumps_) jumps.push_back(step);
  std::sort(jumps.begin(), jumps.end());
  if (const std::optional<std::size_t> jump = open_jump()) jumps.insert(jumps.begin(), *jump);
  return jumps;
}

Unverified VgplValues::gap_at(std::size_t step) const {
  const syntax::Jump& jump = steps_[step].jump;
  if (compares_vgpl(jump))
    return {.gap = Gap::OtherPaths, .line = steps_[step].line, .name = {}, .paths = runs_.size()};
  const std::string name = fmt::format("V{}", jump.variable);
  return {.gap = Gap::OtherRegisters, .line = steps_[step].line, .name = dialect::GivenName::of({name, name})};
}

std::vector<Unverified> VgplValues::gaps() const {
  std::vector<Unverified> gaps;
  for (const std::size_t step : open_jumps()) gaps.push_back(gap_at(step));
  return gaps;
}

std::vector<simulation::RunFinding> VgplValues::findings() const {
  std::vector<simulation::RunFinding> findings;
  for (const std::size_t step : open_jumps()) {
    const Unverified gap = gap_at(step);
    const syntax::Jump& jump = steps_[step].jump;
    findings.push_back({.line = gap.line, .finding = finding_of(gap)});
    findings.back().finding.span = {jump.if_span.begin, jump.target_span.end};
    if (gap.gap == Gap::OtherRegisters) break;  // One finding says it of all.
  }
  return findings;
}

std::string VgplValues::in_words(const CellSet& cells) const {
  const auto excluded_count = std::count(cells.begin(), cells.end(), false);
  if (excluded_count == 0) return "";
  const auto excluded = static_cast<std::size_t>(std::find(cells.begin(), cells.end(), false) - cells.begin());
  if (excluded % 2 == 1 && excluded_count == 1) return fmt::format("VGPL <> {}", constants_[excluded / 2]);
  std::vector<std::string> ranges;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!cells[i]) continue;
    std::size_t last = i;
    while (last + 1 < cells.size() && cells[last + 1]) ++last;
    ranges.push_back(range_in_words(i, last));
    i = last;
  }
  return fmt::format("{}", fmt::join(ranges, ", "));
}

std::string VgplValues::range_in_words(std::size_t first, std::size_t last) const {
  if (first == last && first % 2 == 1) return fmt::format("VGPL = {}", constants_[first / 2]);
  const bool is_open_below = first == 0;
  const bool is_open_above = last == 2 * constants_.size();
  const auto below = [&] { return constants_[(first - 1) / 2]; };
  const auto above = [&] { return constants_[last / 2]; };
  if (is_open_below) return fmt::format("VGPL {} {}", last % 2 == 1 ? "<=" : "<", above());
  if (is_open_above) return fmt::format("VGPL {} {}", first % 2 == 1 ? ">=" : ">", below());
  return fmt::format("{} {} VGPL {} {}", below(), first % 2 == 1 ? "<=" : "<", last % 2 == 1 ? "<=" : "<", above());
}

}  // namespace isocnc::selection
