#include <gtest/gtest.h>

#include "interpreter/system/process.h"

#ifdef __linux__
#include <sched.h>

namespace isocnc::system {
namespace {

/// A program that `taskset` leaves one processor starts no threads for others.
TEST(ProcessorCount, IsOfThoseThatTheProcessMayUse) {
  cpu_set_t before;
  ASSERT_EQ(::sched_getaffinity(0, sizeof before, &before), 0);
  EXPECT_EQ(processor_count(), CPU_COUNT(&before));
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(processor_count(), 1);
  ASSERT_EQ(::sched_setaffinity(0, sizeof before, &before), 0);
}

}  // namespace
}  // namespace isocnc::system
#endif
