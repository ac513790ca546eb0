#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "interpreter/threads/crew.h"

namespace isocnc::threads {
namespace {

/// Counts the numbers below `count` that are taken, on all threads that come.
std::function<void()> counting(std::atomic<int>& next, std::vector<std::atomic<int>>& taken) {
  return [&] {
    for (int i = next++; i < static_cast<int>(taken.size()); i = next++) ++taken[static_cast<std::size_t>(i)];
  };
}

TEST(Crew, EachPartOfATaskIsDoneOnce) {
  for (const int size : {1, 2, 4}) {
    Crew crew(size);
    EXPECT_EQ(crew.has_helpers(), size > 1);
    for (int round = 0; round < 200; ++round) {
      std::vector<std::atomic<int>> taken(50);
      std::atomic<int> next = 0;
      bool has_ended = false;
      crew.start([&] {
        crew.together(counting(next, taken));
        has_ended = true;
      });
      crew.wait();
      EXPECT_TRUE(has_ended);
      for (const std::atomic<int>& each : taken) EXPECT_EQ(each, 1);
    }
  }
}

TEST(Crew, TasksAreDoneInTheirOrder) {
  std::vector<int> done;
  Crew crew(3);
  for (int i = 0; i < 500; ++i) crew.start([&done, i] { done.push_back(i); });
  crew.wait();
  ASSERT_EQ(done.size(), 500u);
  for (int i = 0; i < 500; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
}

/// Ends once two threads take part.
void meet(Crew& crew, std::atomic<int>& present) {
  crew.together([&] {
    ++present;
    while (present < 2) std::this_thread::yield();
  });
}

/// Whoever waits takes part: the first thread goes on only when the second one
/// has come.
TEST(Crew, WhoWaitsHelps) {
  Crew crew(2);
  std::atomic<int> present = 0;
  crew.start([&] { meet(crew, present); });
  crew.wait();
  EXPECT_EQ(present, 2);
}

/// Who gives tasks faster than they are done takes part as well, before there
/// are too many.
TEST(Crew, WhoGivesManyTasksHelps) {
  Crew crew(2);
  std::atomic<int> present = 0;
  crew.start([&] { meet(crew, present); });
  for (int i = 0; i < 40; ++i) crew.start([] {});
  EXPECT_EQ(present, 2);
  crew.wait();
}

TEST(Crew, WorksWithoutATask) {
  Crew crew(3);
  std::vector<std::atomic<int>> taken(1000);
  std::atomic<int> next = 0;
  crew.together(counting(next, taken));
  for (const std::atomic<int>& each : taken) EXPECT_EQ(each, 1);
}

TEST(Crew, ATaskThatIsGivenIsDoneBeforeTheCrewEnds) {
  bool is_done = false;
  {
    Crew crew(2);
    crew.start([&] { is_done = true; });
  }
  EXPECT_TRUE(is_done);
}

}  // namespace
}  // namespace isocnc::threads
