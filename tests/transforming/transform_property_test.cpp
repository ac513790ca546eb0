#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "analyzer/transforming/transform.h"
#include "interpreter/comparison/comparison.h"
#include "interpreter/geometry/frame.h"
#include "interpreter/geometry/helix.h"
#include "tests/support/text_of_file.h"
#include "tests/transforming/random_job.h"

namespace isocnc::transforming {
namespace {

using comparison::MachineAction;
using comparison::RecordedRun;
using geometry::Vec3;
using support::Random;

RecordedRun record(const std::string& program) {
  timing::TimedMachine machine{.motion = kinematics::head_router()};
  for (kinematics::AxisLimits& axis : machine.motion.axes) axis.minimum = -1e6, axis.maximum = 1e6;
  machine.tool_radii = {{execution::tool_code(101001), 3}};
  return comparison::record(program, {}, machine);
}

std::string made(std::string_view program, const Transformation& transformation) {
  const auto result = transform(program, transformation, {}, dialect::Language::English);
  if (const auto* refusal = std::get_if<TransformationRefusal>(&result)) {
    ADD_FAILURE() << refusal->message(dialect::Language::English) << '\n' << program;
    return std::string(program);
  }
  return std::get<std::string>(result);
}

/// What a transformation does with a point in the coordinates of a workpiece frame, in plain arithmetic.
Vec3 moved(const Transformation& how, const Vec3& p) {
  const double angle = how.degrees * std::numbers::pi / 180;
  const Vec3 way = p - how.place;
  switch (how.movement) {
    case Movement::MirrorX:
      return {2 * how.place.x() - p.x(), p.y(), p.z()};
    case Movement::MirrorY:
      return {p.x(), 2 * how.place.y() - p.y(), p.z()};
    case Movement::Rotate:
      return {how.place.x() + std::cos(angle) * way.x() - std::sin(angle) * way.y(),
              how.place.y() + std::sin(angle) * way.x() + std::cos(angle) * way.y(), p.z()};
    case Movement::Shift:
      return p + how.place;
    case Movement::None:
    case Movement::Repeat:
      break;
  }
  return p;
}

/// The middle of a motion, on its path.
Vec3 middle(const RecordedRun& run, const MachineAction& action) {
  if (action.arc == MachineAction::kNone) return (action.from.tip + action.to.tip) / 2;
  const comparison::ActionArc& arc = run.arcs[action.arc];
  if (arc.sweep_deg == 0) return action.from.tip;
  const geometry::Helix helix = geometry::helix(action.from.tip, action.to.tip, arc.center, arc.normal, arc.sweep_deg);
  const double half = helix.sweep / 2;
  return helix.center + std::cos(half) * helix.out + std::sin(half) * helix.side + helix.rise / 2;
}

/// The direction of the tool: that of a face that B and C turn (D28).
Vec3 tool_axis(const geometry::Pose& pose) { return geometry::axes_from_angles(pose.b, pose.c).col(2); }

/// That the machine makes the transformed motions, beside the contour as well, at the scaled feeds. `origin` is that of
/// the program's G92.
void expect_transformed(const std::string& program, const std::string& transformed, const Transformation& how,
                        const Vec3& origin) {
  SCOPED_TRACE(program + "\n---\n" + transformed);
  const RecordedRun before = record(program);
  const RecordedRun after = record(transformed);
  ASSERT_EQ(comparison::error_of(before), "");
  ASSERT_EQ(comparison::error_of(after), "");
  ASSERT_EQ(before.actions.size(), after.actions.size());
  const auto mapped = [&](const Vec3& p) -> Vec3 { return origin + moved(how, p - origin); };
  std::size_t motions = 0;
  for (std::size_t i = 0; i < before.actions.size(); ++i) {
    const MachineAction& a = before.actions[i];
    const MachineAction& b = after.actions[i];
    ASSERT_EQ(a.kind, b.kind);
    ASSERT_EQ(a.line, b.line);
    if (!a.is_motion()) continue;
    ASSERT_EQ(a.is_rapid, b.is_rapid);
    const std::string line = "line " + std::to_string(a.line + 1);
    ASSERT_LT((b.to.tip - mapped(a.to.tip)).norm(), 2e-3) << line;
    if (motions++ == 0) continue;  // It starts at home.
    ASSERT_LT((b.from.tip - mapped(a.from.tip)).norm(), 2e-3) << line;
    if (!a.is_by_joints) {
      ASSERT_LT((middle(after, b) - mapped(middle(before, a))).norm(), 5e-3) << line;
    }
    ASSERT_NEAR(b.feed, a.feed * how.feed_factor, 1e-6 * a.feed + 3e-3) << line;
    const Vec3 turned = moved(how, tool_axis(a.to)) - moved(how, Vec3::Zero());
    ASSERT_LT((tool_axis(b.to) - turned).norm(), 1e-6) << line;
    const bool is_mirror = how.movement == Movement::MirrorX || how.movement == Movement::MirrorY;
    if (a.has_side && a.side != 0) {
      ASSERT_EQ(b.side, is_mirror ? 83 - a.side : a.side) << line;
    }
  }
}

const std::vector<std::pair<Transformation, Transformation>>& pairs() {
  static const std::vector<std::pair<Transformation, Transformation>> all = {
      {{Movement::MirrorX, {400, 0, 0}}, {Movement::MirrorX, {400, 0, 0}}},
      {{Movement::MirrorY, {0, -12.25, 0}}, {Movement::MirrorY, {0, -12.25, 0}}},
      {{Movement::Shift, {100.5, -50, 3}}, {Movement::Shift, {-100.5, 50, -3}}},
      {{Movement::Rotate, {10, 20, 0}, 90}, {Movement::Rotate, {10, 20, 0}, -90}},
      {{Movement::Rotate, {400, 250, 0}, 33.3}, {Movement::Rotate, {400, 250, 0}, -33.3}},
      {{Movement::Rotate, {0, 0, 0}, 180}, {Movement::Rotate, {0, 0, 0}, -180}},
      {{.feed_factor = 0.5}, {.feed_factor = 2}},
  };
  return all;
}

bool turns_planes(const Transformation& how) {
  return how.movement == Movement::Rotate && std::fmod(how.degrees, 180) != 0;
}

TEST(TransformProperty, RandomJobsMoveAsTheyMust) {
  for (const std::uint64_t seed : support::seeds(60)) {
    for (const auto& [how, back] : pairs()) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", movement " << static_cast<int>(how.movement) << ' '
                                      << how.degrees);
      Random random(seed);
      RandomJob job(random);
      job.has_planes = !turns_planes(how);
      const std::string program = job.text(40);
      const Vec3 origin = program.find("G92") == std::string::npos ? Vec3(0, 0, 0) : Vec3(500, -120.5, -80);
      const std::string transformed = made(program, how);
      expect_transformed(program, transformed, how, origin);
      const std::string again = made(transformed, back);
      Transformation nothing;
      expect_transformed(program, again, nothing, origin);
      if (HasFailure()) return;
    }
  }
}

/// The feed moves of all copies: those of the program, each as far away as its copy.
TEST(TransformProperty, RandomJobsAreRepeatedAtEachPlaceOfTheGrid) {
  for (const std::uint64_t seed : support::seeds(60)) {
    Random random(seed);
    std::string program = RandomJob(random).text(40);
    // To the next part the machine goes at the height at which the program ends.
    program.insert(program.rfind("M05"), "G00 Z500 B0 C0\n");
    const Transformation how{.movement = Movement::Repeat, .place = {120.5, -80, 0}, .columns = 3, .rows = 2};
    const std::string repeated = made(program, how);
    SCOPED_TRACE(testing::Message() << "seed " << seed << "\n" << repeated);
    const RecordedRun once = record(program);
    const RecordedRun all = record(repeated);
    ASSERT_EQ(comparison::error_of(all), "");
    const auto feed_ends = [](const RecordedRun& run) {
      std::vector<Vec3> ends;
      for (const MachineAction& action : run.actions)
        if (action.is_motion() && !action.is_rapid) ends.push_back(action.to.tip);
      return ends;
    };
    const std::vector<Vec3> ends = feed_ends(once);
    const std::vector<Vec3> all_ends = feed_ends(all);
    ASSERT_EQ(all_ends.size(), 6 * ends.size());
    for (std::size_t i = 0; i < all_ends.size(); ++i) {
      const std::size_t copy = i / ends.size();
      const Vec3 away(120.5 * static_cast<double>(copy % 3), copy < 3 ? 0 : -80, 0);
      ASSERT_LT((all_ends[i] - ends[i % ends.size()] - away).norm(), 2e-3) << "copy " << copy;
    }
  }
}

TEST(TransformProperty, MirroredTwiceAndShiftedBackInMillimetersIsTheSameText) {
  for (const std::uint64_t seed : support::seeds(100)) {
    Random random(seed);
    const std::string program = RandomJob(random).text(40);
    const auto has = [&](std::string_view g) { return program.find(g) != std::string::npos; };
    if (has("G70") || has("G24") || has("G29")) continue;  // Faces get words that they need not have had.
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [how, back] = pairs()[i];
      const std::string again = made(made(program, how), back);
      EXPECT_EQ(again, program) << "seed " << seed;
    }
  }
}

TEST(TransformProperty, ExamplesMoveAsTheyMustOrAreRefused) {
  int done = 0;
  for (const char* folder : {"/examples", "/examples/setups", "/examples/machine"})
    for (const auto& entry : std::filesystem::directory_iterator(std::string(ISOCNC_SOURCE_DIR) + folder)) {
      if (entry.path().extension() != ".iso") continue;
      const std::string program = text_of_file(entry.path());
      for (const auto& [how, back] : pairs()) {
        const auto result = transform(program, how, {}, dialect::Language::English);
        if (const auto* refusal = std::get_if<TransformationRefusal>(&result)) {
          EXPECT_EQ(refusal->obstacle, TransformObstacle::PlaneRotated) << entry.path();
          EXPECT_TRUE(turns_planes(how)) << entry.path();
          continue;
        }
        ++done;
        const std::string again = made(std::get<std::string>(result), back);
        EXPECT_EQ(comparison::compare(record(program), record(again), {.tolerance = 0.002}).size(), 0u)
            << entry.path() << ' ' << static_cast<int>(how.movement);
      }
    }
  EXPECT_GT(done, 60);
}

}  // namespace
}  // namespace isocnc::transforming
