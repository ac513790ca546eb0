#include "analyzer/check/check_text.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <vector>

#include "analyzer/check/checker.h"
#include "analyzer/check/conclusion.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"
#include "interpreter/threads/side_by_side.h"

namespace isocnc::check {

using syntax::TreeStore;

/// Bytes parsed at a time: few enough that the trees stay in the cache until they are executed.
static constexpr std::ptrdiff_t kBatchBytes = 16 * 1024;
/// The same with several threads: large enough that handing a batch over costs little in comparison.
static constexpr std::ptrdiff_t kSharedBatchBytes = 64 * 1024;

namespace {

/// Whether no later line is executed, and that has been reported.
bool is_over(const Frontier& frontier) { return frontier.finished() && frontier.dead_reported; }

/// Lines that have been parsed, but not executed.
class Batch {
 public:
  const char* text = nullptr;
  std::size_t size = 0;
  TreeStore trees;

  /// Parses whole lines from `begin` on, at least one.
  void parse(const char* begin, const char* batch_end, const char* end) {
    text = begin;
    size = static_cast<std::size_t>(batch_end - begin);
    trees.clear();
    trees.append_lines(begin, batch_end, end);
  }

  /// Executes the lines, the first as line `line`; returns the number of the line after them.
  std::size_t check(Checker& checker, std::size_t line, Outcome& outcome) const {
    const char* p = text;
    for (std::size_t i = 0; i < trees.size();) {
      const std::size_t plain = checker.check_plain_lines(trees, i, line, outcome);
      line += plain;
      for (const std::size_t end = i + plain; i < end; ++i) p = after_line(i, p);
      if (i == trees.size()) break;
      checker.check_any(trees.tree(i, p), line++, outcome);
      if (is_over(checker.frontier)) return line;
      p = after_line(i++, p);
    }
    return line;
  }

 private:
  /// The end of the line that starts at `p`, after its terminator.
  const char* after_line(std::size_t index, const char* p) const {
    return text::skip_line_end(p + trees.length(index), text + size);
  }
};

/// One pass over the text. Threads parse batches in parallel. One thread at a time executes them in order: the one that
/// has parsed the next batch. It continues as long as the following batch is ready; the others parse ahead.
class Pass {
 public:
  Pass(std::string_view text, const rules::CheckSetup& setup, const JumpMap& jumps, bool suspects_centers, int jobs,
       const std::function<void(std::size_t)>& on_progress)
      : on_progress_(on_progress),
        jobs_(jobs),
        ring_(static_cast<std::size_t>(jobs == 1 ? 1 : kAhead * jobs)),
        batch_bytes_(jobs == 1 ? kBatchBytes : kSharedBatchBytes),
        begin_(text.data()),
        next_(text.data()),
        end_(text.data() + text.size()),
        checker_(setup, jumps, suspects_centers) {}

  void run() {
    threads::side_by_side(jobs_, [this] { work(); });
  }

  const Checker& checker() const { return checker_; }
  Outcome take_outcome() { return std::move(outcome_); }

 private:
  /// A slot of the ring: free, being parsed, or waiting to be executed.
  struct Slot {
    Batch batch;
    bool is_ready = false;
  };

  Slot& slot(std::uint64_t ticket) { return ring_[ticket % ring_.size()]; }

  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      may_take_.wait(lock, [&] { return finished_ || next_ == end_ || taken_ - executed_ < ring_.size(); });
      if (finished_ || next_ == end_) return;
      const char* const begin = next_;
      const auto size = std::min<std::ptrdiff_t>(batch_bytes_, end_ - begin);
      next_ = text::skip_line_end(text::find_line_end(begin + size, end_), end_);
      const char* const batch_end = next_;
      Slot& mine = slot(taken_++);
      lock.unlock();
      mine.batch.parse(begin, batch_end, end_);
      lock.lock();
      mine.is_ready = true;
      if (!is_executing_) execute_ready_batches(lock);
    }
  }

  void execute_ready_batches(std::unique_lock<std::mutex>& lock) {
    is_executing_ = true;
    while (!finished_ && executed_ < taken_ && slot(executed_).is_ready) {
      Slot& due = slot(executed_);
      lock.unlock();
      line_ = due.batch.check(checker_, line_, outcome_);
      lock.lock();
      due.is_ready = false;
      ++executed_;
      finished_ = is_over(checker_.frontier);
      if (on_progress_) on_progress_(static_cast<std::size_t>(due.batch.text - begin_) + due.batch.size);
      if (jobs_ > 1) may_take_.notify_all();
    }
    is_executing_ = false;
  }

  static constexpr int kAhead = 3;  // The number of batches parsed ahead, per thread.

  const std::function<void(std::size_t)>& on_progress_;
  const int jobs_;
  std::mutex mutex_;  // Guards the members below, except slots that are not ready and the execution state.
  std::condition_variable may_take_;
  std::vector<Slot> ring_;
  const std::ptrdiff_t batch_bytes_;
  const char* const begin_;
  const char* next_;
  const char* const end_;
  std::uint64_t taken_ = 0;
  std::uint64_t executed_ = 0;
  bool is_executing_ = false;
  bool finished_ = false;
  Checker checker_;
  std::size_t line_ = 0;
  Outcome outcome_;
};

}  // namespace

Report check_text(std::string_view text, const rules::CheckSetup& setup, int jobs,
                  const std::function<void(std::size_t)>& on_progress) {
  jobs = std::clamp<int>(jobs, 1, static_cast<int>(text.size() / kSharedBatchBytes) + 1);
  JumpMap jumps(text);
  bool suspects_centers = false;
  for (;;) {
    Pass pass(text, setup, jumps, suspects_centers, jobs, on_progress);
    pass.run();
    Outcome outcome = pass.take_outcome();
    // Two rare reasons for one more pass each. A jump's label is not below it (E004, E005), or was not read: repeat
    // with all labels known. Some arcs have centers that count from the start and others may have: repeat to report
    // those (W142).
    if (!jumps.knows_labels() && !all_jumps_resolve(outcome, jumps)) {
      jumps = JumpMap::with_labels(text);
    } else if (!suspects_centers && outcome.centers.from_start && outcome.centers.open) {
      suspects_centers = true;
    } else {
      return conclude(std::move(outcome), pass.checker().frontier, jumps,
                      [&](std::size_t line) { return syntax::LineFinder(text).line(line); });
    }
  }
}

}  // namespace isocnc::check
