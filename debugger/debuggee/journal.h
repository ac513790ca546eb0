#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/running/runner.h"

namespace isocnc::debuggee {

/// What a run has done and its state does not show: where each mode and value was set, which jumps were taken, which
/// parameters the M functions got. The oldest entries may be forgotten. It is written once for each block, so going
/// back and forward again reads the same.
class Journal {
 public:
  /// The modal groups of a state.
  struct Modes {
    explicit Modes(const execution::State& state) : in_force(state.in_force), written(state.written) {}
    friend bool operator==(const Modes&, const Modes&) = default;

    std::array<std::uint8_t, dialect::kModalGroupCount> in_force;
    std::uint16_t written = 0;
  };
  /// The values of which the journal notes where they were set.
  struct Values {
    static constexpr std::size_t kFeed = 0;
    static constexpr std::size_t kSpindleSpeed = 1;
    static constexpr std::size_t kTool = 2;
    static constexpr std::size_t kRegisters = 2;  ///< The number of a register is added to it.
    static constexpr std::size_t kCount = kRegisters + dialect::kRegisterCount + 1;

    explicit Values(const running::RunResult& run);

    std::array<double, kCount> numbers;
  };
  /// What the journal compares before and after a block.
  struct ModesAndValues {
    explicit ModesAndValues(const running::RunResult& run) : modes(run.state), values(run) {}

    Modes modes;
    Values values;
  };
  /// Where a value has become another one.
  struct ValueSetting {
    std::uint64_t block = 0;
    std::size_t line = 0;
    double number = 0;
  };
  /// Where a member of a modal group has come into force, or has been written for the first time.
  struct ModeSetting {
    std::uint64_t block = 0;
    std::size_t line = 0;
    std::uint8_t number = 0;  ///< Number of the G.
  };
  struct TakenJump {
    std::uint64_t block = 0;  ///< Blocks executed before the IF.
    std::size_t from = 0;     ///< Lines, from 0.
    std::size_t to = 0;
  };
  struct Function {
    std::uint64_t block = 0;
    running::FunctionEvent call;
  };

  /// Notes what a block has done. `block`: how many have been executed before it.
  void take(std::uint64_t block, std::size_t line, const ModesAndValues& from, const ModesAndValues& to,
            std::span<const running::Event> events);
  /// The run has been changed at this block: what is noted from there on is void.
  void forget_from(std::uint64_t block);

  // What had been noted before a block.
  /// The last setting; none where the program has set nothing, or it is forgotten.
  std::optional<ModeSetting> setting(dialect::ModalGroup group, std::uint64_t block) const;
  /// Whether settings of the group have been forgotten, as there were too many.
  bool has_forgotten(dialect::ModalGroup group) const { return has_forgotten_[static_cast<std::size_t>(group)]; }
  /// The last setting of one of the Values; none where the program has set nothing, or it is forgotten.
  std::optional<ValueSetting> value_setting(std::size_t value, std::uint64_t block) const;
  /// The latest first.
  std::vector<TakenJump> jumps(std::uint64_t block) const;
  /// The last call with parameters of each M, the latest first.
  std::vector<Function> functions(std::uint64_t block) const;

 private:
  std::uint64_t known_ = 0;  ///< Blocks before this one have been noted.
  std::array<std::deque<ModeSetting>, dialect::kModalGroupCount> settings_;
  std::array<bool, dialect::kModalGroupCount> has_forgotten_{};
  std::array<std::deque<ValueSetting>, Values::kCount> values_;
  std::deque<TakenJump> jumps_;
  std::deque<Function> functions_;
};

}  // namespace isocnc::debuggee
