#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "interpreter/dialect/given_name.h"
#include "interpreter/dialect/house_watch.h"
#include "interpreter/execution/plain_run.h"
#include "interpreter/execution/sink.h"
#include "interpreter/execution/state.h"

namespace isocnc::rules {

struct ExecutedBlock;

/// What the house rules remember on some path: two sets of watches, one bit each. Paths with different memories are
/// not joined, so that each finding says by which jumps it is reached.
struct HouseMemory {
  std::uint64_t on = 0;       ///< Watches that are on; of S, F and Z: those for the mounted tool.
  std::uint64_t outside = 0;  ///< Watches of S and F whose number in force is out of range, and not yet reported.

  /// Lets this stand for two paths where too many are followed: keeps what holds on both, so that no finding is wrong.
  void join(const HouseMemory& other) {
    on &= other.on;
    outside &= other.outside;
  }
  friend bool operator==(const HouseMemory&, const HouseMemory&) = default;
};

/// Which plain lines in a row must leave the fast path, so that a house rule sees them. Fixed for one row.
struct PlainGuard {
  bool is_active = false;
  double minimum_feed = -std::numeric_limits<double>::infinity();  ///< mm/min; not under G93.
  double maximum_feed = std::numeric_limits<double>::infinity();
  double lowest = -std::numeric_limits<double>::infinity();  ///< Z in the frame in force, mm.
  double mm_per_unit = 1;
  bool is_incremental = false;

  /// `words` and `feed` are those of the line, `state` is that before it.
  bool stops_at(std::span<const syntax::Word> words, std::int32_t feed, const execution::State& state) const;

  friend bool operator==(const PlainGuard&, const PlainGuard&) = default;
};

/// The house rules of a configuration, made ready for the check. A line costs one look into a table for each of its
/// words; rows of plain motions cost nothing while no rule is about them.
class HouseRules {
 public:
  /// At most dialect::kMaxHouseWatches.
  explicit HouseRules(const std::vector<dialect::HouseWatch>& watches);

  HouseMemory at_start() const { return {.on = on_first_}; }
  /// Whether some rule needs each motion by itself, so that there is no fast path.
  bool needs_each_motion() const { return needs_each_motion_; }
  /// Whether some rule is about Z, so that findings depend on positions.
  bool watches_depth() const { return depth_ != 0; }
  bool watches_comments() const { return commented_ != 0; }

  /// Whether the next plain motions must leave the fast path.
  bool judges_plain_motions(const HouseMemory& memory, const execution::State& state) const;
  PlainGuard guard(const HouseMemory& memory, const execution::State& state) const;
  /// Takes a row of plain motions that the guard has let through; `after` is the state after it.
  void take(const execution::PlainEffects& row, const execution::State& after, HouseMemory& memory) const;

  /// Takes the comments of a line, also of one without any block.
  void take_comments(const syntax::LineTree& line, HouseMemory& memory) const;
  /// Judges a block. With an error in the block, `may_report` is false; with words that cannot be read, `is_legible`:
  /// they may have been any, so nothing is said until a watch starts again. `move` is the motion, where it is known.
  void judge(const ExecutedBlock& block, bool may_report, bool is_legible, const execution::ProgrammedMove* move,
             HouseMemory& memory, execution::Sink& sink) const;

 private:
  /// The watches that an event concerns.
  struct Concerned {
    std::uint64_t reported = 0;
    std::uint64_t started = 0;
    std::uint64_t ended = 0;
  };
  struct LoadedWatch {
    dialect::GivenName rule;
    dialect::GivenName message;
    dialect::Severity severity = dialect::Severity::Warning;
    std::string comment;
    double minimum = 0;
    double maximum = 0;
    std::vector<dialect::ToolRange> tools;
  };
  class BlockJudge;

  static std::size_t index_of(const dialect::HouseEvent& event);
  const Concerned& concerned_by(const dialect::HouseEvent& event) const { return concerned_[index_of(event)]; }
  void add(const dialect::HouseWatch& watch);
  std::uint64_t outside_of(std::uint64_t watches, double value) const;
  std::uint64_t for_tool(std::uint64_t on, const execution::State& state) const;

  std::vector<LoadedWatch> watches_;
  std::vector<Concerned> concerned_;  ///< By index_of().
  std::uint64_t on_first_ = 0;
  std::uint64_t stays_on_ = 0;
  std::uint64_t commented_ = 0;
  std::uint64_t speed_ = 0;
  std::uint64_t feed_ = 0;
  std::uint64_t depth_ = 0;
  std::uint64_t by_tool_ = 0;     ///< Watches of S, F and Z for some tools only.
  std::uint64_t of_motions_ = 0;  ///< Watches that motions report or end, while they are on.
  bool needs_each_motion_ = false;
};

}  // namespace isocnc::rules
