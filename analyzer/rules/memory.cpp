#include "analyzer/rules/memory.h"

#include <cassert>

#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// The steps of plain motions under G94, and under G93.
static constexpr std::array<Steps, 2> kPlainSteps = {
    at(BlockStep::FeedMove, BlockStep::Feed, BlockStep::CompensatedMotion),
    at(BlockStep::InverseTimeFeedMove, BlockStep::InverseTimeFeed, BlockStep::CompensatedMotion)};

MemoryTable::MemoryTable(std::span<const Rule* const> rules) {
  assert(rules.size() <= kMaxRules);
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const RuleMemory* const memory = rules[i]->memory;
    if (!memory) continue;
    std::size_t same = 0;
    while (rules[same]->memory != memory) ++same;
    const unsigned first_bit = same < i ? first_bit_[same] : add(*memory);
    first_bit_[i] = static_cast<std::uint8_t>(first_bit);
    for (std::size_t fact = 0; fact < memory->facts.size(); ++fact)
      for (std::size_t mode = 0; mode < kPlainSteps.size(); ++mode)
        if ((rules[i]->concerns & kMotion) != 0 && (memory->facts[fact].ended_by & kPlainSteps[mode]) != 0)
          judging_plain_motions_[mode] |= Facts{1} << (first_bit + fact);
  }
}

/// Gives the facts of a memory their bits; returns the first.
unsigned MemoryTable::add(const RuleMemory& memory) {
  const unsigned first_bit = bit_count_;
  for (const Fact& fact : memory.facts) {
    if (fact.ended_by == 0) break;
    assert(bit_count_ < 32);
    const Facts mine = Facts{1} << bit_count_++;
    if (fact.holds_at_start) at_start_ |= mine;
    for (std::size_t step = 0; step < execution::kBlockStepCount; ++step) {
      if ((fact.started_by & set_of(static_cast<BlockStep>(step))) != 0) started_[step] |= mine;
      if ((fact.ended_by & set_of(static_cast<BlockStep>(step))) != 0) ended_[step] |= mine;
    }
  }
  if (!memory.follow) return first_bit;
  const Facts facts = (Facts{1} << (bit_count_ - first_bit)) - 1;
  followers_[follower_count_++] = {memory.follow, first_bit, facts};
  followed_ |= facts << first_bit;
  return first_bit;
}

void Memory::follow(BlockStep step, const execution::State& before, Facts held) {
  for (std::size_t i = 0; i < kMemoryTable.follower_count_; ++i) {
    const MemoryTable::Follower& each = kMemoryTable.followers_[i];
    const Facts held_here = held >> each.first_bit & each.facts;
    if (held_here == 0) continue;
    const Facts next = each.follow(step, before, held_here, facts_ >> each.first_bit & each.facts);
    facts_ = (facts_ & ~(each.facts << each.first_bit)) | (next & each.facts) << each.first_bit;
  }
}

}  // namespace isocnc::rules
