#include <gtest/gtest.h>

#include <string>

#include "lsp/protocol/encoding.h"
#include "lsp/protocol/uri.h"
#include "tests/support/random.h"

namespace isocnc::documents {
namespace {

TEST(Encoding, CountsTheUnitsBeforeAByte) {
  // a, e acute, euro, an emoji, b: bytes 0, 1, 3, 6, 10; end 11.
  const std::string line =
      "a\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80"
      "b";
  const std::size_t bytes[] = {0, 1, 3, 6, 10, 11};
  const std::uint32_t utf16[] = {0, 1, 2, 3, 5, 6};
  for (std::uint32_t i = 0; i < 6; ++i) {
    EXPECT_EQ(protocol::units_before(line, bytes[i], protocol::Encoding::Utf8), bytes[i]);
    EXPECT_EQ(protocol::units_before(line, bytes[i], protocol::Encoding::Utf16), utf16[i]);
    EXPECT_EQ(protocol::units_before(line, bytes[i], protocol::Encoding::Utf32), i);
    EXPECT_EQ(protocol::byte_at(line, utf16[i], protocol::Encoding::Utf16), bytes[i]);
    EXPECT_EQ(protocol::byte_at(line, i, protocol::Encoding::Utf32), bytes[i]);
  }
  // A position within a character becomes its start; one beyond the end becomes the end.
  EXPECT_EQ(protocol::units_before(line, 8, protocol::Encoding::Utf16), 3u);
  EXPECT_EQ(protocol::byte_at(line, 4, protocol::Encoding::Utf16), 6u);
  EXPECT_EQ(protocol::byte_at(line, 8, protocol::Encoding::Utf8), 6u);
  EXPECT_EQ(protocol::byte_at(line, 99, protocol::Encoding::Utf16), line.size());
  EXPECT_EQ(protocol::units_before(line, 99, protocol::Encoding::Utf32), 5u);
}

TEST(Encoding, EveryPlaceComesBack) {
  for (const std::uint64_t seed : support::seeds(300)) {
    support::Random random(seed);
    std::string line;
    for (int i = random.between(0, 20); i > 0; --i)
      line += random.any_of({"X1", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x98\x80", "\xFF", "\x80"});
    for (const protocol::Encoding encoding :
         {protocol::Encoding::Utf8, protocol::Encoding::Utf16, protocol::Encoding::Utf32})
      for (std::uint32_t units = 0; units <= protocol::units_before(line, line.size(), encoding); ++units) {
        const std::size_t byte = protocol::byte_at(line, units, encoding);
        const std::uint32_t back = protocol::units_before(line, byte, encoding);
        EXPECT_LE(back, units) << seed;
        EXPECT_EQ(protocol::byte_at(line, back, encoding), byte) << seed;
      }
  }
}

TEST(Encoding, HasTheNamesOfTheProtocol) {
  for (const char* const name : {"utf-8", "utf-16", "utf-32"})
    EXPECT_EQ(protocol::name_of(*protocol::encoding_named(name)), name);
  EXPECT_FALSE(protocol::encoding_named("utf-7"));
}

TEST(Uri, NamesAFileOrNone) {
  EXPECT_EQ(protocol::path_of("file:///a/part%201.iso"), "/a/part 1.iso");
  EXPECT_EQ(protocol::path_of("FILE:///a/%C3%A9.iso"), "/a/\xC3\xA9.iso");
  EXPECT_EQ(protocol::path_of("file://localhost/a/../b.iso"), "/b.iso");
  EXPECT_EQ(protocol::path_of("file:///a/100%.iso#L3"), "/a/100%.iso");
  for (const char* const none :
       {"untitled:Untitled-1", "file://server/a.iso", "file:", "", "/a/b.iso", "file:///a%00b"})
    EXPECT_FALSE(protocol::path_of(none)) << none;
  EXPECT_EQ(protocol::uri_of("/a b/\xC3\xA9.iso"), "file:///a%20b/%C3%A9.iso");
}

}  // namespace
}  // namespace isocnc::documents
