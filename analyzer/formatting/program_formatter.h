#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "analyzer/formatting/motion_in_force.h"
#include "analyzer/formatting/renumbering.h"
#include "interpreter/configuration/configuration.h"
#include "interpreter/syntax/formatter.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::formatting {

enum class MotionStyle : std::uint8_t {
  Keep,
  Write,
  Fold
};  ///< Motion Gs: as written, on each line, where they change.

/// How a program is written.
struct ProgramStyle {
  syntax::LineStyle line;
  MotionStyle motions = MotionStyle::Keep;
  std::optional<NumberStyle> numbers;
};

/// What a configuration wants programs to look like.
ProgramStyle style_by(const configuration::Format& format);

/// Writes the lines of a program as they should be written, one after another; is shown all of them, in order.
class LinesFormatter {
 public:
  /// `each_line` is asked only where lines are numbered anew.
  LinesFormatter(const ProgramStyle& style, const EachLine& each_line);

  /// Why the program cannot be renumbered; no line is to be shown then.
  const std::optional<Renumbering::Obstacle>& obstacle() const { return obstacle_; }
  /// What becomes of the next line beside its style.
  syntax::LineChange next(const syntax::LineTree& line);
  /// The line with that change: line.text itself where it stays as it is. Valid until the next call.
  std::string_view written(const syntax::LineTree& line, const syntax::LineChange& change) {
    return formatter_.format(line, change);
  }

 private:
  syntax::LineChange::Motion motion_change(const syntax::LineTree& line) const;

  MotionStyle motions_;
  syntax::Formatter formatter_;
  std::optional<Renumbering> numbers_;
  std::optional<Renumbering::Obstacle> obstacle_;
  MotionInForce motion_;
};

/// Lines of a program as they stand, and as they should stand. There are as many of them, with the same ends.
struct FormattedPiece {
  std::string_view before;
  std::string_view after;

  bool is_changed() const { return before != after; }
};

/// Writes a whole program as it should be written, in pieces of whole lines, so that a program of any length takes no
/// more memory than a short one. The program does what it did.
class ProgramFormatter {
 public:
  ProgramFormatter(std::string_view text, const ProgramStyle& style);

  /// Why the program cannot be renumbered; nothing of it is formatted then.
  const std::optional<Renumbering::Obstacle>& obstacle() const { return lines_.obstacle(); }
  /// The next piece, nothing behind the last; `after` is valid until the next call.
  std::optional<FormattedPiece> next();

 private:
  void add_line(const syntax::LineTree& line);

  LinesFormatter lines_;
  const char* next_;
  const char* const end_;
  syntax::TreeStore store_;
  std::string after_;             // All lines of the piece up to where the first that stays as it is begins.
  const char* copied_ = nullptr;  // Up to here the piece has been taken over.
};

}  // namespace isocnc::formatting
