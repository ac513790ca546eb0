#pragma once

#include <cstdint>
#include <optional>

#include "analyzer/rules/check_setup.h"
#include "analyzer/rules/memory.h"
#include "interpreter/execution/sink.h"
#include "interpreter/execution/state.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::rules {

using namespace dialect::literals;
using dialect::GRole;

/// The roles of the G and the numbers of the M of a line, one bit each; any, unless they have been collected. Numbers
/// share the bit of the numbers that differ by 64.
struct Codes {
  std::uint64_t roles = ~std::uint64_t{0};
  std::uint64_t functions = ~std::uint64_t{0};

  static constexpr std::uint64_t bit(unsigned index) { return std::uint64_t{1} << (index % 64); }
  void add(dialect::GRole role) { roles |= bit(static_cast<unsigned>(role)); }
  void add_m(const syntax::Word& word) {
    if (const std::optional<int> number = word.whole()) functions |= bit(static_cast<unsigned>(*number));
  }
  bool may_have(dialect::GRole role) const { return (roles & bit(static_cast<unsigned>(role))) != 0; }
  bool may_have_m(int number) const { return (functions & bit(static_cast<unsigned>(number))) != 0; }
};

/// A line executed on one path: the input of a lint rule.
struct ExecutedBlock {
  const syntax::LineTree& line;
  const execution::State& before;
  const execution::State& after;
  const execution::Setup& setup;
  const dialect::LintThresholds& thresholds;
  Facts remembered = 0;  ///< The facts of the rule's memory that hold before the line.
  Codes codes;           ///< What the line has, so that most rules need not look through it.

  /// Whether a fact of the rule's memory holds before the line.
  bool holds(Facts fact) const { return (remembered & fact) != 0; }
  bool compensated() const { return before.is_compensated(); }
  bool spindle_turns() const { return before.spindle_turns(); }
  /// The line's motion G, written or in force; null if nothing moves.
  const dialect::GCode* motion() const;
  /// Whether the line's motion cuts: G01, G02 or G03, written or in force.
  bool has_feed_move() const;
  /// The first G of this role on the line, or null.
  const syntax::Word* g(dialect::GRole role) const { return codes.may_have(role) ? find_g(role) : nullptr; }
  /// The M of this number on the line, or null.
  const syntax::Word* m(int number) const { return codes.may_have_m(number) ? find_m(number) : nullptr; }
  /// Whether the line has a user-defined M.
  bool has_user_function() const;
  /// The last M03, M04 or M05 before a word of the line; 0 if there is none.
  int spindle_function_before(const syntax::Word& word) const;
  /// The line's first coordinate, or the motion's G: the place of findings about the motion.
  const syntax::Word& motion_word() const;
  /// The motion's word of this letter, or null.
  const syntax::Word* argument(char letter) const;

 private:
  const syntax::Word* find_g(dialect::GRole role) const;
  const syntax::Word* find_m(int number) const;
};

/// The parts of a line that rules can register for.
inline constexpr unsigned kMotion = 1;      ///< A motion, by its G or continued.
inline constexpr unsigned kModal = 2;       ///< Any other G.
inline constexpr unsigned kFunction = 4;    ///< An M other than M06.
inline constexpr unsigned kToolChange = 8;  ///< M06.
inline constexpr unsigned kSpindle = 16;    ///< An S.
inline constexpr unsigned kFeed = 32;       ///< An F.
inline constexpr unsigned kAllParts = 63;

/// Checks a block that contains one of `concerns`, or the motion of a block. One file per rule, named after it, and one
/// row each in the tables of diagnostics and of fixes; the build collects the files. `check` is not called for plain
/// motions that end no fact of the rule's memory, so a rule must not rely on seeing them; `check_move` is called for
/// all motions with known ends, but only where checks_moves().
struct Rule {
  unsigned concerns = 0;
  void (*check)(const ExecutedBlock& block, execution::Sink& sink) = nullptr;
  void (*check_move)(const ExecutedBlock& block, const execution::ProgrammedMove& move,
                     execution::Sink& sink) = nullptr;
  const RuleMemory* memory = nullptr;  ///< Several rules may share one.
};

inline void report(execution::Sink& sink, dialect::DiagnosticId id, syntax::Span span, double value = 0,
                   syntax::Span related = {}) {
  sink.report({.id = id, .span = span, .related = related, .values = {value}});
}

/// Runs all rules on a block. `memory` is that before it.
void run_rules(ExecutedBlock block, const Memory& memory, execution::Sink& sink);

/// Whether rules judge each motion. This disables the fast path for plain lines, so it is on only if the setup has
/// limits or a rule for all motions is selected.
bool checks_moves(const CheckSetup& setup);

/// Runs all rules on the motion of a block, given in the frame in force after the block.
void run_move_rules(const ExecutedBlock& block, const execution::ProgrammedMove& move, execution::Sink& sink);

/// Judges an arc that the control accepts. Reports W142 if it is legal both ways and `suspects_centers` is set;
/// otherwise W112 if it would not fit with half the tolerance.
void judge_arc(const execution::CenteredArc& arc, const geometry::CenterReadings& readings, bool suspects_centers,
               const execution::Setup& setup, execution::Sink& sink);

}  // namespace isocnc::rules
