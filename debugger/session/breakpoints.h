#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "debugger/session/expression.h"
#include "interpreter/running/runner.h"

namespace isocnc::debugger::session {

/// Which of its hits a breakpoint stops at: `3` or `=3` the third, `>=3` from the third on, `%3` every third.
class HitCondition {
 public:
  /// None where the text is no such condition.
  static std::optional<HitCondition> read(std::string_view text);
  bool admits(std::uint64_t hit) const;

 private:
  enum class Kind : std::uint8_t { Equal, Less, LessEqual, Greater, GreaterEqual, Every };
  Kind kind_ = Kind::Equal;
  std::uint64_t count_ = 0;
};

/// A text with expressions in braces: `Z is {Z,2}`. `{{` and `}}` are braces.
class LogMessage {
 public:
  static std::variant<LogMessage, ExpressionProblem> compile(std::string_view text, const ValueFormat& format,
                                                             dialect::Language language);
  std::string at(const Moment& moment) const;

 private:
  struct Piece {
    std::string text;
    std::optional<Expression::Formatted> value;  ///< Behind the text.
  };
  std::vector<Piece> pieces_;
};

/// When a breakpoint that has been reached counts, and what it does then.
struct BreakpointRules {
  std::string text;  ///< As the client has written them.
  std::optional<Expression> condition;
  std::optional<HitCondition> hits;
  std::optional<LogMessage> message;  ///< Is told, and the run goes on.
};

/// The blocks, by their number in the run, at which a breakpoint has been hit so far. They are counted where they are
/// first met, so that a block that the run comes to again is the same hit as before. A breakpoint that the client sets
/// anew as it is, since it has changed another one, goes on counting.
class HitCounter {
 public:
  /// Which hit it is, from 1.
  std::uint64_t count(std::uint64_t block);
  /// The run goes another way from this block on.
  void forget_from(std::uint64_t block);

 private:
  std::vector<std::uint64_t> blocks_;  ///< In order.
};

/// A code that a function breakpoint waits for: M, T or G with its number.
struct WantedCode {
  char letter = 'M';
  std::uint32_t number = 0;

  friend bool operator==(const WantedCode&, const WantedCode&) = default;

  static std::optional<WantedCode> read(std::string_view name);
  bool is_in(const syntax::LineTree& tree) const;
};

/// What a data breakpoint watches: a value that becomes another one, or that passes a threshold.
struct Watched {
  Expression value;
  std::string name;                 ///< As it is told.
  std::optional<double> threshold;  ///< `Z = 0`: crossed when the value comes to it or passes it.

  /// `V3`, `Z`, `Z = 0`.
  static std::variant<Watched, ExpressionProblem> compile(std::string_view text, dialect::Language language);
  bool tells(double before, double after) const;
};

/// Values that data breakpoints watch, at moments that follow one another.
struct Trail {
  std::size_t width = 0;  ///< Values of each moment.
  std::vector<double> values;
};

/// A breakpoint of any kind.
struct Breakpoint {
  std::int64_t id = 0;
  BreakpointRules rules;
  HitCounter counter;
};

struct LineBreakpoint : Breakpoint {
  std::uint64_t line = 0;
};
struct FunctionBreakpoint : Breakpoint {
  WantedCode code;
};
struct DataBreakpoint : Breakpoint {
  Watched watched;
};

/// In which direction a run comes to a block. Log points are silent on the way backward.
enum class Direction : std::uint8_t { Forward, Backward };

struct BlockEffect;

/// All breakpoints of a session. A block without any costs the look at one bit.
class Breakpoints {
 public:
  void set_lines(std::vector<LineBreakpoint> breakpoints, std::uint64_t line_count);
  void set_functions(std::vector<FunctionBreakpoint> breakpoints);
  void set_data(std::vector<DataBreakpoint> breakpoints);

  bool has_line(std::uint64_t line) const {
    return line / 64 < bits_.size() && ((bits_[line / 64] >> (line % 64)) & 1) != 0;
  }
  bool has_functions() const { return !functions_.empty(); }
  bool has_data() const { return !data_.empty(); }
  /// Whether it matters what a value has been between two blocks.
  bool has_thresholds() const;

  /// What comes of the breakpoints that a block, or a change, has reached.
  struct Outcome {
    std::vector<std::int64_t> stopped;  ///< Breakpoints that the run stops at.
    std::vector<std::string> messages;  ///< Of log points.
  };

  // Which breakpoints a block hits, in its line, by its codes, or by the values that it changes. They are added to
  // `outcome`.
  void judge_line(const Moment& moment, std::uint64_t block, Direction direction, Outcome& outcome);
  void judge_functions(const syntax::LineTree& tree, const Moment& moment, std::uint64_t block, Direction direction,
                       Outcome& outcome);
  /// `moment` is the last of the trail.
  void judge_data(const Trail& trail, const Moment& moment, std::uint64_t block, Direction direction, Outcome& outcome);

  /// Begins a trail with the values of the moment before a block.
  void start_trail(const Moment& moment, Trail& trail) const;
  /// Appends the values of a moment.
  void read_data(const Moment& moment, Trail& trail) const;
  /// Appends the values along the block's arc, if it has one, where a value may pass a threshold and come back.
  /// `moment` is that before or after the block.
  void read_arc(const BlockEffect& effect, const Moment& moment, Trail& trail) const;
  /// What is told of one that has stopped the run: `V3: 1 -> 2`; empty for others.
  std::string description(std::int64_t id, const Trail& trail) const;

  void forget_hits_from(std::uint64_t block);

 private:
  static std::optional<std::pair<double, double>> find_change(const Watched& watched, std::size_t place,
                                                              const Trail& trail);
  static void reach(Breakpoint& breakpoint, const Moment& moment, std::uint64_t block, Direction direction,
                    Outcome& outcome);

  std::multimap<std::uint64_t, LineBreakpoint> lines_;
  std::vector<std::uint64_t> bits_;  ///< Of lines with breakpoints.
  std::vector<FunctionBreakpoint> functions_;
  std::vector<DataBreakpoint> data_;
};

}  // namespace isocnc::debugger::session
