#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "debugger/breakpoints/breakpoint.h"
#include "debugger/debuggee/block_effect.h"

namespace isocnc::breakpoints {

/// The direction in which a run comes to a block. Log points are silent on the way backward.
enum class RunDirection : std::uint8_t { Forward, Backward };

/// All breakpoints of a session. A block without any costs the look at one bit.
class Breakpoints {
 public:
  void set_lines(std::vector<LineBreakpoint> breakpoints, std::size_t line_count);
  void set_functions(std::vector<FunctionBreakpoint> breakpoints);
  void set_data(std::vector<DataBreakpoint> breakpoints);

  bool has_line(std::size_t line) const {
    return line / 64 < bits_.size() && ((bits_[line / 64] >> (line % 64)) & 1) != 0;
  }
  bool has_functions() const { return !functions_.empty(); }
  bool has_data() const { return !data_.empty(); }
  /// The limits of the surroundings that data breakpoints watch.
  std::vector<debuggee::SurroundingsLimit> limits() const;
  /// Another number after each change of the data breakpoints.
  std::uint64_t revision() const { return revision_; }
  /// Whether it matters what a value has been between two blocks.
  bool has_thresholds() const;

  /// What comes of the breakpoints that a block, or a change, has reached.
  struct BreakpointOutcome {
    std::vector<std::int64_t> stopped;  ///< Ids of breakpoints that the run stops at.
    std::vector<std::string> messages;  ///< Messages of log points.
  };

  // The breakpoints that a block reaches, in its line, by its codes, or by the values that it changes. They are added
  // to `outcome`.
  void judge_line(const expressions::Moment& moment, std::uint64_t block, RunDirection direction,
                  BreakpointOutcome& outcome);
  void judge_functions(const syntax::LineTree& tree, const expressions::Moment& moment, std::uint64_t block,
                       RunDirection direction, BreakpointOutcome& outcome);
  /// `moment` is the last of the trail.
  void judge_data(const expressions::ValueTrail& trail, const expressions::Moment& moment, std::uint64_t block,
                  RunDirection direction, BreakpointOutcome& outcome);

  /// The data breakpoint with the given one of the limits(), which the run comes to be beyond.
  void judge_limit(std::size_t limit, const expressions::Moment& moment, std::uint64_t block, RunDirection direction,
                   BreakpointOutcome& outcome);

  /// Begins a trail with the values of the moment before a block.
  void start_trail(const expressions::Moment& moment, expressions::ValueTrail& trail) const;
  /// Appends the values of a moment.
  void read_data(const expressions::Moment& moment, expressions::ValueTrail& trail) const;
  /// Appends the values along the block's arc, if it has one, where a value may pass a threshold and come back.
  /// `moment` is that before or after the block.
  void read_arc(const debuggee::BlockEffect& effect, const expressions::Moment& moment,
                expressions::ValueTrail& trail) const;
  /// What a data breakpoint watches, as the client wrote it; empty for others.
  std::string name_of(std::int64_t id) const;
  /// The change that a data breakpoint has stopped the run for: `V3: 1 -> 2`; empty for others.
  std::string description(std::int64_t id, const expressions::ValueTrail& trail) const;

  /// The run has been changed at this block: hits from there on are void.
  void forget_hits_from(std::uint64_t block);

 private:
  static void reach(Breakpoint& breakpoint, const expressions::Moment& moment, std::uint64_t block,
                    RunDirection direction, BreakpointOutcome& outcome);

  std::multimap<std::size_t, LineBreakpoint> lines_;
  std::vector<std::uint64_t> bits_;  ///< A bit for each line, set where it has breakpoints.
  std::vector<FunctionBreakpoint> functions_;
  std::vector<DataBreakpoint> data_;
  std::uint64_t revision_ = 0;
};

}  // namespace isocnc::breakpoints
