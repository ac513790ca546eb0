#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "analyzer/check/checker.h"
#include "analyzer/check/frontier_change.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::check {

/// Whether no later line is executed, and that has been reported.
bool is_over(const Frontier& frontier);

/// Whole lines of a program in a row, parsed to be executed.
class Batch {
 public:
  /// Parses the lines, at least one. `end`: of the program.
  void parse(std::string_view text, const char* end);
  std::string_view text() const { return text_; }
  /// Executes the lines, the first as line `line`. Returns the number of the line after them; of the one after the last
  /// line executed, if that ends the program.
  std::size_t check(Checker& checker, std::size_t line, Outcome& outcome) const;

 private:
  std::string_view text_;
  syntax::TreeStore trees_;
};

/// Many lines of a program, on their way through a check in batches. While the frontier before them is not known yet,
/// they may be executed ahead, from one that is assumed, and joined later: modes are few and soon written again, and
/// positions are written anew, or add up (G91).
class Portion {
 public:
  /// Few enough bytes that the trees stay in the cache until they are executed.
  static constexpr std::ptrdiff_t kBatchBytes = 16 * 1024;

  /// So much of the lines above is executed before lines are executed ahead.
  static constexpr std::ptrdiff_t kBytesAbove = 16 * 1024;
  /// How long portions of a text are for so many threads: long, as the first lines of each may have to be executed
  /// again, but enough of them for all threads.
  static std::ptrdiff_t bytes_for(std::size_t text, int threads);

  /// Starts with whole lines, at least one. `end`: of the program. Keeps the memory of the portion before.
  void start(std::string_view text, const char* end);

  std::string_view text() const { return text_; }

  /// Executes the lines from the frontier that `checker` has, which is that of a line further up. The lines directly
  /// above, `above`, are executed first, so that what they set is right.
  void check_ahead(Checker& checker, std::string_view above);
  bool is_ahead() const { return !ahead_.empty(); }
  /// Checks the lines, the first as line `line`, from the frontier of `checker`. What has been executed ahead is taken
  /// over where it gives the same findings from there; the other batches are executed. Returns the number of the line
  /// after the last one executed.
  std::size_t check(Checker& checker, std::size_t line, Outcome& outcome);
  /// Batches that the last check() has taken over, and that it has executed.
  std::size_t taken_over() const { return taken_over_; }
  std::size_t executed() const { return executed_; }

 private:
  /// A batch as it was executed ahead.
  struct Ahead {
    Frontier before;
    Outcome outcome;
    std::size_t lines = 0;
  };

  std::string_view batch_at(const char* begin) const;
  std::size_t take_over(std::size_t first, FrontierChange change, Checker& checker, std::size_t& line,
                        Outcome& outcome);

  std::string_view text_;
  const char* end_ = nullptr;
  Batch batch_;  // The lines that are being executed.
  std::vector<Ahead> ahead_;
  Frontier after_;  // Of the last batch executed ahead.
  std::size_t taken_over_ = 0;
  std::size_t executed_ = 0;
};

}  // namespace isocnc::check
