#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/running/event.h"

namespace isocnc::debugger::session {

/// What a run has done on its way and its state does not show: where each mode was set, which jumps were taken, which
/// parameters the M functions got. Of what has been longest ago some may be forgotten. It is written once for each
/// block; who goes back reads the same again.
class Journal {
 public:
  using Modes = std::array<std::uint8_t, dialect::kModalGroupCount>;  ///< As in execution::State::in_force.

  struct Jump {
    std::uint64_t block = 0;  ///< Of the IF: blocks executed before it.
    std::uint64_t from = 0;   ///< Lines, from 0.
    std::uint64_t to = 0;
  };
  struct Function {
    std::uint64_t block = 0;
    running::FunctionEvent call;
  };

  /// Notes what a block has done. `block`: how many have been executed before it.
  void take(std::uint64_t block, std::uint64_t line, const Modes& before, const Modes& after,
            std::span<const running::Event> events);
  /// The run goes another way from this block on.
  void forget_from(std::uint64_t block);

  // Each as it was before a block.
  /// The line that has set what is in force; none where the program has not, or it is forgotten.
  std::optional<std::uint64_t> setter(dialect::ModalGroup group, std::uint64_t block) const;
  /// The latest first.
  std::vector<Jump> jumps(std::uint64_t block) const;
  /// The last call with parameters of each M, the latest first.
  std::vector<Function> functions(std::uint64_t block) const;

 private:
  struct Setting {
    std::uint64_t block = 0;
    std::uint64_t line = 0;
  };

  std::uint64_t known_ = 0;  ///< Blocks before this one have been noted.
  std::array<std::deque<Setting>, dialect::kModalGroupCount> settings_;
  std::deque<Jump> jumps_;
  std::deque<Function> functions_;
};

}  // namespace isocnc::debugger::session
