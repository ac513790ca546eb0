#include "interpreter/solids/tool_shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "scenes.h"

namespace isocnc::solids {
namespace {

using Fault = ShapeProblem::Kind;
using scenes::body;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The distance of a body that stands upright at the origin from a point, given as a tiny box.
double distance_to(const RevolvedBody& of, double x, double z) {
  const geometry::Vec3 point(x, 0, z);
  return clearance(of, {}, Cuboid{point, point}).lower + kRounding;
}

TEST(ToolShapes, FlatToolIsACylinder) {
  const RevolvedBody tool = body(flat_body(10, 60));
  EXPECT_EQ(tool.bottom(), 0);
  EXPECT_EQ(tool.top(), 60);
  EXPECT_EQ(tool.maximum_radius(), 10);
  EXPECT_NEAR(tool.reach(0), std::hypot(60, 10), 1e-12);
  EXPECT_NEAR(distance_to(tool, 13, -4), 5, 2e-7);
}

TEST(ToolShapes, BallEndsInASphere) {
  const RevolvedBody tool = body(ball_body(5, 40));
  EXPECT_EQ(tool.bottom(), 0);
  EXPECT_EQ(tool.top(), 40);
  EXPECT_NEAR(distance_to(tool, 6, -3), 10 - 5, 2e-7);  // 6-8-10 from the center at z 5.
  EXPECT_NEAR(distance_to(tool, 7, 30), 2, 2e-7);
}

TEST(ToolShapes, BullRoundsItsEdge) {
  const RevolvedBody tool = body(bull_body(10, 2, 40));
  EXPECT_NEAR(distance_to(tool, 8 + 3, 2 - 4), 5 - 2, 2e-7);  // 3-4-5 from the center of the corner.
  EXPECT_NEAR(distance_to(tool, 5, -1), 1, 2e-7);
}

TEST(ToolShapes, ConeAndDrillOpenByTheirAngle) {
  const RevolvedBody engraver = body(cone_body(6, 1, 90, 40));
  EXPECT_EQ(engraver.pieces().front().core.top_radius, 6);
  EXPECT_NEAR(engraver.pieces().front().core.top, 5, 1e-12);
  EXPECT_NEAR(distance_to(engraver, 1 + 4, 0), 4 / std::sqrt(2), 2e-7);
  const RevolvedBody drill = body(drill_body(4, 118, 80));
  EXPECT_NEAR(drill.pieces().front().core.top, 4 / std::tan(59 * std::numbers::pi / 180), 1e-12);
  EXPECT_EQ(drill.top(), 80);
}

/// The tip angle goes on to the end of a tool that is shorter than its cone.
TEST(ToolShapes, ShortConeEndsWithinItsAngle) {
  const RevolvedBody tool = body(cone_body(20, 0, 90, 15));
  EXPECT_EQ(tool.top(), 15);
  EXPECT_NEAR(tool.maximum_radius(), 15, 1e-12);
}

TEST(ToolShapes, DiscLiesAcrossItsOwnAxis) {
  const RevolvedBody blade = body(disc_body(100, 4));
  const AxisPlacement beside_the_spindle{{0, 0, 0}, {1, 0, 0}};
  const Cuboid panel{{-50, -50, -200}, {50, 50, -110}};
  EXPECT_NEAR(clearance(blade, beside_the_spindle, panel).lower, 10, 2e-6);
}

TEST(ToolShapes, FormFollowsItsPoints) {
  const std::vector<FormPoint> points = {{0, 0}, {0, 10}, {5, 4}, {5, 8}, {20, 8}};
  const RevolvedBody tool = body(form_body(points));
  ASSERT_EQ(tool.pieces().size(), 2U);
  EXPECT_NEAR(distance_to(tool, 10, -2), 2, 2e-7);
  EXPECT_NEAR(distance_to(tool, 8, 4), 1, 2e-7);  // In the groove, below the step.
}

/// A rim without thickness is a disc, wherever it is.
TEST(ToolShapes, FormHasItsThinRims) {
  const std::vector<FormPoint> at_the_end = {{0, 4}, {10, 4}, {10, 20}};
  const RevolvedBody tool = body(form_body(at_the_end));
  EXPECT_NEAR(distance_to(tool, 21, 10), 1, 2e-7);
  EXPECT_NEAR(distance_to(tool, 19, 8), 2, 2e-7);
  const std::vector<FormPoint> between = {{0, 4}, {10, 4}, {10, 20}, {10, 4}, {20, 4}};
  EXPECT_NEAR(distance_to(body(form_body(between)), 19, 13), 3, 2e-7);
}

TEST(ToolShapes, StackStandsOnItsBase) {
  const std::vector<StackRow> rows = {{35, 50, 50}, {42, 50, 63}};
  const RevolvedBody holder = body(stacked_body(rows, 120.5));
  EXPECT_EQ(holder.bottom(), 120.5);
  EXPECT_EQ(holder.top(), 197.5);
  EXPECT_EQ(holder.maximum_radius(), 31.5);
}

struct BadShape {
  const char* what;
  BodyOrProblem made;
  Fault kind;
  ShapeValue value;
  std::size_t row = 0;
  double limit = 0;
};

std::vector<BadShape> bad_tools() {
  return {
      {"radius NaN", flat_body(kNaN, 10), Fault::NotFinite, ShapeValue::Radius},
      {"radius 0", flat_body(0, 10), Fault::NotPositive, ShapeValue::Radius},
      {"radius negative", ball_body(-1, 10), Fault::NotPositive, ShapeValue::Radius},
      {"radius huge", flat_body(1e6, 10), Fault::TooLarge, ShapeValue::Radius, 0, kMaxSize},
      {"length infinite", flat_body(1, kInfinite), Fault::NotFinite, ShapeValue::Length},
      {"corner negative", bull_body(5, -0.1, 30), Fault::Negative, ShapeValue::CornerRadius},
      {"corner above radius", bull_body(5, 5.1, 30), Fault::TooLarge, ShapeValue::CornerRadius, 0, 5},
      {"length below ball", ball_body(5, 9), Fault::TooSmall, ShapeValue::Length, 0, 10},
      {"tip above radius", cone_body(5, 6, 90, 30), Fault::TooLarge, ShapeValue::TipRadius, 0, 5},
      {"tip negative", cone_body(5, -1, 90, 30), Fault::Negative, ShapeValue::TipRadius},
      {"angle 0", cone_body(5, 1, 0, 30), Fault::NotPositive, ShapeValue::TipAngle},
      {"angle 180", drill_body(5, 180, 30), Fault::TooLarge, ShapeValue::TipAngle, 0, 180},
      {"angle NaN", drill_body(5, kNaN, 30), Fault::NotFinite, ShapeValue::TipAngle},
      {"drill within cone", drill_body(5, 90, 4), Fault::TooSmall, ShapeValue::Length, 0, 5},
      {"thickness 0", disc_body(100, 0), Fault::NotPositive, ShapeValue::Thickness},
  };
}

std::vector<BadShape> bad_lists() {
  using Points = std::vector<FormPoint>;
  using Rows = std::vector<StackRow>;
  return {
      {"no points", form_body({}), Fault::TooFew, ShapeValue::Points, 0, 2},
      {"many points", form_body(Points(kMaxShapePoints + 1)), Fault::TooMany, ShapeValue::Points, 0, kMaxShapePoints},
      {"z falls", form_body(Points{{0, 1}, {2, 1}, {1, 1}}), Fault::NotAscending, ShapeValue::Z, 2, 2},
      {"z NaN", form_body(Points{{0, 1}, {kNaN, 1}}), Fault::NotFinite, ShapeValue::Z, 1},
      {"r negative", form_body(Points{{0, 1}, {1, -1}}), Fault::Negative, ShapeValue::PointRadius, 1},
      {"r infinite", form_body(Points{{0, kInfinite}, {1, 1}}), Fault::NotFinite, ShapeValue::PointRadius},
      {"flat", form_body(Points{{1, 0}, {1, 5}}), Fault::WithoutVolume, ShapeValue::Points},
      {"thin", form_body(Points{{0, 0}, {9, 0}}), Fault::WithoutVolume, ShapeValue::Points},
      {"no rows", stacked_body({}, 0), Fault::TooFew, ShapeValue::Points, 0, 1},
      {"height 0", stacked_body(Rows{{1, 2, 2}, {0, 2, 2}}, 0), Fault::NotPositive, ShapeValue::Height, 1},
      {"lower negative", stacked_body(Rows{{1, -2, 2}}, 0), Fault::Negative, ShapeValue::LowerDiameter},
      {"upper NaN", stacked_body(Rows{{1, 2, 2}, {1, 2, kNaN}}, 0), Fault::NotFinite, ShapeValue::UpperDiameter, 1},
      {"base infinite", stacked_body(Rows{{1, 2, 2}}, -kInfinite), Fault::NotFinite, ShapeValue::Z},
      {"stack of nothing", stacked_body(Rows{{1, 0, 0}}, 0), Fault::WithoutVolume, ShapeValue::Points},
  };
}

TEST(ToolShapes, SaysWhatIsWrong) {
  std::vector<BadShape> all = bad_tools();
  for (const BadShape& bad : bad_lists()) all.push_back(bad);
  for (const BadShape& bad : all) {
    SCOPED_TRACE(bad.what);
    const auto* const problem = std::get_if<ShapeProblem>(&bad.made);
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->kind, bad.kind);
    EXPECT_EQ(problem->value, bad.value);
    EXPECT_EQ(problem->row, bad.row);
    EXPECT_NEAR(problem->limit, bad.limit, 1e-9);
  }
}

}  // namespace
}  // namespace isocnc::solids
