#include "interpreter/execution/plane.h"

#include <gtest/gtest.h>

#include <string_view>

#include "interpreter/execution/block_recorder.h"
#include "interpreter/syntax/tree_store.h"

/// The arc planes: axes, letters and sense (I.3.4.3.a, D40).
namespace isocnc::execution {
namespace {

const Plane& plane_after(std::string_view g) {
  const syntax::ParsedLine line(g);
  return plane_in_force(BlockRecorder(line.tree(), State{}, Setup{}).state());
}

struct Case {
  const char* g;
  char normal;
};

const Case kCases[] = {{"G17", 'Z'}, {"G18", 'Y'}, {"G19", 'X'}};

TEST(Plane, HasTheNormalThatItsGNames) {
  for (const auto& [g, normal] : kCases) EXPECT_EQ("XYZ"[plane_after(g).normal], normal) << g;
}

TEST(Plane, TurnsFromUToVAboutItsNormal) {
  for (const Case& each : kCases) {
    const Plane& plane = plane_after(each.g);
    EXPECT_EQ(geometry::Vec3::Unit(plane.u).cross(geometry::Vec3::Unit(plane.v)), geometry::Vec3::Unit(plane.normal))
        << each.g;
  }
}

TEST(Plane, NamesEachAxisAndItsCenterByTheirLetters) {
  for (const Case& each : kCases) {
    const Plane& plane = plane_after(each.g);
    EXPECT_EQ(plane.u_letter, "XYZ"[plane.u]) << each.g;
    EXPECT_EQ(plane.v_letter, "XYZ"[plane.v]) << each.g;
    EXPECT_EQ(plane.u_center, "IJK"[plane.u]) << each.g;
    EXPECT_EQ(plane.v_center, "IJK"[plane.v]) << each.g;
    EXPECT_EQ(plane.stray_center, "IJK"[plane.normal]) << each.g;
  }
}

}  // namespace
}  // namespace isocnc::execution
