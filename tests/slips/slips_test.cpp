#include <gtest/gtest.h>

#include <algorithm>

#include "hunt.h"

namespace isocnc::slips {
namespace {

TEST(Slips, RarelyGiveSeveralFindings) {
  Hunt hunt;
  for (const std::uint64_t seed : support::seeds(1600)) hunt.make(seed);
  EXPECT_LE(hunt.share(), kMaxShare);
}

/// A seed gives the same slip each time, so that a failure can be shown again.
TEST(Slips, AreMadeFromTheirSeed) {
  Hunt one;
  Hunt another;
  another.make(1);
  for (const std::uint64_t seed : {7u, 8u}) EXPECT_EQ(shown(one.make(seed)), shown(another.make(seed)));
}

TEST(Slips, AreOfEveryKind) {
  Hunt hunt;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) hunt.make(seed);
  for (const SlipKind& kind : slip_kinds()) EXPECT_TRUE(hunt.kinds().contains(std::string(kind.name))) << kind.name;
}

TEST(Slips, AreMadeInProgramsOfEverySource) {
  for (const ProgramSource& source : correct_programs()) EXPECT_GE(source.programs.size(), 10U) << source.name;
}

}  // namespace
}  // namespace isocnc::slips
