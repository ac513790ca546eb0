#include "analyzer/check/check_text.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

#include "analyzer/check/batch.h"
#include "analyzer/check/conclusion.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/text/characters.h"
#include "interpreter/threads/side_by_side.h"

namespace isocnc::check {

namespace {

/// What one pass over the text needs.
struct Input {
  std::string_view text;
  const rules::CheckSetup& setup;
  const JumpMap& jumps;
  bool suspects_centers = false;
  const std::function<void(std::size_t)>& on_progress;
};

/// Where one pass over the text stands.
class Pass {
 public:
  explicit Pass(const Input& input)
      : begin_(input.text.data()),
        next_(input.text.data()),
        end_(input.text.data() + input.text.size()),
        checker_(input.setup, input.jumps, input.suspects_centers),
        on_progress_(input.on_progress) {}
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;

  const Checker& checker() const { return checker_; }
  Outcome take_outcome() { return std::move(outcome_); }

 protected:
  ~Pass() = default;

  bool is_all_taken() const { return next_ == end_; }
  /// The next lines of the text, at least so many bytes.
  std::string_view take(std::ptrdiff_t bytes) {
    const std::string_view lines = text::whole_lines(next_, bytes, end_);
    next_ += lines.size();
    return lines;
  }
  /// The lines directly above a place, at most so many bytes.
  std::string_view lines_above(const char* place, std::ptrdiff_t bytes) const {
    const char* const above = text::next_line(place - std::min(bytes, place - begin_), end_);
    return {above, static_cast<std::size_t>(place - above)};
  }
  /// Checks the next lines, a Batch or a Portion, with this text.
  template <class Lines>
  void check(Lines& lines, std::string_view text) {
    line_ = lines.check(checker_, line_, outcome_);
    if (on_progress_) on_progress_(static_cast<std::size_t>(text.data() - begin_) + text.size());
  }
  bool is_over() const { return check::is_over(checker_.frontier); }
  const char* end() const { return end_; }

 private:
  const char* const begin_;
  const char* next_;
  const char* const end_;
  Checker checker_;
  const std::function<void(std::size_t)>& on_progress_;
  std::size_t line_ = 0;
  Outcome outcome_;
};

/// By one thread.
class LonePass final : public Pass {
 public:
  using Pass::Pass;

  void run() {
    Batch batch;
    while (!is_all_taken() && !is_over()) {
      batch.parse(take(Portion::kBatchBytes), end());
      check(batch, batch.text());
    }
  }
};

/// By several threads. Each takes the next lines and prepares them. Whoever has prepared those that are due checks
/// them, and all that are ready after them; the others go on preparing.
class SharedPass : public Pass {
 public:
  void run(int jobs) {
    threads::side_by_side(jobs, [this] { work(); });
  }

 protected:
  /// `at_once`: the most pieces that are open at once, each in a slot of its own; `bytes`: of a piece.
  SharedPass(const Input& input, int at_once, std::ptrdiff_t bytes)
      : Pass(input), is_ready_(static_cast<std::size_t>(at_once)), bytes_(bytes) {}
  ~SharedPass() = default;

  std::size_t slot_count() const { return is_ready_.size(); }
  /// Prepares lines in a slot. `lock` is held at the call and after it, and may be released meanwhile.
  virtual void prepare(std::size_t slot, std::string_view lines, bool is_due, std::unique_lock<std::mutex>& lock) = 0;
  /// Checks the lines in a slot; called in their order, by one thread at a time.
  virtual void check_slot(std::size_t slot) = 0;
  /// After that, with the lock held. Returns whether lines may be prepared that are not due.
  virtual bool may_go_ahead() { return true; }

 private:
  std::size_t slot(std::uint64_t ticket) const { return ticket % is_ready_.size(); }

  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      may_take_.wait(lock, [&] {
        return finished_ || is_all_taken() || taken_ - checked_ < (goes_ahead_ ? is_ready_.size() : 1);
      });
      if (finished_ || is_all_taken()) return;
      const std::string_view lines = take(bytes_);
      const std::uint64_t ticket = taken_++;
      prepare(slot(ticket), lines, ticket == checked_, lock);
      is_ready_[slot(ticket)] = true;
      if (!is_checking_) check_ready(lock);
    }
  }

  void check_ready(std::unique_lock<std::mutex>& lock) {
    is_checking_ = true;
    while (!finished_ && checked_ < taken_ && is_ready_[slot(checked_)]) {
      const std::size_t due = slot(checked_);
      lock.unlock();
      check_slot(due);
      lock.lock();
      goes_ahead_ = may_go_ahead();
      is_ready_[due] = false;
      ++checked_;
      finished_ = is_over();
      may_take_.notify_all();
    }
    is_checking_ = false;
  }

  std::mutex mutex_;  // Guards the members below, and what the pass has taken.
  std::condition_variable may_take_;
  std::vector<char> is_ready_;  // By slot: whether its lines wait to be checked.
  const std::ptrdiff_t bytes_;
  std::uint64_t taken_ = 0;
  std::uint64_t checked_ = 0;
  bool is_checking_ = false;
  bool goes_ahead_ = true;
  bool finished_ = false;
};

/// Threads parse ahead; one at a time executes.
class ParsingPass final : public SharedPass {
 public:
  ParsingPass(const Input& input, int jobs) : SharedPass(input, 3 * jobs, kBytes), batches_(slot_count()) {}

  /// Large enough that handing a batch over costs little in comparison.
  static constexpr std::ptrdiff_t kBytes = 64 * 1024;

 private:
  void prepare(std::size_t slot, std::string_view lines, bool, std::unique_lock<std::mutex>& lock) override {
    lock.unlock();
    batches_[slot].parse(lines, end());
    lock.lock();
  }
  void check_slot(std::size_t slot) override { check(batches_[slot], batches_[slot].text()); }

  std::vector<Batch> batches_;
};

/// Threads execute ahead what is not due, from the latest frontier that is known; then only joining remains.
class ExecutingPass final : public SharedPass {
 public:
  /// Where jumps are close together, paths seldom meet before the next one, so that what is assumed would be wrong.
  static bool suits(const Input& input) {
    return input.jumps.sites().size() <= input.text.size() / (2 * static_cast<std::size_t>(Portion::kBatchBytes));
  }
  ExecutingPass(const Input& input, int jobs)
      : SharedPass(input, 2 * jobs, Portion::bytes_for(input.text.size(), jobs)),
        input_(input),
        portions_(slot_count()) {
    check_first_lines();
    assumed_ = checker().frontier;
  }

 private:
  /// After so many portions in a row of which nothing could be taken over, so many are executed in order.
  static constexpr int kMostMisses = 4;
  static constexpr int kInOrder = 16;

  /// So that what the first of all threads assume has a tool.
  void check_first_lines() {
    Batch batch;
    batch.parse(take(Portion::kBatchBytes), end());
    check(batch, batch.text());
  }

  void prepare(std::size_t slot, std::string_view lines, bool is_due, std::unique_lock<std::mutex>& lock) override {
    portions_[slot].start(lines, end());
    if (is_due) return;
    Checker ahead(input_.setup, input_.jumps, input_.suspects_centers);
    ahead.frontier = assumed_;
    lock.unlock();
    const std::string_view above = lines_above(lines.data(), Portion::kBytesAbove);
    ahead.frontier.next_jump = input_.jumps.count_above(static_cast<std::size_t>(above.data() - input_.text.data()));
    portions_[slot].check_ahead(ahead, above);
    lock.lock();
  }
  void check_slot(std::size_t slot) override {
    Portion& portion = portions_[slot];
    const bool is_ahead = portion.is_ahead();
    check(portion, portion.text());
    if (!is_ahead) {
      in_order_ = std::max(in_order_ - 1, 0);
    } else if (portion.taken_over() > 0) {
      misses_ = 0;
    } else if (++misses_ == kMostMisses) {
      misses_ = 0;
      in_order_ = kInOrder;
    }
  }
  bool may_go_ahead() override {
    assumed_ = checker().frontier;
    return in_order_ == 0;
  }

  const Input& input_;
  std::vector<Portion> portions_;
  Frontier assumed_;
  int misses_ = 0;
  int in_order_ = 0;  // Portions that are still to be executed in order.
};

/// Checks the text with a pass that suits it; returns what that has found.
std::pair<Outcome, Frontier> pass_over(const Input& input, int jobs) {
  const auto result = [](Pass& pass) { return std::pair(pass.take_outcome(), pass.checker().frontier); };
  if (jobs == 1) {
    LonePass pass(input);
    pass.run();
    return result(pass);
  }
  if (ExecutingPass::suits(input)) {
    ExecutingPass pass(input, jobs);
    pass.run(jobs);
    return result(pass);
  }
  ParsingPass pass(input, jobs);
  pass.run(jobs);
  return result(pass);
}

}  // namespace

Report check_text(std::string_view text, const rules::CheckSetup& setup, int jobs,
                  const std::function<void(std::size_t)>& on_progress) {
  jobs = std::clamp<int>(jobs, 1, static_cast<int>(text.size() / ParsingPass::kBytes) + 1);
  JumpMap jumps(text, jobs);
  bool suspects_centers = false;
  for (;;) {
    auto [outcome, end] = pass_over({text, setup, jumps, suspects_centers, on_progress}, jobs);
    // Two rare reasons for one more pass each. A jump's label is not below it (E004, E005), or was not read: repeat
    // with all labels known. Some arcs have centers that count from the start and others may have: repeat to report
    // those (W142).
    if (!jumps.knows_labels() && !all_jumps_resolve(outcome, jumps)) {
      jumps = JumpMap::with_labels(text, jobs);
    } else if (!suspects_centers && outcome.centers.from_start && outcome.centers.open) {
      suspects_centers = true;
    } else {
      return conclude(std::move(outcome), end, jumps,
                      [&](std::size_t line) { return syntax::LineFinder(text).line(line); });
    }
  }
}

}  // namespace isocnc::check
