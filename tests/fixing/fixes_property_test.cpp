#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "analyzer/fixing/finding_fixes.h"
#include "interpreter/syntax/tree_store.h"
#include "tests/support/fixed_program.h"
#include "tests/support/motions.h"
#include "tests/support/random_program.h"

namespace isocnc::fixing {
namespace {

using support::codes_of;
using support::fixed;
using support::motions_of;
using support::Random;
using support::random_lines;
using support::without_what_units_reveal;

struct Sample {
  std::string text;
  std::string line_end;
};

/// What people write who have worked at other controls.
std::string with_habits(Random& random, std::string line) {
  switch (random.between(0, 40)) {
    case 0:
      return line + " M02";
    case 1:
      return line + " ;isolint: ignore W001, ISO003";
    case 2:
      return "(isolint: disable ISO011 W109) " + line;
    case 3:
      return "G21 " + line;
    case 4:
      return line + " G40";
    case 5:
      return line + " G71 G71";
    case 6:
      return line + " F500 F500";
    case 7:
      return "T101001 M06";
    case 8:
      return "%";
    case 9:
      return "G90 G91 " + line;
    case 10:
      return line + " (isolint: ignore) (isolint: enable)";
    default:
      return line;
  }
}

Sample random_sample(Random& random) {
  std::vector<std::string> lines = random_lines(random, 40);
  for (std::string& line : lines) line = with_habits(random, std::move(line));
  const std::string line_end(random.any_of({"\n", "\r\n", "\r"}));
  Sample sample{support::joined(lines, line_end), line_end};
  if (random.one_in(4) && !sample.text.empty()) sample.text.resize(sample.text.size() - line_end.size());
  return sample;
}

TEST(FixesProperty, AddNoFindingAndComeToAnEnd) {
  std::size_t changed = 0;
  for (const std::uint64_t seed : support::seeds(2'000)) {
    Random random(seed);
    const std::string text = random_sample(random).text;
    const std::multiset<std::string> before = without_what_units_reveal(codes_of(text), text);
    for (const bool unsafe : {false, true}) {
      const std::string once = fixed(text, unsafe);
      const std::multiset<std::string> after = without_what_units_reveal(codes_of(once), text);
      ASSERT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()))
          << "seed " << seed << (unsafe ? ", unsafe\n" : "\n") << testing::PrintToString(before) << " -> "
          << testing::PrintToString(after) << "\n"
          << text << "\n---\n"
          << once;
      ASSERT_EQ(fixed(once, unsafe), once) << "seed " << seed << "\n" << text;
      changed += once != text ? 1 : 0;
    }
  }
  EXPECT_GT(changed, support::often(2'000));
}

/// Each fix alone, too: in an editor, a user makes one at a time.
TEST(FixesProperty, WhatIsOfferedBringsNothing) {
  std::size_t offered = 0;
  const rules::CheckSetup setup;
  for (const std::uint64_t seed : support::seeds(3'000)) {
    Random random(seed);
    const std::string text = random_sample(random).text;
    if (text.find("isolint") != std::string::npos) continue;
    const std::multiset<std::string> before = codes_of(text);
    const check::Report report = support::found_in(text);
    FindingFixes fixes(text, report, setup);
    for (const check::LocatedFinding& located : report.findings) {
      std::optional<fixes::Fix> fix = fixes.offered_in_full(located);
      if (!fix) continue;
      ++offered;
      const std::string after_text = edited(text, fix->edits, fixes.program());
      const std::multiset<std::string> after = codes_of(after_text);
      if (fix->habit == fixes::Habit::ForeignUnits) {
        ASSERT_LT(after.count("E001"), before.count("E001")) << "seed " << seed << "\n" << text;
        continue;
      }
      ASSERT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()) &&
                  after.size() < before.size())
          << "seed " << seed << ": " << fix->title.en << "\n"
          << text << "\n---\n"
          << after_text;
    }
  }
  EXPECT_GT(offered, support::often(100));
}

TEST(FixesProperty, KeepLineEndsAndTheLastOnesState) {
  for (const std::uint64_t seed : support::seeds(4'000)) {
    Random random(seed);
    const auto [text, line_end] = random_sample(random);
    if (text.find(line_end) == std::string::npos) continue;  // It has none to keep.
    const std::string once = fixed(text, true);
    const std::string without = std::regex_replace(once, std::regex(line_end), "");
    ASSERT_EQ(without.find_first_of("\r\n"), std::string::npos) << "seed " << seed << "\n" << text;
    // A program of nothing but a word that is removed has no line left to end.
    if (once.empty()) continue;
    ASSERT_EQ(once.ends_with(line_end), text.ends_with(line_end)) << "seed " << seed << "\n" << text;
  }
}

TEST(FixesProperty, SafeOnesLeaveWhatTheProgramDoes) {
  std::size_t compared = 0;
  for (const std::uint64_t seed : support::seeds(10'000)) {
    Random random(seed);
    std::string text = random_sample(random).text;
    const double vgpl = random.between(0, 4);
    const std::string motions = motions_of(text, vgpl);
    const std::string once = fixed(text, false);
    if (motions.empty() || once == text) continue;
    ++compared;
    ASSERT_EQ(motions_of(once, vgpl), motions) << "seed " << seed << "\n" << text << "\n---\n" << once;
  }
  EXPECT_GT(compared, support::often(200));
}

}  // namespace
}  // namespace isocnc::fixing
