#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"
#include "require.h"
#include "tests/support/tree_text.h"

namespace isocnc::fuzz {

using syntax::LineTree;
using syntax::ParsedLine;
using syntax::Span;

static void check_spans(const LineTree& tree) {
  const auto within = [&](Span span) { return span.begin <= span.end && span.end <= tree.text.size(); };
  std::uint32_t last_end = 0;
  for (const syntax::Word& word : tree.words) {
    require(within(word.span()) && word.begin < word.end, "words lie within the line");
    require(word.begin >= last_end, "words are ordered and apart");
    last_end = word.end;
  }
  for (const Span comment : tree.comments) require(within(comment), "comments lie within the line");
  for (const syntax::Finding& finding : tree.findings)
    require(within(finding.span) && within(finding.related), "findings lie within the line");
  const auto by_column = [](const syntax::Finding& a, const syntax::Finding& b) { return a.span.begin < b.span.begin; };
  require(std::is_sorted(tree.findings.begin(), tree.findings.end(), by_column), "findings are sorted");
}

static void check_instructions(const LineTree& tree) {
  for (const syntax::Instruction& each : tree.instructions) {
    require(each.begin < each.end && each.end <= tree.words.size(), "instructions hold words of the line");
    require(each.begin <= each.command && each.command < each.end, "instructions hold their command");
  }
  const auto exists = [&](std::uint16_t number) {
    return std::any_of(tree.instructions.begin(), tree.instructions.end(),
                       [&](const syntax::Instruction& each) { return each.number == number; });
  };
  for (const syntax::Word& word : tree.words)
    require(word.owner == syntax::Word::kNoOwner || exists(word.owner), "owners are instructions");
  const auto words = static_cast<std::int32_t>(tree.words.size());
  require(tree.feed < words && tree.spindle < words, "F and S are words of the line");
}

/// Nothing that cannot be read passes in silence.
static void check_is_reported(const LineTree& tree) {
  const auto is_wrong = [](const syntax::Word& word) {
    constexpr auto kWrong = syntax::Word::kMissing | syntax::Word::kMalformed;
    return word.letter == syntax::kError || word.letter == syntax::kNumber || word.has(kWrong);
  };
  if (tree.jump == nullptr && std::any_of(tree.words.begin(), tree.words.end(), is_wrong))
    require(!tree.findings.empty(), "what cannot be read is reported");
}

/// Codes and places: what must not depend on upper and lower case.
static std::vector<std::string> findings_of(const LineTree& tree) {
  std::vector<std::string> all;
  for (const syntax::Finding& finding : tree.findings) all.push_back(support::text_of(finding));
  return all;
}

static std::string in_case(std::string_view text, char from, int shift) {
  std::string other(text);
  for (char& c : other)
    if (c >= from && c < from + 26) c = static_cast<char>(c + shift);
  return other;
}

/// Lines that others follow may be read by a fast path, which gives the same trees.
static void check_parsers_agree(std::string_view text) {
  const std::string padded = std::string(text) + "\nX1 Y2.5 Z-3.25 F100\nX2\n";
  const char* const end = padded.data() + padded.size();
  syntax::TreeStore rows;
  rows.append_lines(padded.data(), end, end);
  std::size_t line = 0;
  for (const char* p = padded.data(); p < end; ++line) {
    syntax::TreeStore alone;
    const char* const line_end = alone.append_any_line(p, end);
    require(line < rows.size() && support::text_of(rows.tree(line, p)) == support::text_of(alone.tree(0, p)),
            "all ways of reading a line give the same tree");
    p = text::skip_line_end(line_end, end);
  }
  require(line == rows.size(), "all ways of reading see the same lines");
}

static void check_line(std::string_view text) {
  check_parsers_agree(text);
  const ParsedLine line(text);
  const LineTree tree = line.tree();
  check_spans(tree);
  check_instructions(tree);
  check_is_reported(tree);
  require(support::text_of(tree) == support::text_of(ParsedLine(text).tree()), "equal text gives equal trees");
  require(findings_of(tree) == findings_of(ParsedLine(in_case(text, 'a', 'A' - 'a')).tree()),
          "upper case means the same");
  require(findings_of(tree) == findings_of(ParsedLine(in_case(text, 'A', 'a' - 'A')).tree()),
          "lower case means the same");
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::check_line(isocnc::fuzz::as_text(data, size));
  return 0;
}
