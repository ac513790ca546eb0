// How many times as fast a check would be on more processors than this machine has:
//   isocnc_schedule FILE [PROCESSORS...]
// Checks a program portion by portion, as threads do that execute ahead, and takes the processor time of
// each step on one processor. Then it lets that many processors do these steps, as check_text() hands them out: each
// takes the next portion and executes it ahead, and whoever has the one that is due takes it over, and all that are
// ready after it. Prints the speed-up over a check by one thread, and the batches that had to be executed again.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <queue>
#include <string_view>
#include <utility>
#include <vector>

#include "analyzer/check/batch.h"
#include "interpreter/system/source_file.h"
#include "interpreter/text/characters.h"

namespace isocnc {
namespace {

using check::Batch;
using check::Checker;
using check::Frontier;
using check::JumpMap;
using check::Outcome;
using check::Portion;

double milliseconds() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The first part of a text, of whole lines.
std::string_view cut(std::string_view& text, std::ptrdiff_t size) {
  const std::string_view part = text::whole_lines(text.data(), size, text.data() + text.size());
  text.remove_prefix(part.size());
  return part;
}

struct Times {
  double ahead = 0;  ///< To execute a portion ahead, ms.
  double join = 0;   ///< To take it over.
};

/// Processors that do the steps of all portions, as the threads of check_text() share them.
class Processors {
 public:
  Processors(const std::vector<Times>& steps, int count)
      : steps_(steps), count_(static_cast<std::size_t>(count)), is_ready_(steps.size()) {}

  /// The time at which all is done.
  double run(double start) {
    for (std::size_t i = 0; i < count_; ++i) take_next(start);
    double now = start;
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      now = event.time;
      if (event.is_joined) {
        ++joined_;
        for (std::size_t waiting = std::exchange(waiting_, 0); waiting > 0; --waiting) take_next(now);
      } else {
        is_ready_[event.portion] = true;
        if (is_joining_) {
          take_next(now);
          continue;
        }
        is_joining_ = true;
      }
      if (joined_ < steps_.size() && is_ready_[joined_]) {
        // A portion that was due when it was taken has not been executed ahead: that is done now.
        const bool was_due = due_ == joined_;
        events_.push({now + (was_due ? steps_[joined_].ahead : steps_[joined_].join), joined_, true});
      } else {
        is_joining_ = false;
        take_next(now);
      }
    }
    return now;
  }

 private:
  struct Event {
    double time = 0;
    std::size_t portion = 0;
    bool is_joined = false;  ///< Whether the portion is joined, or else executed ahead.

    friend bool operator<(const Event& a, const Event& b) { return a.time > b.time; }  // The first is the top.
  };

  void take_next(double now) {
    if (taken_ == steps_.size()) return;
    if (taken_ - joined_ >= 2 * count_) return void(++waiting_);
    const std::size_t portion = taken_++;
    const bool is_due = portion == joined_;
    if (is_due) due_ = portion;
    events_.push({is_due ? now : now + steps_[portion].ahead, portion, false});
  }

  const std::vector<Times>& steps_;
  const std::size_t count_;
  std::vector<bool> is_ready_;
  std::priority_queue<Event> events_;
  std::size_t taken_ = 0;
  std::size_t joined_ = 0;
  std::size_t due_ = static_cast<std::size_t>(-1);  // The last portion that was due when it was taken.
  std::size_t waiting_ = 0;                         // Processors that wait for portions to be joined.
  bool is_joining_ = false;
};

class Schedule {
 public:
  explicit Schedule(std::string_view text) : text_(text), jumps_(text) {}

  /// The time of one thread, ms.
  double measure_alone() const {
    const double begin = milliseconds();
    const JumpMap jumps(text_);
    Checker checker(setup_, jumps);
    Outcome outcome;
    Batch batch;
    std::size_t line = 0;
    for (std::string_view rest = text_; !rest.empty();) {
      batch.parse(cut(rest, Portion::kBatchBytes), text_.data() + text_.size());
      line = batch.check(checker, line, outcome);
    }
    return milliseconds() - begin;
  }

  /// The time on so many processors, ms.
  double simulate(int processors) {
    measure(processors);
    // All look for jumps, each in its part; one executes the first lines.
    const double begin = milliseconds();
    const JumpMap jumps(text_);
    const double start = (milliseconds() - begin) / processors + first_batch_;
    return Processors(steps_, processors).run(start);
  }

  std::size_t executed() const { return executed_; }
  std::size_t taken_over() const { return taken_over_; }

 private:
  /// Measures the steps of all portions. What a portion assumes is the frontier as many portions above it as there are
  /// processors.
  void measure(int processors) {
    steps_.clear();
    executed_ = 0;
    taken_over_ = 0;
    const char* const end = text_.data() + text_.size();
    Checker checker(setup_, jumps_);
    Outcome outcome;
    std::string_view rest = text_;
    double begin = milliseconds();
    Batch first;
    first.parse(cut(rest, Portion::kBatchBytes), end);
    std::size_t line = first.check(checker, 0, outcome);
    first_batch_ = milliseconds() - begin;
    std::vector<Frontier> known(static_cast<std::size_t>(processors), checker.frontier);
    Portion portion;
    for (std::size_t i = 0; !rest.empty(); ++i) {
      const char* const place = rest.data();
      portion.start(cut(rest, Portion::bytes_for(text_.size(), processors)), end);
      const char* const above = text::next_line(place - std::min(Portion::kBytesAbove, place - text_.data()), end);
      Times& times = steps_.emplace_back();
      begin = milliseconds();
      Checker ahead(setup_, jumps_);
      ahead.frontier = known[i % known.size()];
      ahead.frontier.next_jump = jumps_.count_above(static_cast<std::size_t>(above - text_.data()));
      portion.check_ahead(ahead, {above, static_cast<std::size_t>(place - above)});
      times.ahead = milliseconds() - begin;
      begin = milliseconds();
      line = portion.check(checker, line, outcome);
      times.join = milliseconds() - begin;
      executed_ += portion.executed();
      taken_over_ += portion.taken_over();
      known[i % known.size()] = checker.frontier;
    }
  }

  std::string_view text_;
  rules::CheckSetup setup_;
  JumpMap jumps_;
  std::vector<Times> steps_;
  double first_batch_ = 0;
  std::size_t executed_ = 0;
  std::size_t taken_over_ = 0;
};

int run(int argc, char** argv) {
  std::vector<int> processors;
  for (int i = 2; i < argc; ++i) processors.push_back(std::atoi(argv[i]));
  const auto is_wrong = [](int count) { return count < 1 || count > 1024; };
  if (argc < 2 || std::any_of(processors.begin(), processors.end(), is_wrong)) {
    std::fputs("usage: isocnc_schedule FILE [PROCESSORS...]\n", stderr);
    return 2;
  }
  const auto opened = system::SourceFile::open(argv[1], dialect::Language::English);
  if (const auto* const problem = std::get_if<system::SourceFile::Problem>(&opened)) {
    std::fprintf(stderr, "%s: %s\n", argv[1], problem->message.c_str());
    return 2;
  }
  if (processors.empty()) processors = {1, 2, 4, 8, 16, 32};
  Schedule schedule(std::get<system::SourceFile>(opened).text());
  schedule.measure_alone();  // So that the file is in memory.
  for (const int count : processors) {
    const double alone = schedule.measure_alone();
    const double together = schedule.simulate(count);
    std::printf("%d processors: %.1f ms, one %.1f ms: %.2f times as fast; of %zu batches, %zu were executed again\n",
                count, together, alone, alone / together, schedule.executed() + schedule.taken_over(),
                schedule.executed());
  }
  return 0;
}

}  // namespace
}  // namespace isocnc

int main(int argc, char** argv) { return isocnc::run(argc, argv); }
