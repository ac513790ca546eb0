#pragma once

#include <vector>

#include "interpreter/execution/execute.h"

namespace isocnc::execution {

/// Executes one block and records what it does. A value: keeps no reference to the line or to the setup.
class BlockRecorder final : public Sink {
 public:
  /// A motion with the state in which it runs: its frame, modes and spindle.
  struct Motion {
    ProgrammedMove move;
    State state;
  };

  BlockRecorder(const syntax::LineTree& line, const State& before, const Setup& setup);

  /// The state after the block.
  const State& state() const { return state_; }
  /// The errors and warnings of the block: first those of its text, then those that depend on the state before it.
  const std::vector<syntax::Finding>& findings() const { return findings_; }
  /// Whether one of the findings is an error: the control would stop here, without running the rest.
  bool has_error() const;

  /// The block's motions in their order; more than one only in a block with a finding.
  const std::vector<Motion>& motions() const { return motions_; }
  /// The last motion; null if there is none.
  const Motion* motion() const { return motions_.empty() ? nullptr : &motions_.back(); }
  /// The state in which the last motion runs; without one, the state after the block.
  const State& modes() const { return motions_.empty() ? state_ : motions_.back().state; }
  /// The dwell of a G04, s; 0 without one.
  double dwell() const { return dwell_; }
  /// The values given to registers, in their order.
  const std::vector<Assigned>& assignments() const { return assignments_; }

  void report(const syntax::Finding& finding) override { findings_.push_back(finding); }
  void move(const ProgrammedMove& move, const State& state) override { motions_.push_back({move, state}); }
  void dwell(double seconds) override { dwell_ = seconds; }
  void assign(int reg, double value) override { assignments_.push_back({reg, value}); }

 private:
  State state_;
  std::vector<syntax::Finding> findings_;
  std::vector<Motion> motions_;
  double dwell_ = 0;
  std::vector<Assigned> assignments_;
};

}  // namespace isocnc::execution
