#pragma once

#include "interpreter/execution/setup.h"
#include "interpreter/execution/sink.h"
#include "interpreter/execution/state.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::rules {

using namespace dialect::literals;

/// A line that takes effect on one path: what a lint rule judges.
struct Block {
  const syntax::LineTree& line;
  const execution::State& before;
  const execution::State& after;
  const execution::Setup& setup;

  bool compensated() const { return before.mode(dialect::ModalGroup::CutterCompensation) != 40; }
  bool spindle_turns() const {
    return before.knows(execution::State::kClockwise | execution::State::kCounterclockwise);
  }
  /// The number of the line's motion G, written or in force; kNoMotion where nothing moves.
  std::uint8_t motion() const;
  /// Whether the line's motion cuts: G01, G02 or G03, written or in force.
  bool has_feed_move() const;
  /// The G of this number on the line, or null.
  const syntax::Word* g(int number) const;
  /// The M of this number on the line, or null.
  const syntax::Word* m(int number) const;
  /// Whether an M of the shop's is on the line.
  bool has_user_function() const;
  /// M03, M04 or M05, the last of them before a word of the line; 0 where there is none.
  int spindle_function_before(const syntax::Word& word) const;
  /// The line's first coordinate, or the motion's G: where a finding about the motion stands.
  const syntax::Word& motion_word() const;
  /// The motion's word of this letter, or null.
  const syntax::Word* argument(char letter) const;
};

/// What a line can have that a rule asks about.
inline constexpr unsigned kMotion = 1;      ///< A motion, by its G or continued.
inline constexpr unsigned kModal = 2;       ///< Any other G.
inline constexpr unsigned kFunction = 4;    ///< An M but for M06.
inline constexpr unsigned kToolChange = 8;  ///< M06.
inline constexpr unsigned kSpindle = 16;    ///< An S.
inline constexpr unsigned kFeed = 32;       ///< An F.

/// A rule tells what it thinks of a block that has one of `concerns`, or of the motion of a block. Each has a file of
/// its name in this folder, and a row in the table of diagnostics; the build gathers them. `check` is not asked about
/// the plain motions that nothing in State::knowledge concerns, so it must not speak of them; `check_move` is asked
/// about all motions whose ends are known, but only where watches_moves().
struct Rule {
  unsigned concerns = 0;
  void (*check)(const Block& block, execution::Sink& sink) = nullptr;
  void (*check_move)(const Block& block, const execution::Move& move, execution::Sink& sink) = nullptr;
};

inline void report(execution::Sink& sink, dialect::DiagnosticId id, syntax::Span span, double value = 0,
                   syntax::Span related = {}) {
  sink.report({.id = id, .span = span, .related = related, .values = {value}});
}

/// Asks all rules.
void run_rules(const Block& block, execution::Sink& sink);

/// Whether motions are to be judged one by one. It takes the short cut for plain lines away, so only who has given
/// limits, or asks for opinions on all motions, pays for it.
bool checks_moves(const execution::Setup& setup);

/// Asks all rules about the motion of a block, given in the frame in force behind it.
void run_move_rules(const Block& block, const execution::Move& move, execution::Sink& sink);

/// Judges an arc that the control accepts: W142 where it is legal both ways and centers of the program are suspected
/// of counting from the start, else W112 where it would not fit with half the tolerance.
void judge_arc(const execution::CenteredArc& arc, const geometry::CenterReadings& readings, bool suspects_centers,
               const execution::Setup& setup, execution::Sink& sink);

}  // namespace isocnc::rules
