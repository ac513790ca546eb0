#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "interpreter/kinematics/travel.h"
#include "interpreter/running/runner.h"
#include "interpreter/summary/summary.h"
#include "interpreter/timing/timing.h"
#include "tests/support/random.h"

/// Properties of simulated runs of whole programs: motions reach their ends, durations add up, and no joint or feed
/// exceeds its limits.
namespace isocnc::simulation {
namespace {

using motion::Sample;
using motion::Stretch;
using support::Random;
using support::seeds;

constexpr double kRelative = 1 + 1e-6;

/// Writes valid programs with everything that moves or stops a machine.
class RandomTrip {
 public:
  explicit RandomTrip(Random& random) : random_(random) {}

  std::string text() {
    add("M06 T101001");
    add("F4000");
    for (int i = 0; i < 40; ++i) step();
    add("M02");
    return std::move(text_);
  }

 private:
  void add(std::string_view line) { text_.append(line).append("\n"); }
  double number(double size) { return size * random_.between(-1000, 1000) / 1000; }
  std::string place() { return fmt::format("X{:.3f} Y{:.3f}", number(90), number(90)); }
  std::string turn() { return fmt::format(" B{:.2f} C{:.2f}", number(100), number(170)); }
  std::string feed() {
    if (inverse_) return fmt::format(" F{}", random_.between(5, 400));
    return random_.one_in(2) ? fmt::format(" F{}", random_.between(100, 9000)) : "";
  }
  std::string stop() { return random_.one_in(6) ? " G09" : ""; }
  void cut(const std::string& move) { add(move + feed() + stop()); }

  void step() {
    switch (random_.between(0, 13)) {
      case 0:
        return add("G00 " + place() + (random_.one_in(2) ? fmt::format(" Z{:.3f}", number(50)) : ""));
      case 1:
        return add("G00 " + (random_.one_in(2) ? place() : "") + turn());
      case 2:
      case 3:
        return cut("G01 " + place() + (random_.one_in(2) ? fmt::format(" Z{:.3f}", number(20)) : ""));
      case 4:
      case 5:
        return cut(fmt::format("G0{} {} R{}{}", random_.between(2, 3), place(), random_.between(140, 600),
                               random_.one_in(3) ? fmt::format(" Z{:.3f}", number(20)) : ""));
      case 6:
        five_axis_ = !five_axis_;
        return add(five_axis_ ? "G49" : "G48");
      case 7:
        return five_axis_ ? cut("G01 " + (random_.one_in(3) ? "" : place()) + turn()) : small_steps();
      case 8:
        if (five_axis_) cut(fmt::format("G02 {} R200 B{:.2f}", place(), number(100)));
        return;
      case 9:
        return add(random_.any_of({"G04 P0.25", "G990", "M05", "IF V1 = 1 GOTO N9"}));
      case 10:
        return add(fmt::format("M06 T10100{}", random_.between(1, 3)));
      case 11:
        inverse_ = !inverse_;
        return add(inverse_ ? "G93" : "G94");
      case 12:
        has_face_ = !has_face_;
        add(has_face_ ? fmt::format("G29 {} B{} C{}", place(), random_.between(0, 90), random_.between(0, 90)) : "G27");
        return add("G00 " + place() + " Z40");
      default:
        return small_steps();
    }
  }

  void small_steps() {
    add("G91");
    for (int i = random_.between(1, 15); i > 0; --i)
      cut(fmt::format("G01 X{:.3f} Y{:.3f}", 0.002 + number(2), number(0.5)));
    add("G90");
  }

  Random& random_;
  bool five_axis_ = false;
  bool inverse_ = false;
  bool has_face_ = false;
  std::string text_;
};

struct TimedTrip {
  std::uint64_t seed = 0;
  std::string program;
  std::vector<timing::TimedEvent> motions;  ///< The motions, indexed by the tags of the stretches.
  std::vector<Stretch> stretches;
  double reported_seconds = 0;  ///< The sum of all events' durations in seconds.
  double seconds = 0;
  geometry::Pose tip;
};

TimedTrip trip_of(std::string_view program, const timing::TimedMachine& machine) {
  TimedTrip trip;
  timing::Timing timing(machine, {.event =
                                      [&](const timing::TimedEvent& timed) {
                                        trip.reported_seconds += timed.duration + timed.wait;
                                        if (timed.move) trip.motions.push_back(timed);
                                      },
                                  .stretch =
                                      [&](const Stretch& stretch, const timing::TimedEvent&) {
                                        trip.stretches.push_back(stretch);
                                        trip.stretches.back().tag = trip.motions.size();
                                      }});
  running::RunOptions options;
  options.setup.home = machine.home;
  const running::RunResult result = run(program, options, [&](const running::Event& event) { timing.take(event); });
  EXPECT_EQ(result.line_text, "M02") << dialect::definition(result.error.id).code;
  timing.finish();
  trip.seconds = timing.time();
  trip.tip = timing.tip();
  return trip;
}

class Trips : public testing::TestWithParam<kinematics::MachineKind> {
 protected:
  static timing::TimedMachine machine() {
    timing::TimedMachine machine{.motion = kinematics::head_router()};
    if (GetParam() == kinematics::MachineKind::ThreeAxis) machine.motion = kinematics::three_axis_router();
    if (GetParam() == kinematics::MachineKind::Table) machine.motion = kinematics::table_router();
    machine.motion.axes[kinematics::kB].speed = machine.motion.axes[kinematics::kC].speed = 100;
    machine.motion.axes[kinematics::kB].acceleration = machine.motion.axes[kinematics::kC].acceleration = 700;
    machine.motion.feed_speed = 100;
    machine.motion.feed_turn = 40;
    machine.tool_lengths = {{{1, 1, 2}, 80}, {{1, 1, 3}, 150}};
    machine.home = {{20, -30, 400}, 5, -10};
    return machine;
  }

  template <typename Check>
  static void for_trips(Check&& check) {
    const timing::TimedMachine machine = Trips::machine();
    for (const TimedTrip& trip : trips(machine)) {
      SCOPED_TRACE(fmt::format("seed {}\n{}", trip.seed, trip.program));
      check(machine, trip);
      if (HasFailure()) return;
    }
  }

  /// The trips, planned once for all properties.
  static const std::vector<TimedTrip>& trips(const timing::TimedMachine& machine) {
    static std::map<kinematics::MachineKind, std::vector<TimedTrip>> kept;
    std::vector<TimedTrip>& all = kept[GetParam()];
    if (all.empty()) {
      for (const std::uint64_t seed : seeds(6)) {
        Random random(seed);
        std::string program = RandomTrip(random).text();
        all.push_back(trip_of(program, machine));
        all.back().seed = seed;
        all.back().program = std::move(program);
      }
    }
    return all;
  }

  /// Calls `check` with samples at both ends of each phase of a stretch and between, and with their weights of
  /// Simpson's rule in seconds.
  template <typename Check>
  static void for_samples(const timing::TimedMachine& machine, const Stretch& stretch, Check&& check, int parts = 8) {
    double start = stretch.start;
    for (int phase = 0; phase < stretch.phase_count; ++phase) {
      const double duration = stretch.phases[static_cast<std::size_t>(phase)].duration;
      for (int i = 0; i <= parts; ++i)
        check(stretch.at(machine.motion.kinematics,
                         start + duration * std::clamp(static_cast<double>(i) / parts, 1e-9, 1 - 1e-9)),
              duration / (3 * parts) *
                  (i == 0 || i == parts ? 1
                   : i % 2 == 1         ? 4
                                        : 2));
      start += duration;
    }
  }
};

TEST_P(Trips, KeepWithinSpeedsAndAccelerations) {
  double fullest = 0;
  for_trips([&](const timing::TimedMachine& machine, const TimedTrip& trip) {
    for (const Stretch& stretch : trip.stretches)
      for_samples(machine, stretch, [&](const Sample& sample, double) {
        for (int axis = 0; axis < kinematics::kAxisCount; ++axis) {
          const kinematics::AxisLimits& limits = machine.motion.axes[static_cast<std::size_t>(axis)];
          ASSERT_LE(std::abs(sample.joint_speeds[axis]), limits.speed * kRelative) << stretch.tag;
          ASSERT_LE(std::abs(sample.joint_accelerations[axis]), limits.acceleration * kRelative) << stretch.tag;
          fullest = std::max(fullest, std::abs(sample.joint_accelerations[axis]) / limits.acceleration);
        }
      });
  });
  EXPECT_GT(fullest, 0.999) << "the limits are not used";
}

TEST_P(Trips, KeepToTheFeedAndToWhatFeedMovesMay) {
  for_trips([](const timing::TimedMachine& machine, const TimedTrip& trip) {
    for (const Stretch& stretch : trip.stretches) {
      const kinematics::Move& move = *trip.motions[stretch.tag].move;
      if (move.feed.kind == kinematics::FeedKind::Rapid) continue;
      const bool only_turns = !move.is_arc && (move.to.tip - move.from.tip).norm() < 1e-9;
      for_samples(machine, stretch, [&](const Sample& sample, double) {
        const double speed = only_turns ? sample.joint_speeds.tail<2>().norm() : sample.speed;
        if (move.feed.kind == kinematics::FeedKind::Speed) {
          ASSERT_LE(speed, move.feed.value * kRelative + 1e-9) << stretch.tag;
        }
        if (!only_turns) {
          ASSERT_LE(sample.speed, machine.motion.feed_speed * kRelative) << stretch.tag;
        }
        ASSERT_LE(sample.joint_speeds.tail<2>().cwiseAbs().maxCoeff(), machine.motion.feed_turn * kRelative)
            << stretch.tag;
      });
    }
  });
}

/// The integral of the speed over time is the length of the path, less what rounded corners and the chords of arcs cut
/// off.
TEST_P(Trips, CoverTheirWholePath) {
  for_trips([](const timing::TimedMachine& machine, const TimedTrip& trip) {
    const auto swings = [](const kinematics::Move& move) {
      return !move.controls_tool_point && (move.from.b != move.to.b || move.from.c != move.to.c);
    };
    std::vector<double> ways(trip.motions.size());
    for (const Stretch& stretch : trip.stretches)
      for_samples(
          machine, stretch, [&](const Sample& sample, double weight) { ways[stretch.tag] += weight * sample.speed; },
          swings(*trip.motions[stretch.tag].move) ? 200 : 8);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const kinematics::Move& move = *trip.motions[i].move;
      const double length = kinematics::tip_travel(machine.motion, move).length;
      const double part = swings(move) || move.splits_arcs ? 2e-3 : 1e-6;
      ASSERT_NEAR(ways[i], length, 8 * machine.motion.corner_tolerance + part * length) << "motion " << i;
      const auto& programmed = std::get<running::MoveEvent>(trip.motions[i].event.what);
      const bool is_as_programmed = (move.from.tip - programmed.from.tip).norm() < 1e-9;
      if (is_as_programmed && !swings(move)) {
        ASSERT_NEAR(length, programmed.length, 1e-2) << "motion " << i;
      }
    }
  });
}

/// The length of the tip's path if each joint moves linearly to its end, as a sum of chords.
double swung_length(const timing::TimedMachine& machine, const kinematics::Move& move) {
  constexpr int kChords = 4000;
  const kinematics::Kinematics& kinematics = machine.motion.kinematics;
  const kinematics::Coordinates from = inverse(kinematics, kinematics::coordinates(move.from), move.tool_length);
  const kinematics::Coordinates way = inverse(kinematics, kinematics::coordinates(move.to), move.tool_length) - from;
  double sum = 0;
  geometry::Vec3 before = move.from.tip;
  for (int i = 1; i <= kChords; ++i) {
    const kinematics::Coordinates joints = from + static_cast<double>(i) / kChords * way;
    const geometry::Vec3 tip = forward(kinematics, joints, move.tool_length).head<3>();
    sum += (tip - before).norm();
    before = tip;
  }
  return sum;
}

/// docs/isorun.md: `lengthMm` is the length of the tip's path, and the summary has the sum.
TEST_P(Trips, TraceTheLengthsOfTheSummary) {
  for_trips([](const timing::TimedMachine& machine, const TimedTrip& trip) {
    summary::Summary summary(machine);
    std::map<std::string, double> sums;
    for (const timing::TimedEvent& timed : trip.motions) {
      summary.add(timed);
      const auto line = nlohmann::json::parse(to_json(timed, machine));
      const double length = line.at("lengthMm");
      sums[line.at("kind")] += length;
      const kinematics::Move& move = *timed.move;
      if (move.is_arc) continue;
      const double expected =
          move.controls_tool_point ? (move.to.tip - move.from.tip).norm() : swung_length(machine, move);
      ASSERT_NEAR(length, expected, 1e-9 + 1e-4 * expected) << line.dump();
    }
    summary.finish({}, trip.seconds, kinematics::Coordinates::Zero(), {});
    const auto total = nlohmann::json::parse(summary.json("", dialect::Language::English));
    for (const auto& [kind, kinds] : {std::pair("rapid", "rapids"), {"feed", "feeds"}, {"arc", "arcs"}})
      ASSERT_NEAR(sums[kind], total.at(kinds).at("lengthMm").get<double>(), 1e-6) << kind;
  });
}

TEST_P(Trips, TakeTheTimesThatAreReported) {
  for_trips([](const timing::TimedMachine& machine, const TimedTrip& trip) {
    ASSERT_NEAR(trip.reported_seconds, trip.seconds, 1e-9 * trip.seconds);
    std::vector<double> times(trip.motions.size());
    for (const Stretch& stretch : trip.stretches) times[stretch.tag] += stretch.duration;
    for (std::size_t i = 0; i < times.size(); ++i)
      ASSERT_NEAR(times[i], trip.motions[i].duration, 1e-9 * trip.seconds) << "motion " << i;
    ASSERT_FALSE(trip.stretches.empty());
    const Stretch& last = trip.stretches.back();
    const geometry::Pose end = last.at(machine.motion.kinematics, last.start + last.duration).tip;
    ASSERT_LT((kinematics::coordinates(end) - kinematics::coordinates(trip.motions.back().move->to)).norm(), 1e-6);
  });
}

/// Positions and speeds have no jumps; only a tool change moves the tip, while the joints stand still.
TEST_P(Trips, NeverJump) {
  for_trips([](const timing::TimedMachine& machine, const TimedTrip& trip) {
    for (std::size_t i = 1; i < trip.stretches.size(); ++i) {
      const Stretch& before = trip.stretches[i - 1];
      const Sample end = before.at(machine.motion.kinematics, before.start + before.duration);
      const Sample begin = trip.stretches[i].at(machine.motion.kinematics, trip.stretches[i].start);
      ASSERT_LT((end.joints - begin.joints).cwiseAbs().maxCoeff(), 1e-6) << trip.stretches[i].tag;
      ASSERT_LT((end.joint_speeds - begin.joint_speeds).cwiseAbs().maxCoeff(), 1e-4) << trip.stretches[i].tag;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Machines, Trips,
                         testing::Values(kinematics::MachineKind::ThreeAxis, kinematics::MachineKind::Head,
                                         kinematics::MachineKind::Table));

}  // namespace
}  // namespace isocnc::simulation
