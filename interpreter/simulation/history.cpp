#include "interpreter/simulation/history.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace isocnc::simulation {

History::History(const Simulation& begin, const CheckpointLimits& limits)
    : limits_(limits), present_(begin), spacing_(limits.spacing) {
  add_checkpoint(begin);
}

void History::add_checkpoint(const Simulation& simulation) {
  checkpoints_.push_back({std::make_unique<const Simulation>(simulation), simulation.memory()});
  bytes_ += checkpoints_.back().bytes;
}

void History::advance_in_block(double seconds) {
  present_.advance_in_block(seconds, [this](const Simulation&) { keep(); });
  apply_settings(present_, present_.blocks());
}

void History::advance_along(double way) {
  present_.advance_along(way, [this](const Simulation&) { keep(); });
  apply_settings(present_, present_.blocks());
}

void History::step_instruction() {
  present_.step_instruction([this](const Simulation&) { keep(); });
  apply_settings(present_, present_.blocks());
}

void History::step_back() {
  const bool was_at_end = present_.has_ended();
  const std::uint64_t blocks = present_.blocks();
  if (was_at_end) go_to_block(blocks);  // M02 counts as a block; a block with an error is not executed.
  if (present_.has_ended() == was_at_end && blocks > 0) go_to_block(blocks - 1);
}

void History::go_to_block(std::uint64_t blocks) {
  start_from([&](const Simulation& simulation) {
    return simulation.blocks() < blocks || (simulation.blocks() == blocks && !simulation.has_ended());
  });
  while (!present_.has_ended() && (present_.blocks() < blocks || present_.is_in_block())) step_block();
}

/// Goes to the last available simulation that satisfies the predicate, else to the program start. The predicate must
/// hold for all earlier ones, too.
template <class Predicate>
void History::start_from(Predicate&& predicate) {
  const auto after = std::partition_point(checkpoints_.begin() + 1, checkpoints_.end(),
                                          [&](const Checkpoint& each) { return predicate(*each.simulation); });
  const Simulation* best = std::prev(after)->simulation.get();
  for (const auto& [work, simulation] : nearby_)
    if (work > best->work() && predicate(simulation)) best = &simulation;
  if (present_.work() >= best->work() && predicate(present_)) return;
  present_ = *best;
  apply_settings(present_, present_.blocks());
}

/// Whether the next block is on the line or before it. Jumps lead forward only (I.5), so lines are reached in order.
static bool comes_to(const running::Runner& runner, std::size_t line) {
  return !runner.has_ended() && runner.place().line <= line;
}

void History::skip_to_line(std::size_t line) {
  if (!comes_to(present_.runner(), line)) return;
  start_from([line](const Simulation& simulation) { return comes_to(simulation.runner(), line); });
}

std::optional<std::uint64_t> History::find_line(std::size_t line) const {
  const auto after = std::partition_point(checkpoints_.begin() + 1, checkpoints_.end(), [line](const Checkpoint& each) {
    return comes_to(each.simulation->runner(), line);
  });
  running::Runner runner = std::prev(after)->simulation->runner();
  while (comes_to(runner, line) && runner.place().line < line) {
    apply_settings(runner, runner.result().blocks);
    runner.step();
    runner.pass_empty_lines();
  }
  if (!comes_to(runner, line)) return std::nullopt;
  return runner.result().blocks;
}

std::optional<std::uint64_t> History::find_before(std::uint64_t blocks,
                                                  const std::function<bool(const running::Block&)>& is_it,
                                                  std::uint64_t from) const {
  std::optional<std::uint64_t> found;
  // Later checkpoints belong to blocks outside the search.
  const auto after = std::partition_point(checkpoints_.begin() + 1, checkpoints_.end(),
                                          [&](const Checkpoint& each) { return each.simulation->blocks() < blocks; });
  for (auto checkpoint = std::make_reverse_iterator(after);
       checkpoint != checkpoints_.rend() && !found && from < blocks; ++checkpoint) {
    running::Runner runner = checkpoint->simulation->runner();
    const std::uint64_t begin = runner.result().blocks;
    for (std::uint64_t i = begin; i < blocks && !runner.has_ended(); i = runner.result().blocks) {
      apply_settings(runner, i);
      const auto block = runner.next();
      if (block && i >= from && is_it(*block)) found = i;
      runner.step();
      runner.pass_empty_lines();
    }
    blocks = std::min(blocks, begin);
  }
  return found;
}

std::optional<std::uint64_t> History::find_simulated_before(std::uint64_t blocks,
                                                            const std::function<bool(Simulation&)>& pass_block,
                                                            std::uint64_t from) const {
  const auto after = std::partition_point(checkpoints_.begin() + 1, checkpoints_.end(),
                                          [&](const Checkpoint& each) { return each.simulation->blocks() <= from; });
  Simulation simulation = *std::prev(after)->simulation;
  if (simulation.is_in_block()) simulation.step_block();  // The block in progress is before `from`.
  std::optional<std::uint64_t> found;
  while (!simulation.has_ended() && simulation.blocks() < blocks) {
    const std::uint64_t block = simulation.blocks();
    apply_settings(simulation, block);
    if (block < from)
      simulation.step_block();
    else if (pass_block(simulation))
      found = block;
  }
  return found;
}

/// Called before the control reads further blocks, when a copy of the present is smallest.
void History::keep() {
  constexpr int kFreedAtOnce = 8;
  for (int i = 0; i < kFreedAtOnce && !thinned_out_.empty(); ++i) thinned_out_.pop_back();
  present_.forget_past();
  keep_nearby();
  if (present_.work() < checkpoints_.back().simulation->work() + spacing_) return;
  add_checkpoint(present_);
  thin_out();
}

void History::keep_nearby() {
  const std::uint64_t work = present_.work();
  const auto after = nearby_.lower_bound(work);
  if (after != nearby_.end() && after->first < work + limits_.spacing) return;
  if (after != nearby_.begin() && std::prev(after)->first + limits_.spacing > work) return;
  nearby_.emplace_hint(after, work, present_);
  if (nearby_.size() <= limits_.nearby) return;
  const bool first_is_farther = work - nearby_.begin()->first > nearby_.rbegin()->first - work;
  nearby_.erase(first_is_farther ? nearby_.begin() : std::prev(nearby_.end()));
}

/// Removes every other checkpoint until the limits are met.
void History::thin_out() {
  while (checkpoints_.size() > 2 && (checkpoints_.size() > limits_.checkpoints || bytes_ > limits_.bytes)) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < checkpoints_.size(); ++i) {
      if (i % 2 == 0) {
        std::swap(checkpoints_[kept++], checkpoints_[i]);
      } else {
        bytes_ -= checkpoints_[i].bytes;
        thinned_out_.push_back(std::move(checkpoints_[i]));
      }
    }
    checkpoints_.erase(checkpoints_.begin() + static_cast<std::ptrdiff_t>(kept), checkpoints_.end());
    spacing_ *= 2;
  }
}

bool History::is_after_present(const Simulation& checkpoint) const {
  return checkpoint.blocks() > present_.blocks() || checkpoint.time() > present_.time();
}

void History::set_register(int reg, double value) { set({present_.blocks(), reg, value}); }

void History::set_vgpl(double value) { set({present_.blocks(), 0, value}); }

void History::set(const RegisterSetting& setting) {
  const auto is_later = [&](const RegisterSetting& other) { return other.blocks > setting.blocks; };
  settings_.erase(std::find_if(settings_.begin(), settings_.end(), is_later), settings_.end());
  settings_.push_back(setting);
  while (checkpoints_.size() > 1 && is_after_present(*checkpoints_.back().simulation)) {
    bytes_ -= checkpoints_.back().bytes;
    checkpoints_.pop_back();
  }
  std::erase_if(nearby_, [this](const auto& each) { return is_after_present(each.second); });
  apply_settings(present_, setting.blocks);
}

/// Applies the settings that were made after exactly `blocks` blocks had started.
template <class Run>
void History::apply_settings(Run& run, std::uint64_t blocks) const {
  const auto comes_before = [](const RegisterSetting& setting, std::uint64_t number) {
    return setting.blocks < number;
  };
  for (auto setting = std::lower_bound(settings_.begin(), settings_.end(), blocks, comes_before);
       setting != settings_.end() && setting->blocks == blocks; ++setting) {
    if (setting->variable == 0) {
      run.set_vgpl(setting->value);
    } else {
      run.set_register(setting->variable, setting->value);
    }
  }
}

std::size_t History::memory() const {
  std::size_t bytes = bytes_;
  for (const auto& [work, simulation] : nearby_) bytes += simulation.memory();
  return bytes;
}

}  // namespace isocnc::simulation
