#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "analyzer/fixing/finding_fixes.h"
#include "interpreter/syntax/tree_store.h"
#include "tests/support/fixed_program.h"
#include "tests/support/random.h"

/// No fix turns words that would move the machine into a comment (D67).
namespace isocnc::fixing {
namespace {

namespace fs = std::filesystem;
using support::Random;

std::vector<std::string> programs() {
  std::vector<std::string> texts;
  for (const std::string folder : {"/tests/programs", "/tests/fixing/fixes", "/examples"})
    for (const auto& entry : fs::recursive_directory_iterator(ISOCNC_SOURCE_DIR + folder)) {
      if (entry.path().extension() != ".iso") continue;
      std::ifstream input(entry.path(), std::ios::binary);
      std::stringstream text;
      text << input.rdbuf();
      texts.push_back(text.str());
    }
  return texts;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream input(text);
  for (std::string line; std::getline(input, line);) lines.push_back(line);
  return lines;
}

/// The comments of a text that may move the machine if they were none: X10, G01 and the like as words of their own.
std::multiset<std::string> moving_comments(const std::string& text) {
  static const std::regex kMoving(R"((^|[^A-Za-z])([XYZBCIJKR]\s*(-|\+|−|–)?\s*[0-9.]|G\s*0*[0-3]($|[^0-9])))",
                                  std::regex::icase);
  std::multiset<std::string> found;
  for (const std::string& line : lines_of(text)) {
    const syntax::ParsedLine parsed(line);
    const syntax::LineTree tree = parsed.tree();
    for (const syntax::Span comment : tree.comments) {
      std::string content(tree.text_of(comment));
      const bool is_closed = content.starts_with('(') && content.ends_with(')');
      content = content.substr(1, content.size() - (is_closed ? 2 : 1));
      if (is_closed && std::regex_search(content, kMoving)) found.insert(content);
    }
  }
  return found;
}

/// Whether a fix has made a comment of what is none, or may be none, in the text before.
void expect_no_new_comment(const std::string& before, const std::string& after, const std::string& where) {
  const std::multiset<std::string> old_comments = moving_comments(before);
  for (const std::string& comment : moving_comments(after))
    EXPECT_TRUE(old_comments.contains(comment)) << where << ": (" << comment << ")\n" << before << "\n---\n" << after;
}

/// Checks all fixes of a program: each alone, and all that --unsafe-fixes makes.
std::size_t check_fixes_of(const std::string& text, const std::string& where) {
  const rules::CheckSetup setup;
  const check::Report report = support::found_in(text);
  FindingFixes fixes(text, report, setup);
  std::size_t count = 0;
  for (const check::LocatedFinding& located : report.findings) {
    std::optional<fixes::Fix> fix = fixes.of(located);
    if (!fix) continue;
    ++count;
    expect_no_new_comment(text, edited(text, fix->edits, fixes.program()), where + ", " + fix->title_in({}));
  }
  expect_no_new_comment(text, support::fixed(text, true), where);
  return count;
}

TEST(Comments, HoldNothingThatMovesTheMachine) {
  std::size_t fixes = 0;
  for (const std::string& text : programs()) fixes += check_fixes_of(text, "as it is");
  EXPECT_GT(fixes, 300u);
}

void replace_one(Random& random, std::string& text, std::string_view old_text, std::string_view new_text) {
  std::vector<std::size_t> places;
  for (std::size_t at = text.find(old_text); at != std::string::npos; at = text.find(old_text, at + 1))
    places.push_back(at);
  if (!places.empty()) text.replace(places[random.below(places.size())], old_text.size(), new_text);
}

/// A slip after which something looks like text, or like a comment.
void slip(Random& random, std::string& text) {
  static constexpr std::pair<std::string_view, std::string_view> kSlips[] = {
      {"-", "−"},  {"-", "–"},     {"-", "—"},   {"(", ""},          {")", ""},
      {" ", " ("}, {" ", ") "},    {"0", "O"},   {";", ""},          {"1", "l"},
      {" X", "X"}, {" Y", " MAX"}, {"G0", "GO"}, {" ", " CALL SUB"}, {" Z", " ASSE Z"}};
  const auto& [old_text, new_text] = kSlips[random.below(std::size(kSlips))];
  replace_one(random, text, old_text, new_text);
}

TEST(Comments, HoldNothingThatMovesTheMachineAfterSlips) {
  const std::vector<std::string> all = programs();
  std::size_t fixes = 0;
  for (const std::uint64_t seed : support::seeds(400)) {
    Random random(seed);
    const std::vector<std::string> lines = lines_of(all[random.below(all.size())]);
    const std::size_t first = random.below(lines.size());
    std::string text;
    for (std::size_t i = first; i < std::min(lines.size(), first + 12); ++i) text += lines[i] + "\n";
    for (int i = random.between(1, 4); i > 0; --i) slip(random, text);
    fixes += check_fixes_of(text, "seed " + std::to_string(seed));
  }
  EXPECT_GT(fixes, support::often(400));
}

}  // namespace
}  // namespace isocnc::fixing
