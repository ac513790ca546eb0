#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "interpreter/syntax/document.h"
#include "tests/support/random.h"
#include "tests/support/tree_text.h"

namespace isocnc::syntax {
namespace {

using support::Random;

/// Text of all that a program can hold and much that it cannot, with all three line ends.
std::string random_text(Random& random, int max_pieces) {
  std::string text;
  for (int i = random.between(0, max_pieces); i > 0; --i)
    text += random.any_of({"\r",
                           "\n",
                           "\r\n",
                           "\n\r",
                           "G1",
                           "X10",
                           " Y-2.5",
                           "N7",
                           " ",
                           "\t",
                           "(a)",
                           "(",
                           ")",
                           ";",
                           "M06",
                           "T101001",
                           "F",
                           "S500",
                           "V1=2",
                           "=",
                           "IF V1",
                           "GOTO N7",
                           "<>3",
                           "g 2",
                           "\xC3\xA8",
                           "\xE2\x82\xAC",
                           "#5",
                           "%",
                           "1.2.3",
                           "R5",
                           "I",
                           "M100 P1=2.5",
                           "(b;\xC3)",
                           ".",
                           "-",
                           "G0 X1 Y1\n",
                           "M02\r\n",
                           "X",
                           "IF VGPL=1 GOTO N7\n"});
  return text;
}

/// The same document as a plain string.
class Model {
 public:
  explicit Model(std::string text) : text_(std::move(text)) {}

  const std::string& text() const { return text_; }

  void replace(Position begin, Position end, const std::string& text) {
    const std::size_t first = offset_of(begin);
    const std::size_t last = std::max(first, offset_of(end));
    text_.replace(first, last - first, text);
  }

  std::vector<std::size_t> line_starts() const {
    std::vector<std::size_t> begins{0};
    for (std::size_t i = 0; i < text_.size(); ++i) {
      const bool is_half = text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n';
      if ((text_[i] == '\n' || text_[i] == '\r') && !is_half) begins.push_back(i + 1);
    }
    return begins;
  }

 private:
  std::size_t offset_of(Position position) const {
    const std::vector<std::size_t> begins = line_starts();
    if (position.line >= begins.size()) return text_.size();
    const std::size_t end = position.line + 1 < begins.size() ? begins[position.line + 1] : text_.size();
    return std::min(begins[position.line] + position.column, end);
  }

  std::string text_;
};

Position random_position(Random& random, std::size_t lines) {
  return {random.below(lines + 1), static_cast<std::size_t>(random.one_in(3) ? 0 : random.between(0, 12))};
}

Position random_end(Random& random, Position begin) {
  if (random.one_in(2)) return {begin.line, begin.column + random.below(4)};
  return {begin.line + random.below(random.one_in(10) ? 400 : 4), random.below(8)};
}

void expect_same(const Document& document, const Model& model, const std::string& which) {
  ASSERT_EQ(document.text(), model.text()) << which;
  ASSERT_EQ(document.line_count(), model.line_starts().size()) << which;
  ASSERT_EQ(support::text_of(document), support::text_of(Document(model.text()))) << which;
}

void edit_at_random(std::uint64_t seed, int pieces, int edits) {
  Random random(seed);
  Model model(random_text(random, pieces));
  Document document(model.text());
  for (int i = 0; i < edits; ++i) {
    const Position begin = random_position(random, document.line_count());
    const Position end = random_end(random, begin);
    const std::string text = random_text(random, random.one_in(12) ? 300 : 3);
    model.replace(begin, end, text);
    document.replace(begin, end, text);
    expect_same(document, model, "seed " + std::to_string(seed) + ", edit " + std::to_string(i));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(DocumentProperty, EditedEqualsFresh) {
  for (const std::uint64_t seed : support::seeds(400)) edit_at_random(seed, 40, 25);
}

TEST(DocumentProperty, EditedEqualsFreshOverManyChunks) {
  for (const std::uint64_t seed : support::seeds(12)) edit_at_random(1'000 + seed, 6'000, 25);
}

}  // namespace
}  // namespace isocnc::syntax
