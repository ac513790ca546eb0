#include "interpreter/syntax/document.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/tree_text.h"

namespace isocnc::syntax {
namespace {

std::string lines_of(const Document& document) {
  std::string lines;
  for (std::size_t i = 0; i < document.line_count(); ++i) {
    if (i > 0) lines += '|';
    lines += document.text_of_line(i);
    EXPECT_EQ(document.line(i)->text, document.text_of_line(i));
  }
  return lines;
}

struct Split {
  const char* text;
  const char* lines;
};

class LineEnds : public testing::TestWithParam<Split> {};

TEST_P(LineEnds, AreKeptAndDivideTheText) {
  const Document document(GetParam().text);
  EXPECT_EQ(lines_of(document), GetParam().lines);
  EXPECT_EQ(document.text(), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(Texts, LineEnds,
                         testing::Values(Split{"", ""}, Split{"X1", "X1"}, Split{"X1\n", "X1|"}, Split{"X1\r", "X1|"},
                                         Split{"X1\r\n", "X1|"}, Split{"a\nb\rc\r\nd", "a|b|c|d"},
                                         Split{"a\n\rb", "a||b"}, Split{"\r\r\n\n", "|||"}, Split{"\n", "|"}));

struct Replacement {
  const char* before;
  Position begin;
  Position end;
  const char* text;
  const char* after;
};

class Edits : public testing::TestWithParam<Replacement> {};

TEST_P(Edits, GiveTheTextAndItsTrees) {
  const Replacement& edit = GetParam();
  Document document(edit.before);
  document.replace(edit.begin, edit.end, edit.text);
  EXPECT_EQ(document.text(), edit.after);
  EXPECT_EQ(support::text_of(document), support::text_of(Document(edit.after)));
}

INSTANTIATE_TEST_SUITE_P(
    OneEdit, Edits,
    testing::Values(Replacement{"G0\nX1\n", {0, 2}, {0, 2}, " X5", "G0 X5\nX1\n"},  // Insert.
                    Replacement{"G0\nX1\n", {0, 1}, {0, 2}, "", "G\nX1\n"},         // Delete.
                    Replacement{"G0\nX1\nY1\n", {0, 1}, {2, 1}, "1 Z", "G1 Z1\n"},  // Replace across lines.
                    Replacement{"G0\nX1\n", {0, 2}, {1, 0}, "", "G0X1\n"},          // Join.
                    Replacement{"G0 X1\n", {0, 2}, {0, 3}, "\r\n", "G0\r\nX1\n"},   // Divide.
                    Replacement{"G0\n", {1, 0}, {1, 0}, "X1", "G0\nX1"},            // At the end.
                    Replacement{"", {0, 0}, {0, 0}, "G0\n", "G0\n"},                // Into nothing.
                    Replacement{"G0\nX1", {0, 0}, {1, 2}, "", ""},                  // All.
                    Replacement{"a\r\nb", {0, 2}, {0, 2}, "X1", "a\rX1\nb"},        // Between CR and LF.
                    Replacement{"a\r\nb", {0, 1}, {0, 2}, "", "a\nb"},              // The CR of a CRLF.
                    Replacement{"a\r\nb", {0, 2}, {1, 0}, "", "a\rb"},              // The LF of a CRLF.
                    Replacement{"a\rX1\nb", {1, 0}, {1, 2}, "", "a\r\nb"},          // CR and LF meet.
                    Replacement{"a\rb", {1, 0}, {1, 0}, "\n", "a\r\nb"},            // An LF after a CR.
                    Replacement{"a\nb", {0, 1}, {0, 1}, "\r", "a\r\nb"},            // A CR before an LF.
                    Replacement{"a\rX\n\nb", {1, 0}, {2, 0}, "", "a\r\nb"},         // A line between them goes whole.
                    Replacement{"a\r", {1, 0}, {1, 0}, "\n", "a\r\n"}));            // The same at the end.

INSTANTIATE_TEST_SUITE_P(PlacesOutside, Edits,
                         testing::Values(Replacement{"G0\n", {9, 9}, {9, 9}, "X1", "G0\nX1"},
                                         Replacement{"G0\nX1", {9, 0}, {9, 0}, "\n", "G0\nX1\n"},
                                         Replacement{"G0\nX1", {0, 9}, {0, 9}, "Y1", "G0\nY1X1"},
                                         Replacement{"G0\nX1", {1, 9}, {7, 0}, " Y1", "G0\nX1 Y1"},
                                         Replacement{"G0\nX1", {1, 1}, {0, 1}, "2", "G0\nX21"}));

std::string numbered_lines(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "G1 X" + std::to_string(i) + "\n";
  return text;
}

TEST(Document, ReportsWhatAnEditDidToTheLines) {
  Document document("a\nb\nc\nd\n");
  const Change change = document.replace({1, 0}, {2, 1}, "1\n2\n3");
  EXPECT_EQ(change.first_line, 1u);
  EXPECT_EQ(change.removed, 2u);
  EXPECT_EQ(change.inserted, 3u);
}

std::set<std::uint64_t> versions(const Document& document) {
  std::set<std::uint64_t> all;
  for (std::size_t i = 0; i < document.chunk_count(); ++i) all.insert(document.chunk_version(i));
  return all;
}

TEST(Document, ChunksOfOtherLinesKeepTheirVersion) {
  Document document(numbered_lines(5'000));
  const std::set<std::uint64_t> before = versions(document);
  ASSERT_EQ(before.size(), document.chunk_count());
  document.replace({2'500, 4}, {2'500, 4}, "7");
  std::size_t fresh = 0;
  for (const std::uint64_t version : versions(document)) fresh += before.contains(version) ? 0 : 1;
  EXPECT_EQ(fresh, 1u);
}

TEST(Document, VersionsAreNeverUsedTwice) {
  Document document(numbered_lines(1'000));
  std::set<std::uint64_t> removed = versions(document);
  for (int i = 0; i < 50; ++i) {
    const std::set<std::uint64_t> before = versions(document);
    document.replace({static_cast<std::size_t>(i) * 20, 0}, {static_cast<std::size_t>(i) * 20, 0}, "(a)");
    for (const std::uint64_t version : versions(document))
      EXPECT_TRUE(before.contains(version) || !removed.contains(version)) << "edit " << i;
    removed.merge(versions(document));
  }
}

TEST(Document, ChunksHoldAllLinesInOrder) {
  Document document(numbered_lines(3'000));
  document.replace({100, 0}, {100, 0}, numbered_lines(2'000));
  document.replace({1'000, 0}, {3'500, 0}, "");
  std::size_t line = 0;
  ChunkTrees trees;
  for (std::size_t chunk = 0; chunk < document.chunk_count(); ++chunk) {
    EXPECT_EQ(document.first_line_of_chunk(chunk), line);
    EXPECT_GT(document.chunk_lines(chunk), 0u);
    trees.read(document, chunk);
    ASSERT_EQ(trees.size(), document.chunk_lines(chunk));
    for (std::size_t i = 0; i < trees.size(); ++i, ++line) {
      const DocumentLine alone = document.line(line);
      EXPECT_EQ(support::text_of(trees[i]), support::text_of(*alone));
    }
  }
  EXPECT_EQ(line, document.line_count());
}

TEST(Document, ALineMovesWithItsTree) {
  const Document document("G1 X1 (a)\nIF V1=2 GOTO N3\nG99 X\n");
  for (std::size_t i = 0; i < document.line_count(); ++i) {
    DocumentLine line = document.line(i);
    const std::string before = support::text_of(*line);
    const DocumentLine moved = std::move(line);
    EXPECT_EQ(support::text_of(*moved), before);
  }
}

}  // namespace
}  // namespace isocnc::syntax
