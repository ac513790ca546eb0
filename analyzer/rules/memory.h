#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "interpreter/execution/plain_run.h"
#include "interpreter/execution/sink.h"
#include "interpreter/execution/state.h"

namespace isocnc::rules {

using execution::BlockStep;

/// A set of steps, one bit each.
using Steps = std::uint32_t;

constexpr Steps set_of(BlockStep step) { return 1u << static_cast<unsigned>(step); }
constexpr Steps set_of(Steps steps) { return steps; }
/// The set of some steps and sets of steps.
template <class... Each>
constexpr Steps at(Each... each) {
  return (set_of(each) | ...);
}

/// Steps that may have been a feed move, or an M, whose words cannot be read.
inline constexpr Steps kMayBeMotion = at(BlockStep::IllegibleMotion, BlockStep::LostLetter);
inline constexpr Steps kMayBeFunction = at(BlockStep::IllegibleFunction, BlockStep::LostLetter);

/// A set of facts, one bit each.
using Facts = std::uint32_t;

/// A fact about the lines above, which holds from one step until another. Where paths join, it goes on to hold only if
/// it holds on all of them.
struct Fact {
  Steps started_by = 0;
  Steps ended_by = 0;
  bool holds_at_start = false;  ///< Whether it holds before the first line.
};

/// What a rule remembers of the lines above: up to four facts; the first has the bit 1, the second 2, and so on.
///
/// Rows of plain motions report no steps one by one. A rule about motions sees each plain motion that may end one of
/// its facts; for all other facts the steps FeedMove and Feed (or those under G93) are taken at the end of the row.
struct RuleMemory {
  std::array<Fact, 4> facts;
  /// Corrects `next`, the facts after a step, where one of them depends on others or on the state; null if none does.
  /// `held` are the facts before the step. Called only while one of the rule's facts holds.
  Facts (*follow)(BlockStep step, const execution::State& before, Facts held, Facts next) = nullptr;
};

struct Rule;

/// The facts of all rules as sets, each fact with a bit of its own.
class MemoryTable {
 public:
  explicit MemoryTable(std::span<const Rule* const> rules);

 private:
  friend class Memory;

  static constexpr std::size_t kMaxRules = 128;
  static constexpr std::size_t kMaxMemories = 32;

  struct Follower {
    Facts (*follow)(BlockStep, const execution::State&, Facts, Facts) = nullptr;
    unsigned first_bit = 0;
    Facts facts = 0;  ///< Those of the memory, from bit 0 on.
  };

  unsigned add(const RuleMemory& memory);

  Facts at_start_ = 0;
  std::array<Facts, execution::kBlockStepCount> started_{};  ///< By step.
  std::array<Facts, execution::kBlockStepCount> ended_{};
  std::array<Facts, 2> judging_plain_motions_{};  ///< Under G94, and under G93.
  Facts followed_ = 0;                            ///< Facts in memories with a follower.
  std::array<Follower, kMaxMemories> followers_;
  std::size_t follower_count_ = 0;
  std::array<std::uint8_t, kMaxRules> first_bit_{};  ///< Of the memory of each rule.
  unsigned bit_count_ = 0;
};

extern const MemoryTable kMemoryTable;

/// What all rules remember on some path: for each of their facts, whether it holds.
class Memory {
 public:
  /// Takes a step of a block; `before` is the state before it.
  void take(BlockStep step, const execution::State& before) {
    const Facts held = facts_;
    const auto index = static_cast<std::size_t>(step);
    facts_ = (held & ~kMemoryTable.ended_[index]) | kMemoryTable.started_[index];
    if ((held & kMemoryTable.followed_) != 0) follow(step, before, held);
  }
  /// Takes the steps of a row of plain motions. `after` is the state after it.
  void take(const execution::PlainEffects& row, const execution::State& after) {
    if (!row.has_fed) return;
    const bool inverse_time = after.inverse_time();
    take(inverse_time ? BlockStep::InverseTimeFeedMove : BlockStep::FeedMove, after);
    if (row.has_taken_feed) take(inverse_time ? BlockStep::InverseTimeFeed : BlockStep::Feed, after);
  }
  /// Keeps the facts that hold on the other path as well.
  void join(const Memory& other) { facts_ &= other.facts_; }
  /// Whether a rule judges motions by a fact that a plain motion may end.
  bool judges_plain_motions(const execution::State& state) const {
    return (facts_ & kMemoryTable.judging_plain_motions_[state.inverse_time() ? 1 : 0]) != 0;
  }
  /// The facts of a rule's memory, and others above them.
  Facts of_rule(std::size_t index) const { return facts_ >> kMemoryTable.first_bit_[index]; }

  friend bool operator==(const Memory&, const Memory&) = default;

 private:
  void follow(BlockStep step, const execution::State& before, Facts held);

  Facts facts_ = kMemoryTable.at_start_;
};

}  // namespace isocnc::rules
