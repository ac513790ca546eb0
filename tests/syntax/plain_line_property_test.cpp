#include <gtest/gtest.h>

#include <string>

#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"
#include "tests/support/random.h"
#include "tests/support/tree_text.h"

namespace isocnc::syntax {
namespace {

using support::Random;

/// Numbers of all lengths up to twenty characters, and what looks like one.
std::string random_number(Random& random) {
  std::string text(random.any_of({"", "", "", "-", "-", "+", "- "}));
  for (int i = random.between(0, random.one_in(8) ? 12 : 4); i > 0; --i) text += random.any_of("0123456789");
  if (random.one_in(2)) text += '.';
  for (int i = random.between(0, random.one_in(8) ? 12 : 3); i > 0; --i) text += random.any_of("0123456789");
  if (random.one_in(40)) text.insert(random.below(text.size() + 1), random.any_of({".", ",", "-", " ", "(a)", "e"}));
  return text;
}

/// An assignment, or something else in the place of its =.
std::string random_assignment(Random& random) {
  const std::string name = std::string(random.any_of({"V", "v", "V "})) + std::to_string(random.between(1, 33));
  return name + std::string(random.any_of({"=", " = ", "= ", " =", "*", "X", " ", ":"})) + random_number(random);
}

/// Lines of words with motions among them, of which about one in five is plain.
std::string random_line(Random& random) {
  if (random.one_in(20)) return random_assignment(random);
  std::string text;
  if (random.one_in(3)) text += "N" + std::to_string(random.between(0, 100'000));
  if (!text.empty() && !random.one_in(8)) text += ' ';
  if (random.one_in(2)) text += random.any_of({"G0 ", "G01 ", "G2", "G03 ", "G 1", "g00 ", "G4", "G40 ", "G9"});
  for (int i = random.between(0, 6); i > 0; --i) {
    text += random.any_of(random.one_in(10) ? "ABCDEFGIJKMNPRSTVXYZxyzbcijkrfn" : "XYZXYZIJKRBCF");
    if (random.one_in(20)) text += random.any_of({" ", "\t", "  "});
    text += random_number(random);
    if (!random.one_in(6)) text += ' ';
    if (random.one_in(30)) text += random.any_of({"(a)", "(", ";X1", "\t", ")", "=", "V1=2", "M3", "IF V1=2 GOTO N5"});
  }
  return text;
}

std::string random_program_text(Random& random, int lines) {
  std::string text;
  for (; lines > 0; --lines) text += random_line(random) + std::string(random.any_of({"\n", "\n", "\n", "\r\n", "\r"}));
  return text;
}

/// Rows of plain lines are read by a way of their own, which must not show in the trees.
TEST(PlainLineProperty, TreesAreThoseOfTheGeneralParser) {
  std::size_t plain = 0;
  std::size_t others = 0;
  for (const std::uint64_t seed : support::seeds(800)) {
    Random random(seed);
    const std::string text = random_program_text(random, random.between(1, 150));
    const char* const end = text.data() + text.size();
    const char* const stop = text.data() + random.below(text.size() + 1);
    TreeStore rows;
    const char* const reached = rows.append_lines(text.data(), stop, end);
    std::size_t line = 0;
    const char* p = text.data();
    for (; p < stop; ++line) {
      TreeStore alone;
      const char* const line_end = alone.append_any_line(p, end);
      ASSERT_LT(line, rows.size());
      ASSERT_EQ(support::text_of(rows.tree(line, p)), support::text_of(alone.tree(0, p))) << "seed " << seed;
      ++(rows.tree(line, p).plain_arguments != 0 ? plain : others);
      p = text::skip_line_end(line_end, end);
    }
    EXPECT_EQ(line, rows.size());
    EXPECT_EQ(p, reached);
  }
  EXPECT_GT(10 * plain, others);
  EXPECT_GT(10 * others, plain);
}

TEST(PlainLineProperty, OneLineIsReadLikeMany) {
  for (const std::uint64_t seed : support::seeds(300)) {
    Random random(seed);
    const std::string text = random_program_text(random, 30);
    const char* const end = text.data() + text.size();
    TreeStore rows;
    rows.append_lines(text.data(), end, end);
    TreeStore singly;
    std::size_t line = 0;
    for (const char* p = text.data(); p < end; ++line) {
      const char* const line_end = singly.append_line(p, end);
      EXPECT_EQ(support::text_of(singly.tree(line, p)), support::text_of(rows.tree(line, p))) << "seed " << seed;
      p = text::skip_line_end(line_end, end);
    }
    EXPECT_EQ(line, rows.size());
  }
}

}  // namespace
}  // namespace isocnc::syntax
