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
};  ///< Motion Gs: as written, on each line, or only where they change.

/// The format of a program.
struct ProgramStyle {
  syntax::LineStyle line;
  MotionStyle motions = MotionStyle::Keep;
  std::optional<NumberStyle> numbers;
};

/// The program format that a configuration asks for.
ProgramStyle style_by(const configuration::Format& format);

/// Formats the lines of a program one after another; needs all of them, in order.
class LinesFormatter {
 public:
  /// `each_line` is called only to renumber lines.
  LinesFormatter(const ProgramStyle& style, const EachLine& each_line);

  /// The reason why the program cannot be renumbered; next() must not be called then.
  const std::optional<Renumbering::RenumberingObstacle>& obstacle() const { return obstacle_; }
  /// The change of the next line besides its style.
  syntax::LineChange next(const syntax::LineTree& line);
  /// The line after that change: line.text itself if nothing changes. Valid until the next call.
  std::string_view written(const syntax::LineTree& line, const syntax::LineChange& change) {
    return formatter_.format(line, change);
  }

 private:
  syntax::LineChange::MotionEdit motion_change(const syntax::LineTree& line) const;

  MotionStyle motions_;
  bool orders_words_ = false;
  syntax::Formatter formatter_;
  std::optional<Renumbering> numbers_;
  std::optional<Renumbering::RenumberingObstacle> obstacle_;
  MotionInForce motion_;
};

/// Lines of a program before and after formatting: the same number, with the same line ends.
struct FormattedPiece {
  std::string_view before;
  std::string_view after;

  bool is_changed() const { return before != after; }
};

/// Formats a whole program in pieces of whole lines, so that a long program takes no more memory than a short one. The
/// effects of the program stay the same.
class ProgramFormatter {
 public:
  ProgramFormatter(std::string_view text, const ProgramStyle& style);

  /// The reason why the program cannot be renumbered; nothing is formatted then.
  const std::optional<Renumbering::RenumberingObstacle>& obstacle() const { return lines_.obstacle(); }
  /// The next piece, or nothing after the last; `after` is valid until the next call.
  std::optional<FormattedPiece> next();

 private:
  void add_line(const syntax::LineTree& line);

  LinesFormatter lines_;
  const char* const begin_;
  const char* next_;
  const char* const end_;
  syntax::TreeStore store_;
  std::string after_;             // The formatted piece, up to the last changed line.
  const char* copied_ = nullptr;  // The end of the text already copied to after_.
};

}  // namespace isocnc::formatting
