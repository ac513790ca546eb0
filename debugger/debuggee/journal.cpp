#include "debugger/debuggee/journal.h"

#include <algorithm>
#include <cmath>

#include "interpreter/execution/feed.h"

namespace isocnc::debuggee {

/// Maximum number of entries of each kind.
static constexpr std::size_t kMaxEntries = 16384;
static constexpr auto kWorkpiece = static_cast<std::size_t>(dialect::ModalGroup::Workpiece);

/// Whether the oldest entry had to be dropped.
template <class Entry>
static bool note(std::deque<Entry>& entries, Entry entry) {
  const bool is_full = entries.size() == kMaxEntries;
  if (is_full) entries.pop_front();
  entries.push_back(std::move(entry));
  return is_full;
}

/// The end of the entries of blocks before this one.
template <class Entry>
static auto end_before(const std::deque<Entry>& entries, std::uint64_t block) {
  return std::lower_bound(entries.begin(), entries.end(), block,
                          [](const Entry& entry, std::uint64_t number) { return entry.block < number; });
}

Journal::Values::Values(const running::RunResult& run) {
  const execution::ToolCode& tool = run.state.tool;
  numbers[kFeed] = execution::feed_in_force(run.state).number;
  numbers[kSpindleSpeed] = run.state.spindle_speed;
  numbers[kTool] = tool.head * 100000 + tool.holder * 1000 + tool.tool;
  for (std::size_t number = 1; number <= dialect::kRegisterCount; ++number)
    numbers[kRegisters + number] = run.registers[number];
}

static bool is_other(double a, double b) { return !(a == b) && !(std::isnan(a) && std::isnan(b)); }

void Journal::take(std::uint64_t block, std::size_t line, const ModesAndValues& from, const ModesAndValues& to,
                   std::span<const running::Event> events) {
  if (block < known_) return;
  known_ = block + 1;
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (is_other(from.values.numbers[i], to.values.numbers[i])) note(values_[i], {block, line, to.values.numbers[i]});
  const Modes& before = from.modes;
  const Modes& after = to.modes;
  const unsigned first_written = after.written & ~static_cast<unsigned>(before.written);
  if (!(before == after))
    for (std::size_t i = 0; i < settings_.size(); ++i)
      if (before.in_force[i] != after.in_force[i] || ((first_written >> i) & 1u) != 0)
        has_forgotten_[i] |= note(settings_[i], {block, line, after.in_force[i]});
  for (const running::Event& event : events) {
    if (const auto* const jump = std::get_if<running::JumpEvent>(&event.what)) {
      if (jump->taken) note(jumps_, {block, event.line, jump->target_line});
    } else if (std::holds_alternative<running::FrameEvent>(event.what)) {
      // A G92 that follows another one.
      if (before == after) note(settings_[kWorkpiece], {block, line, after.in_force[kWorkpiece]});
    } else if (const auto* const call = std::get_if<running::FunctionEvent>(&event.what)) {
      if (!call->parameters.empty()) note(functions_, {block, *call});
    }
  }
}

void Journal::forget_from(std::uint64_t block) {
  known_ = std::min(known_, block);
  for (auto& settings : settings_) settings.erase(end_before(settings, block), settings.end());
  for (auto& settings : values_) settings.erase(end_before(settings, block), settings.end());
  jumps_.erase(end_before(jumps_, block), jumps_.end());
  functions_.erase(end_before(functions_, block), functions_.end());
}

std::optional<Journal::ModeSetting> Journal::setting(dialect::ModalGroup group, std::uint64_t block) const {
  const auto& settings = settings_[static_cast<std::size_t>(group)];
  const auto end = end_before(settings, block);
  if (end == settings.begin()) return std::nullopt;
  return *std::prev(end);
}

std::optional<Journal::ValueSetting> Journal::value_setting(std::size_t value, std::uint64_t block) const {
  const auto end = end_before(values_[value], block);
  if (end == values_[value].begin()) return std::nullopt;
  return *std::prev(end);
}

std::vector<Journal::TakenJump> Journal::jumps(std::uint64_t block) const {
  return {std::make_reverse_iterator(end_before(jumps_, block)), jumps_.rend()};
}

std::vector<Journal::Function> Journal::functions(std::uint64_t block) const {
  std::vector<Function> latest;
  for (auto each = std::make_reverse_iterator(end_before(functions_, block)); each != functions_.rend(); ++each) {
    const bool is_known = std::any_of(latest.begin(), latest.end(), [&](const Function& function) {
      return function.call.number == each->call.number;
    });
    if (!is_known) latest.push_back(*each);
  }
  return latest;
}

}  // namespace isocnc::debuggee
