#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "analyzer/frontier.h"
#include "interpreter/execution/execute.h"
#include "interpreter/syntax/document.h"

namespace isocnc::analyzer {

/// How what has been found in a stretch of lines, and the positions behind it, depend on the positions before it.
struct PositionUse {
  execution::AxisSet read = 0;  ///< Findings, or frames, depend on where these axes stood before.
  execution::AxisSet set = 0;   ///< Where these stand behind it does not depend on that. The others have moved on.
  bool by_several = false;      ///< There was more than one state, now or waiting: `set` holds for some of them.
  bool far = false;             ///< An axis has been so far away that moves may not add up exactly.
};

/// What the check of a stretch of lines has found.
struct Outcome {
  struct Label {
    std::uint64_t label = 0;
    std::uint64_t line = 0;
    syntax::Span span;
    bool live = false;  ///< On a feasible path.
  };

  std::vector<LocatedFinding> findings;  ///< In the order of the lines.
  std::vector<Path> paths;
  std::vector<Label> labels;              ///< Definitions of labels that some GOTO names.
  std::vector<std::uint32_t> live_jumps;  ///< Jumps on a feasible path, counted from the top of the file.
  std::uint64_t last_text_line = 0;       ///< The last that holds any text (D47), if one does.
  bool has_text = false;
  RegisterSet assigned = 0;  ///< Registers that have been given a value; followed only where an IF compares one.
  PositionUse positions;
  std::vector<std::pair<dialect::DiagnosticId, std::size_t>> tally;  ///< Findings of each kind, after count().

  void clear();
  void count();
};

/// Most machine states that are followed at once (W191).
inline constexpr std::size_t kMostStates = 512;

/// Checks a program line by line on every feasible path. It holds where it stands (`frontier`) and nothing else, so
/// that a check can go on from any earlier frontier.
class Checker {
 public:
  Checker(const execution::Setup& setup, const JumpMap& jumps);

  /// The frontier before the first line.
  static Frontier start(const execution::Setup& setup, const JumpMap& jumps);

  /// Checks one line.
  void check(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  /// Checks the lines of a chunk, counted from its first.
  void check_all(const syntax::ChunkTrees& trees, Outcome& outcome);
  /// check() for most lines of most programs, in one go: plain ones with which nothing is wrong, and that no jump leads
  /// to. Stops before the first other line; returns how many there were from `first` on.
  std::size_t check_plain_lines(const syntax::TreeStore& trees, std::size_t first, std::uint64_t line_number,
                                Outcome& outcome);
  /// check() for the line where check_plain_lines() has stopped.
  void check_any(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);

  Frontier frontier;

 private:
  class Listener;

  void check_straight(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  template <class PlainLineAt>
  std::size_t check_plain(std::size_t count, std::uint64_t line_number, Outcome& outcome, PlainLineAt plain_line_at);
  /// Lines that one state alone runs through make up for some of those that more have.
  void relieve(std::size_t lines);
  void tell_of_dead_code(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void arrive(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void execute_in_all_groups(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void report_common_findings(std::uint64_t line_number, Outcome& outcome);
  void branch(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  bool reduce(Groups& groups) const;
  void bound_states(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void admit_reduction(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);

  struct GroupFinding {
    syntax::Finding finding;
    std::size_t group = 0;
  };

  void note_line(const syntax::LineTree& line, const execution::State& before, const execution::State& after,
                 bool has_findings, PositionUse& use) const;
  void judge_move(const syntax::LineTree& line, const execution::State& before, const execution::State& after,
                  execution::Sink& sink);

  const execution::Setup& setup_;
  const JumpMap& jumps_;
  const bool watches_moves_;
  std::optional<execution::Move> move_;       // Of the line, where moves are watched.
  std::vector<GroupFinding> group_findings_;  // Of one line; kept for its memory.
};

/// The outcome of some lines, which stand from this one on.
struct PlacedOutcome {
  const Outcome* outcome = nullptr;
  std::uint64_t first_line = 0;
};

/// The first findings of a program, and how many there are behind them.
struct FirstFindings {
  Report report;
  std::size_t left_out = 0;  ///< Those that count.
};

/// What an excerpt is to hold.
struct FirstFindingsWishes {
  std::size_t most = static_cast<std::size_t>(-1);         ///< So many findings that count, or a few more.
  std::function<bool(dialect::DiagnosticId)> counts = {};  ///< Without it all do.
};

/// Puts together what was found: sorts, adds what only the whole program shows (E006, ISO045), and leaves of the
/// findings that are said once per program the first (D44). `text_of_line` gives a line's text.
Report conclude(Outcome outcome, const Frontier& end, const JumpMap& jumps,
                const std::function<std::string_view(std::uint64_t)>& text_of_line);
/// The same of several outcomes that have been counted, in the order of the program. Those that have nothing but
/// `has_text` may be left out, but the last that has.
FirstFindings conclude(const std::vector<PlacedOutcome>& outcomes, const Frontier& end, const JumpMap& jumps,
                       const std::function<std::string_view(std::uint64_t)>& text_of_line,
                       const FirstFindingsWishes& wishes = {});

/// Whether the labels seen tell where each jump on a feasible path goes.
bool all_jumps_land(const Outcome& outcome, const JumpMap& jumps);

}  // namespace isocnc::analyzer
