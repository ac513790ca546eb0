#include "analyzer/check_text.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

#include "analyzer/checker.h"
#include "analyzer/rendering.h"
#include "interpreter/syntax/characters.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::analyzer {

using syntax::TreeStore;

/// Text that is parsed in one go: its trees should stay in the cache until they are executed.
static constexpr std::size_t kBatchBytes = 16 * 1024;

namespace {

/// Lines that have been parsed, not yet executed.
struct Batch {
  const char* text = nullptr;
  std::size_t size = 0;
  TreeStore trees;

  /// Parses whole lines from `begin`, at least one.
  void parse(const char* begin, const char* batch_end, const char* end) {
    text = begin;
    size = static_cast<std::size_t>(batch_end - begin);
    trees.clear();
    for (const char* p = begin; p < batch_end;) p = syntax::skip_line_end(trees.append_line(p, end), end);
  }

  /// Executes them as lines `line` and following; returns the line after them.
  std::uint64_t check(Checker& checker, std::uint64_t line, Outcome& outcome) const {
    const char* p = text;
    for (std::size_t i = 0; i < trees.size(); ++i) {
      checker.check(trees.tree(i, p), line++, outcome);
      if (checker.frontier.finished()) return line;
      p += trees.length(i);
      if (i + 1 < trees.size()) p = syntax::skip_line_end(p, text + size);
    }
    return line;
  }
};

/// One pass over the text. Threads take batches in order, parse them side by side, and execute them one after another.
class Pass {
 public:
  Pass(std::string_view text, const execution::Setup& setup, const JumpMap& jumps)
      : next_(text.data()), end_(text.data() + text.size()), checker_(setup, jumps) {}

  void run(int jobs) {
    std::vector<std::thread> helpers;
    for (int i = 1; i < jobs; ++i) helpers.emplace_back([this] { work(); });
    work();
    for (std::thread& helper : helpers) helper.join();
  }

  const Checker& checker() const { return checker_; }
  Outcome take_outcome() { return std::move(outcome_); }

 private:
  void work() {
    Batch batch;
    while (!finished_.load(std::memory_order_relaxed)) {
      const char* begin;
      const char* batch_end;
      std::uint64_t ticket;
      {
        const std::lock_guard lock(taking_);
        if (next_ == end_) return;
        begin = next_;
        batch_end = syntax::skip_line_end(
            syntax::find_line_end(next_ + std::min<std::ptrdiff_t>(kBatchBytes, end_ - next_), end_), end_);
        next_ = batch_end;
        ticket = next_ticket_++;
      }
      batch.parse(begin, batch_end, end_);
      for (std::uint64_t turn = turn_.load(std::memory_order_acquire); turn != ticket;
           turn = turn_.load(std::memory_order_acquire))
        turn_.wait(turn, std::memory_order_acquire);
      if (!finished_.load(std::memory_order_relaxed)) {
        line_ = batch.check(checker_, line_, outcome_);
        if (checker_.frontier.finished()) finished_.store(true, std::memory_order_relaxed);
      }
      turn_.store(ticket + 1, std::memory_order_release);
      turn_.notify_all();
    }
  }

  std::mutex taking_;
  const char* next_;  // Guarded by taking_.
  const char* const end_;
  std::uint64_t next_ticket_ = 0;  // Guarded by taking_.
  std::atomic<std::uint64_t> turn_ = 0;
  std::atomic<bool> finished_ = false;
  Checker checker_;  // With line_ and outcome_: of the thread whose turn it is.
  std::uint64_t line_ = 0;
  Outcome outcome_;
};

}  // namespace

/// The lines on which each label that a GOTO names is defined.
static std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> label_lines(std::string_view text,
                                                                                 const JumpMap& jumps) {
  std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> lines;
  TreeStore store;
  const char* p = text.data();
  const char* const end = text.data() + text.size();
  for (std::uint64_t line = 0; p != end; ++line) {
    store.clear();
    const char* const line_end = store.append_line(p, end);
    const syntax::LineTree tree = store.tree(0, p);
    if (tree.has_label() && jumps.names(tree.label)) lines[tree.label].push_back(line);
    p = syntax::skip_line_end(line_end, end);
  }
  return lines;
}

Report check_text(std::string_view text, const execution::Setup& setup, int jobs) {
  jobs = std::clamp<int>(jobs, 1, static_cast<int>(text.size() / kBatchBytes) + 1);
  JumpMap jumps(text);
  for (;;) {
    Pass pass(text, setup, jumps);
    pass.run(jobs);
    std::vector<Outcome> outcomes;
    outcomes.push_back(pass.take_outcome());
    if (jumps.is_resolved() || all_jumps_land(outcomes.front(), jumps))
      return conclude(std::move(outcomes), pass.checker().frontier, jumps,
                      [&](std::uint64_t line) { return LineFinder(text).line(line); });
    // Rare: a jump whose label is not below it (E004, E005), or not among the lines that had to be read. Once more, now
    // with all labels known.
    jumps.resolve(label_lines(text, jumps));
  }
}

}  // namespace isocnc::analyzer
