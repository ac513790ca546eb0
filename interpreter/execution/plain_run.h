#pragma once

#include <span>

#include "interpreter/execution/state.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::execution {

/// What a row of plain lines has done, apart from where it has moved.
struct PlainEffects {
  dialect::LetterSet letters = 0;  ///< Letters of the arguments of all motions.
  bool has_fed = false;            ///< Whether there was a feed move.
  bool has_taken_feed = false;     ///< Whether a feed move had an F.
  bool has_arc = false;            ///< Whether there was an arc.

  /// Whether there was a motion.
  bool has_run() const { return letters != 0; }
};

/// Executes plain lines in a row (LineTree::plain_arguments), as execute() does with a sink that wants no effects:
/// motions that are valid. Reports none of their steps. Caches everything that plain lines cannot
/// change, so that each line is cheap. During the run only `state.position` is up to date; the destructor updates the
/// rest.
class PlainRun {
 public:
  /// With `leaves_open_centers`, an arc under G90 whose center could also be incremental is not plain.
  PlainRun(State& state, const Setup& setup, bool leaves_open_centers = false)
      : state_(state),
        setup_(setup),
        leaves_open_centers_(leaves_open_centers),
        scale_(state.mm_per_unit()),
        straight_(state.unknown == 0 ? straight_letters() : 0),
        incremental_(state.incremental()),
        unknown_(state.unknown),
        may_run_(state.tool_selected && (unknown_ == 0 || !incremental_) && (state.in_doubt & kJudged) == 0 &&
                 state.lack.empty()),
        feed_holds_(state.feed_given && !state.inverse_time()),
        motion_(state.motion() ? state.motion()->role : kNoMotion) {}
  PlainRun(const PlainRun&) = delete;
  PlainRun& operator=(const PlainRun&) = delete;
  ~PlainRun() {
    if (effects_.has_run()) finish();
  }

  /// Runs a rapid, a line or a valid arc if the tool and the feed are known. Does nothing and returns false for any
  /// other line. Inlined by force, as most lines of a program come here.
  [[gnu::always_inline]] bool run(const syntax::PlainLine& line) {
    if (!may_run_ || !line.has_coordinates()) return false;
    const dialect::GRole motion = line.row == dialect::kUnknownGCode ? motion_ : dialect::kGCodes[line.row].role;
    const bool has_feed = line.feed >= 0;
    if (motion == dialect::GRole::Rapid ? has_feed : !has_feed && !feed_holds_) return false;
    if (motion != dialect::GRole::Rapid && motion != dialect::GRole::Line) {
      if (motion == kNoMotion || !is_sound_arc(line.words, line.arguments)) return false;
    } else if ((line.arguments & ~straight_) != 0 && !runs_from_unknown(line.arguments)) {
      return false;
    }
    move_axes(line);
    if (has_feed) take_feed(line.words[static_cast<std::size_t>(line.feed)].value);
    motion_ = motion;
    effects_.letters |= line.arguments;
    effects_.has_fed |= motion != dialect::GRole::Rapid;
    return true;
  }

  /// Whether it can run any line.
  bool may_run() const { return may_run_; }
  const PlainEffects& effects() const { return effects_; }
  bool is_incremental() const { return incremental_; }
  /// Whether the last line was an arc.
  bool was_arc() const { return motion_ != dialect::GRole::Rapid && motion_ != dialect::GRole::Line; }
  /// Whether there was an arc under G90 whose center could also be incremental.
  bool met_open_center() const { return met_open_center_; }

  /// Copies all that a row of plain lines with these effects passes on: what it neither reads nor changes.
  static void copy_passed_on(const State& from, const PlainEffects& row, State& to);
  /// Copies all that such a row does not read: what it passes on, and what it sets whatever that was. A row that has
  /// run from one state runs in the same way from any other that differs in this alone.
  static void copy_unread(const State& from, const PlainEffects& row, State& to);

 private:
  static constexpr dialect::GRole kNoMotion = dialect::GRole::Mode;
  /// The groups on which all plain lines depend; arcs also depend on the plane, and B and C on the interpolation. An
  /// arc on a face is no plain line.
  static constexpr std::uint16_t kJudged =
      State::bit(dialect::ModalGroup::Motion) | State::bit(dialect::ModalGroup::Units) |
      State::bit(dialect::ModalGroup::Distance) | State::bit(dialect::ModalGroup::FeedMode);

  [[gnu::always_inline]] void move_axes(const syntax::PlainLine& line) {
    if (incremental_) return advance_axes(line.words);
    geometry::Pose& position = state_.position;
    for (const syntax::Word& word : line.words) {
      const auto axis = static_cast<std::uint32_t>(word.letter - 'X');
      if (axis <= 2) [[likely]] {
        position.tip[static_cast<Eigen::Index>(axis)] = word.value * scale_;
      } else if (word.letter == 'B') {
        position.b = word.value;
      } else if (word.letter == 'C') {
        position.c = word.value;
      }
    }
  }
  dialect::LetterSet straight_letters() const {
    const bool may_turn = state_.five_axis() && !state_.is_in_doubt(dialect::ModalGroup::Interpolation);
    return may_turn ? dialect::kCoordinateLetters : dialect::kLinearLetters;
  }
  bool runs_from_unknown(dialect::LetterSet arguments);
  // These do not take the line itself, since a reference to it would keep it in memory, and out of the registers.
  void advance_axes(std::span<const syntax::Word> words);
  bool is_sound_arc(std::span<const syntax::Word> words, dialect::LetterSet arguments);
  void take_feed(double number);
  void finish();

  State& state_;
  const Setup& setup_;
  const bool leaves_open_centers_;
  const double scale_;
  dialect::LetterSet straight_;  ///< Axes that a straight motion may move; while some are unknown, none.
  const bool incremental_;
  AxisSet unknown_;  ///< Axes whose position is unknown: only lines under G90 run then, and no arcs.
  const bool may_run_;
  bool feed_holds_;        ///< Whether a feed move without F is valid.
  dialect::GRole motion_;  ///< The role of the motion in force, or kNoMotion.
  PlainEffects effects_;
  bool met_open_center_ = false;
};

}  // namespace isocnc::execution
