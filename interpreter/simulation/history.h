#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "interpreter/simulation/simulation.h"

namespace isocnc::simulation {

/// A simulation that goes back as well as forward. It reaches any moment by running on from a checkpoint, a copy kept
/// from an earlier moment. Checkpoints of the whole run become sparser as it grows, so that memory is bounded; those
/// around the present are denser, so that going back and forth there is cheap.
class History {
 public:
  /// Limits of the checkpoints that are kept.
  struct CheckpointLimits {
    std::size_t checkpoints = 65536;
    std::size_t bytes = std::size_t{256} << 20;
    std::size_t nearby = 64;      ///< Additional checkpoints around the present.
    std::uint64_t spacing = 256;  ///< Minimum Simulation::work() between two checkpoints.
  };

  explicit History(const Simulation& begin) : History(begin, CheckpointLimits{}) {}
  History(const Simulation& begin, const CheckpointLimits& limits);

  const Simulation& present() const { return present_; }

  /// These five do the same as in Simulation.
  void step_block() { advance_in_block(std::numeric_limits<double>::infinity()); }
  void advance_in_block(double seconds);
  void advance_along(double way);
  void step_instruction();
  std::optional<running::Block> next() { return present_.next(); }

  /// Goes back to the start of the block in progress or, between two blocks, of the previous one. If an error has ended
  /// the program, goes to the point before the failing block.
  void step_back();
  /// Goes back or forward to the point after `blocks` blocks, before the next one starts; at most to the end.
  void go_to_block(std::uint64_t blocks);

  /// Goes forward to the last checkpoint that is not past the line. Without a checkpoint nearer than the present
  /// nothing changes.
  void skip_to_line(std::size_t line);
  /// Restores an earlier present. No register or VGPL may have been set since.
  void return_to(const Simulation& before) { present_ = before; }

  /// Number of blocks executed before that of a line after the present; none if the run does not reach the line.
  std::optional<std::uint64_t> find_line(std::size_t line) const;

  /// Finds the last of the blocks [from, blocks) before which `is_it` holds. Returns the number of blocks executed
  /// before it.
  std::optional<std::uint64_t> find_before(std::uint64_t blocks,
                                           const std::function<bool(const running::Block&)>& is_it,
                                           std::uint64_t from = 0) const;

  /// Finds the last of the blocks [from, blocks) for which `pass_block` returns true. It gets the simulation before
  /// each of them and takes it to the end of the block, as Simulation::step_block() does. Returns the number of blocks
  /// executed before it. Plans all motions from the checkpoint on, so a search should cover few blocks at once.
  std::optional<std::uint64_t> find_simulated_before(std::uint64_t blocks,
                                                     const std::function<bool(Simulation&)>& pass_block,
                                                     std::uint64_t from = 0) const;

  /// Like Simulation::set_register() and set_vgpl(), from the present on. Discards later checkpoints. After a step back
  /// the value applies from the start of the block in progress or the end of the one before.
  void set_register(int reg, double value);
  void set_vgpl(double value);

  /// Approximate memory of all checkpoints, in bytes. Public for tests and measurements, which hold it against the
  /// limits.
  std::size_t memory() const;

 private:
  /// A register, or VGPL (0), set by a user.
  struct RegisterSetting {
    std::uint64_t blocks = 0;
    int variable = 0;
    double value = 0;
  };

  struct Checkpoint {
    std::unique_ptr<const Simulation> simulation;  ///< On the heap, so that thinning out moves no simulation.
    std::size_t bytes = 0;
  };

  bool is_after_present(const Simulation& checkpoint) const;
  void add_checkpoint(const Simulation& simulation);
  void set(const RegisterSetting& setting);
  template <class Run>
  void apply_settings(Run& run, std::uint64_t blocks) const;
  template <class Predicate>
  void start_from(Predicate&& predicate);
  void keep();
  void keep_nearby();
  void thin_out();

  CheckpointLimits limits_;
  Simulation present_;
  std::vector<Checkpoint> checkpoints_;  ///< The first is the start of the program.
  std::vector<Checkpoint> thinned_out_;  ///< Freed a few at a time, since freeing all at once would delay the run.
  std::size_t bytes_ = 0;                ///< Memory of checkpoints_.
  std::uint64_t spacing_;                ///< Current minimum work between two checkpoints.
  std::map<std::uint64_t, Simulation> nearby_;  ///< Checkpoints around the present, keyed by their work.
  std::vector<RegisterSetting> settings_;       ///< In the order of their blocks.
};

}  // namespace isocnc::simulation
