#include "interpreter/syntax/number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/random.h"

namespace isocnc::syntax {
namespace {

using support::Random;

Number read(const std::string& text) { return scan_number(text.data(), text.data() + text.size()); }

std::size_t length_of(const Number& number, const std::string& text) {
  return static_cast<std::size_t>(number.end - text.data());
}

std::string random_digits(Random& random, int maximum) {
  std::string digits;
  for (int i = random.between(0, maximum); i > 0; --i) digits += random.any_of("0123456789");
  return digits;
}

/// A number as I.2.1 allows it, of any length.
std::string random_decimal(Random& random) {
  const int maximum = random.one_in(8) ? 400 : random.one_in(4) ? 25 : 6;
  std::string text;
  if (random.one_in(3)) text += random.any_of("+-");
  const std::string whole = random_digits(random, maximum);
  text += whole;
  const bool needs_decimals = whole.empty();
  if (needs_decimals || random.one_in(2)) {
    text += '.';
    if (random.one_in(6)) text += std::string(random.below(350), '0');
    text += random_digits(random, maximum);
    if (needs_decimals) text += random.any_of("0123456789");
  }
  return text;
}

TEST(Number, HasTheValueThatStrtodGives) {
  for (const std::uint64_t seed : support::seeds(20'000)) {
    Random random(seed);
    const std::string text = random_decimal(random);
    const double expected = std::strtod(text.c_str(), nullptr);
    const Number number = read(text);
    EXPECT_FALSE(number.has(Number::kMalformed)) << "seed " << seed << ": " << text;
    EXPECT_EQ(length_of(number, text), text.size()) << "seed " << seed << ": " << text;
    if (std::isinf(expected)) {
      EXPECT_TRUE(std::isnan(number.value)) << "seed " << seed << ": " << text;
    } else {
      EXPECT_EQ(number.value, expected) << "seed " << seed << ": " << text;
    }
  }
}

TEST(Number, MeansTheSameWithBlanksAndCommentsInside) {
  for (const std::uint64_t seed : support::seeds(5'000)) {
    Random random(seed);
    const std::string plain = random_decimal(random);
    std::string spaced;
    for (const char c : plain) {
      if (!spaced.empty())
        while (random.one_in(3)) spaced += random.any_of({" ", "\t", "(a)", "(1.5)", "()", "(;()"});
      spaced += c;
    }
    const Number expected = read(plain);
    const Number number = read(spaced);
    EXPECT_TRUE(number.value == expected.value || (std::isnan(number.value) && std::isnan(expected.value)))
        << "seed " << seed << ": " << spaced;
    EXPECT_FALSE(number.has(Number::kMalformed)) << "seed " << seed << ": " << spaced;
    EXPECT_EQ(number.digits, expected.digits) << "seed " << seed << ": " << spaced;
    EXPECT_EQ(number.has(Number::kSigned), expected.has(Number::kSigned)) << "seed " << seed << ": " << spaced;
    EXPECT_EQ(number.has(Number::kPoint), expected.has(Number::kPoint)) << "seed " << seed << ": " << spaced;
    EXPECT_EQ(length_of(number, spaced), spaced.size()) << "seed " << seed << ": " << spaced;
  }
}

struct Spelling {
  const char* text;
  double value;
  std::uint32_t digits;
  bool is_signed;
  bool has_point;
};

class WellFormed : public testing::TestWithParam<Spelling> {};

TEST_P(WellFormed, IsReadAsWritten) {
  const Spelling& expected = GetParam();
  const Number number = read(expected.text);
  EXPECT_FALSE(number.has(Number::kMalformed));
  EXPECT_EQ(number.value, expected.value);
  EXPECT_EQ(number.digits, expected.digits);
  EXPECT_EQ(number.has(Number::kSigned), expected.is_signed);
  EXPECT_EQ(number.has(Number::kPoint), expected.has_point);
}

INSTANTIATE_TEST_SUITE_P(Spellings, WellFormed,
                         testing::Values(Spelling{"5", 5, 1, false, false}, Spelling{"5.", 5, 1, false, true},
                                         Spelling{".5", 0.5, 1, false, true}, Spelling{"+5", 5, 1, true, false},
                                         Spelling{"-.5", -0.5, 1, true, true}, Spelling{"+5.", 5, 1, true, true},
                                         Spelling{"007", 7, 3, false, false}, Spelling{"1.500", 1.5, 4, false, true},
                                         Spelling{"0", 0, 1, false, false}, Spelling{"- 5 . 65", -5.65, 3, true, true},
                                         Spelling{"1(a)0", 10, 2, false, false},
                                         Spelling{"9007199254740993", 9007199254740992.0, 16, false, false},
                                         Spelling{"000000000000000000000001", 1, 24, false, false}));

class Malformed : public testing::TestWithParam<const char*> {};

TEST_P(Malformed, IsNoNumberYetReadToItsEnd) {
  const std::string text = GetParam();
  const Number number = read(text + " X1");
  EXPECT_TRUE(number.has(Number::kMalformed));
  EXPECT_TRUE(std::isnan(number.value));
  EXPECT_EQ(length_of(read(text), text), text.size());
}

INSTANTIATE_TEST_SUITE_P(Spellings, Malformed,
                         testing::Values(".", "+", "-", ",", "1.2.3", "1,5", "--1", "+-1", "1-", "1+2", "-.", "+.",
                                         "1..", "..1", "1 . 2 . 3", "1(a),(b)5", "1234567890123456789012345,6"));

TEST(Number, EndsAfterItsLastCharacter) {
  for (const std::string rest : {" ", "\t", "X", "(a)", " (a) X", "(a", ";5", "\n5", "\r5", " \n5", "(a)\n5", ")5"}) {
    const std::string text = "12.5" + rest;
    const Number number = read(text);
    EXPECT_EQ(length_of(number, text), 4u) << text;
    EXPECT_EQ(number.value, 12.5) << text;
  }
}

void expect_same_before_more_text(const std::string& text) {
  const std::string padded = text + "\n" + std::string(20, 'X');
  const Number expected = read(text);
  const Number number = scan_number(padded.data(), padded.data() + padded.size());
  EXPECT_TRUE(number.value == expected.value || (std::isnan(number.value) && std::isnan(expected.value))) << text;
  EXPECT_EQ(std::signbit(number.value), std::signbit(expected.value)) << text;
  EXPECT_EQ(number.digits, expected.digits) << text;
  EXPECT_EQ(number.flags, expected.flags) << text;
  EXPECT_EQ(length_of(number, padded), length_of(expected, text)) << text;
}

/// A short number is looked up by its shape, but read digit by digit where the text ends soon after it.
TEST(Number, IsTheSameWhetherTheTextGoesOn) {
  constexpr std::string_view kCharacters = "07+-.";
  std::vector<std::string> spellings = {""};
  for (std::size_t i = 0; i < spellings.size(); ++i) {
    if (!spellings[i].empty()) expect_same_before_more_text(spellings[i]);
    if (spellings[i].size() == 5) continue;
    for (const char c : kCharacters) spellings.push_back(spellings[i] + c);
  }
  for (const std::uint64_t seed : support::seeds(20'000)) {
    Random random(seed);
    expect_same_before_more_text(random_decimal(random));
  }
}

/// However it is spelled: programs that mean the same give the same trace.
TEST(Number, MinusZeroIsZero) {
  for (const std::string zero : {"-0", "- 0", "-0.", "-.0", "-(a)0", "-0.000000000", "-00000000000000000000"})
    EXPECT_FALSE(std::signbit(read(zero).value)) << zero;
}

TEST(Number, BeyondADoubleIsUnknownAndTooSmallIsZero) {
  EXPECT_TRUE(std::isnan(read(std::string(400, '9')).value));
  EXPECT_FALSE(read(std::string(400, '9')).has(Number::kMalformed));
  EXPECT_EQ(read("." + std::string(400, '0') + "1").value, 0);
}

}  // namespace
}  // namespace isocnc::syntax
