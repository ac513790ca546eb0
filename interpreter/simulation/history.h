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

/// A simulation that goes back as well as on. Any moment is reached by going on from a copy that was kept before it:
/// some all along the way, which become sparser as it grows longer, so that memory is bounded, and finer ones around
/// the present, so that going back and forth there costs next to nothing.
class History {
 public:
  /// What is kept of the whole way.
  struct Limits {
    std::size_t checkpoints = 65536;
    std::size_t bytes = std::size_t{256} << 20;
    std::size_t nearby = 64;      ///< Checkpoints around the present, beside those.
    std::uint64_t spacing = 256;  ///< Least Simulation::work() between two.
  };

  explicit History(const Simulation& begin) : History(begin, Limits{}) {}
  History(const Simulation& begin, const Limits& limits);

  const Simulation& present() const { return present_; }

  /// As in Simulation.
  void step_block() { advance_in_block(std::numeric_limits<double>::infinity()); }
  void advance_in_block(double seconds);
  void advance_along(double way);
  void step_instruction();
  std::optional<running::Block> next() { return present_.next(); }

  /// To the begin of the block in progress, or, between two blocks, of the one before; from where an error has stopped
  /// the program to before it.
  void step_back();
  /// To where so many blocks have been executed and the next has not begun, back or on; at most to the end.
  void go_to_block(std::uint64_t blocks);
  /// To the first moment that is so many seconds from the program's begin, back or on; at most to the end.
  void go_to_time(double seconds);

  /// On to the last copy at hand from which a line is still to come; nowhere when none is nearer than the present.
  void skip_to_line(std::uint64_t line);
  /// To where the present has been before; nothing has been set since.
  void return_to(const Simulation& before) { present_ = before; }

  /// How many blocks are executed before that of a line that lies behind the present; none where the run does not lead
  /// to it.
  std::optional<std::uint64_t> find_line(std::uint64_t line) const;

  /// The last block, of the first `blocks` and not before the block `from`, before which `is_it` holds: how many have
  /// been executed before it.
  std::optional<std::uint64_t> find_before(std::uint64_t blocks,
                                           const std::function<bool(const running::Block&)>& is_it,
                                           std::uint64_t from = 0) const;

  /// The last of the blocks [from, blocks) with a motion for which `is_it` holds, as the machine makes it
  /// (Simulation::motion()): how many have been executed before it. It plans all motions on the way, so a search is to
  /// take few blocks at once.
  std::optional<std::uint64_t> find_motion_before(std::uint64_t blocks,
                                                  const std::function<bool(const motion::Move&)>& is_it,
                                                  std::uint64_t from = 0) const;

  /// As in Simulation, from the present on: what has been further on is forgotten. Whoever comes back finds it as it
  /// has been set, from the begin of the block in progress or the end of the one before.
  void set_register(int reg, double value);
  void set_vgpl(double value);

  /// Bytes of all that is kept, about.
  std::size_t memory() const;

 private:
  /// Somebody has set a register, or VGPL (0).
  struct Setting {
    std::uint64_t blocks = 0;
    int variable = 0;
    double value = 0;
  };

  struct Checkpoint {
    std::unique_ptr<const Simulation> simulation;  ///< On the heap: to thin them out moves none.
    std::size_t bytes = 0;
  };

  bool is_after_present(const Simulation& checkpoint) const;
  void add_checkpoint(const Simulation& simulation);
  void set(const Setting& setting);
  template <class Run>
  void apply_settings(Run& run, std::uint64_t blocks) const;
  template <class Predicate>
  void start_from(Predicate&& predicate);
  void keep();
  void keep_nearby();
  void thin_out();

  Limits limits_;
  Simulation present_;
  std::vector<Checkpoint> checkpoints_;         ///< The first is the begin.
  std::vector<Checkpoint> thinned_out_;         ///< Freed by and by: all at once they would hold up the run.
  std::size_t bytes_ = 0;                       ///< Of checkpoints_.
  std::uint64_t spacing_;                       ///< Work between two of them.
  std::map<std::uint64_t, Simulation> nearby_;  ///< By their work.
  std::vector<Setting> settings_;               ///< In order.
};

}  // namespace isocnc::simulation
