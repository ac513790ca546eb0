#include "interpreter/motion/stretch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/motion/programs.h"

namespace isocnc::motion {
namespace {

/// The first moment at which the place is reached: at the one before it, the next smaller double, it is not.
TEST(Stretch, ReachesAPlaceAtOneMoment) {
  for (const kinematics::Machine& machine :
       {uniform_machine(1000, 2000), with_jerk(uniform_machine(1000, 2000), 20000)})
    for (const Stretch& stretch : plan(machine, random_moves(1, 20))) {
      const double from = stretch.phases[0].from;
      const double way = stretch.parameter_at(stretch.start + stretch.duration) - from;
      for (int i = 1; i < 50; ++i) {
        const double s = from + way * i / 50;
        if (!(from < s) || !(s < from + way)) continue;
        const double time = stretch.time_at(s);
        EXPECT_GE(stretch.parameter_at(time), s);
        EXPECT_LT(stretch.parameter_at(std::nextafter(time, 0)), s);
      }
    }
}

}  // namespace
}  // namespace isocnc::motion
