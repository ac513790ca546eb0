#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/motion/programs.h"
#include "tests/support/random.h"

namespace isocnc::motion {
namespace {

using geometry::Vec3;

constexpr double kRelative = 1 + 1e-6;

struct Case {
  std::string name;
  kinematics::Machine machine;
};

class RandomMoves : public testing::TestWithParam<Case> {
 protected:
  const kinematics::Machine& machine() const { return GetParam().machine; }
  bool limits_jerk() const { return machine().axes[kinematics::kX].jerk.has_value(); }

  /// Calls `check(moves, stretches)` for many programs.
  template <typename Check>
  void for_programs(Check&& check) const {
    for (const std::uint64_t seed : support::seeds(limits_jerk() ? 12 : 25)) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const std::vector<kinematics::Move> moves = random_moves(seed, 40);
      check(moves, plan(machine(), moves));
      if (HasFailure()) return;
    }
  }

  template <typename Check>
  static void for_samples(const kinematics::Kinematics& kinematics, const Stretch& stretch, Check&& check) {
    constexpr int kParts = 12;
    for (int i = 0; i <= kParts; ++i) check(stretch.at(kinematics, stretch.start + stretch.duration * i / kParts));
    double start = stretch.start;
    for (int i = 0; i < stretch.phase_count; ++i) {
      const double duration = stretch.phases[static_cast<std::size_t>(i)].duration;
      check(stretch.at(kinematics, start + 1e-9 * duration));
      check(stretch.at(kinematics, start + (1 - 1e-9) * duration));
      start += duration;
    }
  }
};

TEST_P(RandomMoves, KeepTheLimitsOfTheAxes) {
  double fullest = 0;
  for_programs([&](const std::vector<kinematics::Move>&, const std::vector<Stretch>& stretches) {
    for (const Stretch& stretch : stretches) {
      for_samples(machine().kinematics, stretch, [&](const Sample& sample) {
        for (int axis = 0; axis < kinematics::kAxisCount; ++axis) {
          const kinematics::AxisLimits& limits = machine().axes[static_cast<std::size_t>(axis)];
          ASSERT_LE(std::abs(sample.joint_speeds[axis]), limits.speed * kRelative) << axis << " move " << stretch.tag;
          ASSERT_LE(std::abs(sample.joint_accelerations[axis]), limits.acceleration * kRelative)
              << axis << " move " << stretch.tag;
          fullest = std::max(fullest, std::abs(sample.joint_accelerations[axis]) / limits.acceleration);
        }
      });
    }
  });
  if (support::kTriesAll) {
    EXPECT_GT(fullest, limits_jerk() ? 0.99 : 0.999999) << "the limits are not used";
  }
}

/// The jerk as the change of the acceleration, within phases and from each stretch to the next.
TEST_P(RandomMoves, KeepTheJerk) {
  if (!limits_jerk()) return;
  constexpr int kParts = 8;
  double fullest = 0;
  for_programs([&](const std::vector<kinematics::Move>&, const std::vector<Stretch>& stretches) {
    Sample before;
    for (const Stretch& stretch : stretches) {
      double start = stretch.start;
      const auto check = [&](const Sample& sample, double duration) {
        for (int axis = 0; axis < kinematics::kAxisCount; ++axis) {
          const double maximum = *machine().axes[static_cast<std::size_t>(axis)].jerk;
          const double change = std::abs(sample.joint_accelerations[axis] - before.joint_accelerations[axis]);
          ASSERT_LE(change, maximum * kRelative * duration + 1e-6) << axis << " move " << stretch.tag;
          if (duration > 1e-4) fullest = std::max(fullest, change / duration / maximum);
        }
        before = sample;
      };
      check(stretch.at(machine().kinematics, start), 0);
      for (int i = 0; i < stretch.phase_count; ++i) {
        const double duration = stretch.phases[static_cast<std::size_t>(i)].duration;
        for (int part = 1; part <= kParts; ++part)
          check(stretch.at(machine().kinematics, start + duration * part / kParts), duration / kParts);
        start += duration;
      }
    }
    ASSERT_LT(before.joint_accelerations.norm(), 1e-3) << "in the end";
  });
  if (support::kTriesAll) {
    EXPECT_GT(fullest, 0.9999) << "the limits are not used";
  }
}

TEST_P(RandomMoves, KeepTheFeed) {
  for_programs([&](const std::vector<kinematics::Move>& moves, const std::vector<Stretch>& stretches) {
    for (const Stretch& stretch : stretches) {
      const kinematics::Move& move = moves[stretch.tag];
      if (move.feed.kind != kinematics::FeedKind::Speed) continue;
      const bool only_turns = move.from.tip == move.to.tip && !move.is_arc;
      for_samples(machine().kinematics, stretch, [&](const Sample& sample) {
        const double speed = only_turns ? sample.joint_speeds.tail<2>().norm() : sample.speed;
        ASSERT_LE(speed, move.feed.value * kRelative + 1e-9) << "move " << stretch.tag;
      });
    }
  });
}

TEST_P(RandomMoves, GoOnWhereTheyWereAsFast) {
  for_programs([&](const std::vector<kinematics::Move>&, const std::vector<Stretch>& stretches) {
    for (std::size_t i = 1; i < stretches.size(); ++i) {
      const Stretch& before = stretches[i - 1];
      const double time = stretches[i].start;
      ASSERT_NEAR(before.start + before.duration, time, 1e-9);
      const Sample end = before.at(machine().kinematics, time);
      const Sample begin = stretches[i].at(machine().kinematics, time);
      ASSERT_LT((end.joints - begin.joints).cwiseAbs().maxCoeff(), 1e-7) << "move " << before.tag;
      ASSERT_LT((kinematics::coordinates(end.tip) - kinematics::coordinates(begin.tip)).cwiseAbs().maxCoeff(), 1e-7)
          << "move " << before.tag;
      ASSERT_LT((end.joint_speeds - begin.joint_speeds).cwiseAbs().maxCoeff(), 1e-5) << "move " << before.tag;
    }
  });
}

/// Speeds are the slopes of places, and accelerations those of speeds.
TEST_P(RandomMoves, SamplesIntegrate) {
  for_programs([&](const std::vector<kinematics::Move>&, const std::vector<Stretch>& stretches) {
    for (const Stretch& stretch : stretches) {
      double start = stretch.start;
      for (int i = 0; i < stretch.phase_count; ++i) {
        const double duration = stretch.phases[static_cast<std::size_t>(i)].duration;
        const double half = std::min(1e-5, duration / 100);
        const double middle = start + duration / 2;
        start += duration;
        if (half < 2e-7) continue;
        const Sample a = stretch.at(machine().kinematics, middle - half);
        const Sample b = stretch.at(machine().kinematics, middle);
        const Sample c = stretch.at(machine().kinematics, middle + half);
        const kinematics::Coordinates speeds = (c.joints - a.joints) / (2 * half);
        const kinematics::Coordinates accelerations = (c.joint_speeds - a.joint_speeds) / (2 * half);
        ASSERT_LT((speeds - b.joint_speeds).norm(), 1e-4 * (1 + b.joint_speeds.norm())) << stretch.tag;
        ASSERT_LT((accelerations - b.joint_accelerations).norm(), 1e-3 * (1 + b.joint_accelerations.norm()))
            << stretch.tag;
        ASSERT_NEAR((c.speed - a.speed) / (2 * half), b.acceleration, 1e-3 * (1 + b.joint_accelerations.norm()));
        ASSERT_NEAR((c.tip.tip - a.tip.tip).norm() / (2 * half), b.speed, 1e-4 * (1 + b.joint_speeds.norm()));
      }
    }
  });
}

/// The move of the stretch is asked first: mostly it is the nearest.
double off_path(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves, std::size_t tag,
                const Vec3& tip) {
  double off = distance(machine, moves[tag], tip);
  if (off < 1e-6) return off;
  if (tag > 0) off = std::min(off, distance(machine, moves[tag - 1], tip));
  if (tag + 1 < moves.size()) off = std::min(off, distance(machine, moves[tag + 1], tip));
  return off;
}

double allowed(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves, std::size_t tag) {
  const bool has_chords = moves[tag].splits_arcs || (tag > 0 && moves[tag - 1].splits_arcs) ||
                          (tag + 1 < moves.size() && moves[tag + 1].splits_arcs);
  return (machine.corner_tolerance + (has_chords ? machine.chord_tolerance : 0)) * kRelative + 1e-7;
}

TEST_P(RandomMoves, StayWithinTheCornerTolerance) {
  double farthest = 0;
  for_programs([&](const std::vector<kinematics::Move>& moves, const std::vector<Stretch>& stretches) {
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const Stretch& stretch = stretches[i];
      if (i % 5 != 0 && stretch.path.kind == kinematics::PathKind::Circle) continue;  // Many, and slow to compare.
      for (const double part : {0.0, 0.5, 0.8, 1.0}) {
        const Sample sample = stretch.at(machine().kinematics, stretch.start + part * stretch.duration);
        const double off = off_path(machine(), moves, stretch.tag, sample.tip.tip);
        ASSERT_LE(off, allowed(machine(), moves, stretch.tag)) << "move " << stretch.tag;
        farthest = std::max(farthest, off);
      }
    }
  });
  if (support::kTriesAll) {
    EXPECT_GT(farthest, machine().corner_tolerance * 0.9) << "the tolerance is not used";
  }
}

TEST_P(RandomMoves, HaveTheirStretchesInOrderAndEndWhereProgrammed) {
  for_programs([&](const std::vector<kinematics::Move>& moves, const std::vector<Stretch>& stretches) {
    std::size_t ended = 0;
    for (const Stretch& stretch : stretches) {
      ASSERT_EQ(stretch.tag, ended);
      if (!stretch.ends_move) continue;
      ++ended;
      const Sample end = stretch.at(machine().kinematics, stretch.start + stretch.duration);
      const kinematics::Move& move = moves[stretch.tag];
      const bool stops = move.exact_stop || ended == moves.size();
      ASSERT_LE((end.tip.tip - move.to.tip).norm(), stops ? 1e-7 : machine().corner_tolerance * kRelative)
          << stretch.tag;
      ASSERT_NEAR(end.tip.b, move.to.b, stops ? 1e-7 : machine().corner_tolerance_deg * kRelative);
      ASSERT_NEAR(end.tip.c, move.to.c, stops ? 1e-7 : machine().corner_tolerance_deg * kRelative);
      if (stops) {
        ASSERT_LT(end.joint_speeds.norm(), 1e-4);
      }
    }
    ASSERT_EQ(ended, moves.size());
  });
}

std::vector<kinematics::Move> way_back(const std::vector<kinematics::Move>& moves) {
  std::vector<kinematics::Move> back(moves.rbegin(), moves.rend());
  for (std::size_t i = 0; i < back.size(); ++i) {
    std::swap(back[i].from, back[i].to);
    back[i].sweep_deg = -back[i].sweep_deg;
    back[i].exact_stop = i + 1 < back.size() && back[i + 1].exact_stop;  // Where the move before had stopped.
    back[i].tag = i;
  }
  return back;
}

/// All limits hold in both directions. Arcs are planned in pieces, which lets the ways differ a little.
TEST_P(RandomMoves, TakeAsLongOnTheWayBack) {
  if (limits_jerk()) return;  // The first moves decide how all are smoothed.
  for_programs([&](const std::vector<kinematics::Move>& moves, const std::vector<Stretch>& stretches) {
    const double there = cycle_time(stretches);
    ASSERT_NEAR(cycle_time(plan(machine(), way_back(moves))), there, 5e-4 * there);
  });
}

INSTANTIATE_TEST_SUITE_P(
    Machines, RandomMoves,
    testing::Values(Case{"ThreeAxis", kinematics::three_axis_router()}, Case{"Head", kinematics::head_router()},
                    Case{"Table", kinematics::table_router()},
                    Case{"JerkLimitedThreeAxis", with_jerk(kinematics::three_axis_router(), 30000)},
                    Case{"JerkLimitedHead", with_jerk(kinematics::head_router(), 60000)},
                    Case{"JerkLimitedTable", with_jerk(kinematics::table_router(), 20000)}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace isocnc::motion
