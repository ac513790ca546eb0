#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/syntax/formatter.h"

namespace isocnc::formatting {

/// The style of line numbers.
struct NumberStyle {
  std::uint64_t start = 10;
  std::uint64_t step = 10;  ///< 1 or more.
  bool all_lines = false;   ///< Whether blocks without a number get one.
};

/// Calls `look` with all lines of a program, in order.
using EachLine = std::function<void(const std::function<void(const syntax::LineTree&)>& look)>;

/// The lines of a text, which must outlive this.
EachLine each_line_of(std::string_view text);

/// The new line numbers of a program, and with them the labels of its jumps.
class Renumbering {
 public:
  /// The reason why a program cannot be renumbered.
  struct RenumberingObstacle {
    enum class Kind : std::uint8_t { Error, LabelMissing, LabelTwice, TooManyDigits };

    Kind kind = Kind::Error;
    std::size_t line = 0;  ///< The line, counted from 0.
    std::string label;     ///< The label as the GOTO writes it.

    std::string message(dialect::Language language) const;
  };

  /// Reads the whole program to find the targets of its jumps.
  Renumbering(const EachLine& each_line, const NumberStyle& style);

  const std::optional<RenumberingObstacle>& obstacle() const { return obstacle_; }
  /// Adds the change of the next line's numbers; needs all lines, in order, and no obstacle.
  /// `may_go_on`: as MotionInForce::may_go_on().
  void change(const syntax::LineTree& line, bool may_go_on, syntax::LineChange& change);

 private:
  struct NumberedLabel {
    std::string text;
    std::size_t jump_line = 0;
    std::uint64_t number = 0;  // The new number.
    bool is_defined = false;
  };

  void read_jump(std::size_t number, const syntax::LineTree& line);
  void number_label(std::size_t number, const syntax::LineTree& line, bool may_go_on);
  bool is_numbered(const syntax::LineTree& line, bool may_go_on) const;
  void refuse(RenumberingObstacle::Kind kind, std::size_t line, std::string label = {});

  NumberStyle style_;
  std::uint64_t next_;
  std::unordered_map<std::uint64_t, NumberedLabel> labels_;  // The labels that jumps name.
  std::optional<RenumberingObstacle> obstacle_;
};

}  // namespace isocnc::formatting
