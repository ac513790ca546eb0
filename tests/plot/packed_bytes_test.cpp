#include "interpreter/plot/packed_bytes.h"

#include <gtest/gtest.h>

#include <limits>

namespace isocnc::plot {
namespace {

using namespace std::string_view_literals;

TEST(PackedBytes, TakeAsFewBytesAsTheyNeed) {
  PackedBytes packed;
  for (const std::uint64_t number : {0U, 127U, 128U, 300U}) packed.put(number);
  EXPECT_EQ(packed.bytes(), "\x00\x7F\x80\x01\xAC\x02"sv);
}

TEST(PackedBytes, AlternateTheirSigns) {
  PackedBytes packed;
  for (const std::int64_t number : {0, -1, 1, -64, 64}) packed.put_signed(number);
  EXPECT_EQ(packed.bytes(), "\x00\x01\x02\x7F\x80\x01"sv);
}

TEST(InUnits, RoundsAndHoldsWhatIsTooLarge) {
  EXPECT_EQ(in_units(1.0006, 1e-3), 1001);
  EXPECT_EQ(in_units(-2.5, 1e-3), -2500);
  EXPECT_EQ(in_units(1e300, 1e-3), std::int64_t{1} << 50);
  EXPECT_EQ(in_units(-std::numeric_limits<double>::infinity(), 1e-3), -(std::int64_t{1} << 50));
  EXPECT_EQ(in_units(std::nan(""), 1e-3), 0);
}

TEST(Base64, IsAsInItsStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFF\xEF\xBE"), "/+++");
}

}  // namespace
}  // namespace isocnc::plot
