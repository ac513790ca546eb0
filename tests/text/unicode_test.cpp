#include "interpreter/text/unicode.h"

#include <gtest/gtest.h>

namespace isocnc::text {
namespace {

TEST(Unicode, SequencesAreTheWellFormedOnes) {
  EXPECT_EQ(sequence_length("a"), 1u);
  EXPECT_EQ(sequence_length("é"), 2u);
  EXPECT_EQ(sequence_length("東x"), 3u);
  EXPECT_EQ(sequence_length("\U0001F527"), 4u);
  // Alone, cut short, too long for what they say, a surrogate, beyond the last code point.
  for (const char* text : {"\x80", "\xC3", "\xC3x", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80"})
    EXPECT_EQ(sequence_length(text), 0u) << text;
}

TEST(Unicode, ColumnsAreCodePointsAndStrayBytes) {
  EXPECT_EQ(column_of("", 0), 1u);
  EXPECT_EQ(column_of("a東\xFFz", 5), 4u);
  EXPECT_EQ(column_of("ab", 99), 3u);
}

TEST(Unicode, PrintableTextHasNoControls) {
  EXPECT_EQ(printable("à\tb"), "à b");
  EXPECT_EQ(printable("\x1b[1m\x7f\n"), "\uFFFD[1m\uFFFD\uFFFD");
  EXPECT_EQ(printable("\xC2\x9B\xFF"), "\uFFFD\uFFFD");
  EXPECT_EQ(printable("\xC2\xA0"), "\xC2\xA0");
}

}  // namespace
}  // namespace isocnc::text
