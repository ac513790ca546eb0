#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "interpreter/running/event.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::running {

/// V1 to V30; [0] is not used.
using Registers = std::array<double, dialect::kRegisterCount + 1>;

/// A line that a run is about to execute. Lines that a jump passes over are none.
struct Block {
  std::uint64_t line = 0;  ///< From 0.
  const syntax::LineTree& tree;
  const execution::State& state;  ///< Before it.
  const Registers& registers;     ///< Before it.
};

/// What a run is given besides the program.
struct RunOptions {
  execution::Setup setup;
  double vgpl = 0;                                 ///< The GPL variable that IF compares (I.5).
  Registers registers{};                           ///< At the start.
  std::optional<std::uint64_t> until;              ///< Stop before this line (from 0).
  bool stop_at_errors = true;                      ///< As the control does; else go on as a checker reads it.
  std::function<void(const Block&)> before_block;  ///< Where somebody wants to follow the state.
};

/// Why a run came to its end.
enum class Ending : std::uint8_t { ProgramEnd, Error, Until };

struct RunResult {
  Ending ending = Ending::ProgramEnd;
  std::uint64_t line = 0;  ///< Of the end, from 0.
  std::string_view line_text;
  syntax::Finding error;   ///< When `ending` is Error.
  execution::State state;  ///< At the end.
  Registers registers{};
  std::uint64_t blocks = 0;  ///< Blocks executed.
};

/// Runs a program as the control would, one block after another; what it does goes to `on_event`. A block with an error
/// does nothing: the control stops there. A UTF-8 byte-order mark is not part of `text`.
RunResult run(std::string_view text, const RunOptions& options, const std::function<void(const Event&)>& on_event);

}  // namespace isocnc::running
