#include "interpreter/configuration/mistake.h"

#include <gtest/gtest.h>

#include <string_view>

namespace isocnc::configuration {
namespace {

TEST(PlaceFinder, AgreesWithASearchFromTheStart) {
  static constexpr std::string_view kText = "{\"à\": 1,\r\n\r\"\xE2\x82\xAC\": [\n\n\"x\"]}\r";
  PlaceFinder finder(kText);
  for (std::size_t at = 0; at <= kText.size() + 2; ++at) {
    const bool is_inside = at < kText.size() && (static_cast<unsigned char>(kText[at]) & 0xC0) == 0x80;
    if (is_inside) continue;
    const DescriptionPlace place = finder.of(at);
    EXPECT_EQ(place.shown.line, place_of(at, kText).line) << at;
    EXPECT_EQ(place.shown.column, place_of(at, kText).column) << at;
  }
}

TEST(PlaceFinder, CountsBytesFromZero) {
  PlaceFinder finder("à\nàb");
  EXPECT_EQ(finder.of(5).byte, 2U);
  EXPECT_EQ(finder.of(5).shown.column, 2U);
  EXPECT_EQ(finder.of(0).byte, 0U);  // Going back starts over.
  EXPECT_EQ(finder.of(0).shown.line, 1U);
}

}  // namespace
}  // namespace isocnc::configuration
