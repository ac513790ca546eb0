#include "analyzer/check/jump_numbers.h"

namespace isocnc::check {

static void renumber(Decisions& path, const JumpNumbers& numbers) {
  for (Decision& decision : path) decision.jump = numbers.of(decision.jump);
}

void JumpNumbers::apply(Frontier& frontier) const {
  frontier.next_jump = of(frontier.next_jump);
  frontier.change_each([&](Groups& groups) {
    for (Group& group : groups) renumber(group.path, *this);
  });
}

void JumpNumbers::apply(Outcome& outcome) const {
  for (std::uint32_t& jump : outcome.live_jumps) jump = of(jump);
  for (Decisions& path : outcome.paths) {
    renumber(path, *this);
    // Such findings may still be shown before their lines are checked again.
    std::erase_if(path, [](const Decision& decision) { return decision.jump == kReplaced; });
  }
}

}  // namespace isocnc::check
