#include "interpreter/command_line/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace isocnc::command_line {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

/// A terminal and a clock that the test turns.
struct Bench {
  std::vector<std::string> written;
  Progress::Clock::time_point time{};
  Progress progress{[this](std::string_view text) { written.emplace_back(text); }, 200, [this] { return time; }};

  void add(std::uint64_t bytes, milliseconds later) {
    time += later;
    progress.add(bytes);
  }
};

TEST(Progress, SaysNothingOfShortWork) {
  Bench bench;
  bench.add(100, milliseconds(499));
  bench.progress.clear();
  EXPECT_THAT(bench.written, IsEmpty());
}

TEST(Progress, IsDrawnTenTimesASecondAndTakenAway) {
  Bench bench;
  bench.add(50, milliseconds(500));
  bench.add(50, milliseconds(99));
  bench.add(60, milliseconds(1));
  bench.progress.clear();
  bench.progress.clear();
  EXPECT_THAT(bench.written, ElementsAre("\r\x1b[K[#######.......................]  25 %",
                                         "\r\x1b[K[########################......]  80 %", "\r\x1b[K"));
}

/// A file that grows while it is checked.
TEST(Progress, EndsAtAll) {
  Bench bench;
  bench.add(1'000, milliseconds(600));
  EXPECT_THAT(bench.written, ElementsAre("\r\x1b[K[##############################] 100 %"));
}

TEST(Progress, IsSilentWithoutATerminal) {
  Progress progress({}, 100);
  progress.add(100);
  progress.clear();
}

}  // namespace
}  // namespace isocnc::command_line
