#include "analyzer/fixes/line_edits.h"

#include <algorithm>

#include "interpreter/text/characters.h"

namespace isocnc::fixes {

using syntax::Instruction;
using syntax::LineTree;
using syntax::Span;
using syntax::Word;

Edit replaced(const FixRequest& request, Span span, std::string text) {
  return {{request.number, span.begin}, {request.number, span.end}, std::move(text)};
}

Edit inserted(const FixRequest& request, std::uint32_t column, std::string text) {
  return replaced(request, {column, column}, std::move(text));
}

Span with_blanks(std::string_view line, Span span) {
  Span wide = span;
  while (wide.begin > 0 && text::is_blank(line[wide.begin - 1])) --wide.begin;
  if (wide.begin > 0) return wide;
  wide = span;  // The indentation stays.
  while (wide.end < line.size() && text::is_blank(line[wide.end])) ++wide.end;
  return wide;
}

Edit removed(const FixRequest& request, Span span) {
  return replaced(request, with_blanks(request.line.text, span), {});
}

std::string edited(std::string_view line, std::vector<Edit> edits) {
  std::stable_sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  std::string text(line);
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
    text.replace(edit->begin.column, edit->end.column - edit->begin.column, edit->text);
  return text;
}

/// Removes a line of `length` bytes with its end. For a last line without an end, removes the end of the line above and
/// the blank lines between, so that the program still has no line end there.
static Edit removed_line(FixProgram& program, std::size_t line, std::size_t length) {
  if (line + 1 < program.line_count()) return {{line, 0}, {line + 1, 0}, {}};
  std::size_t above = line;
  while (above > 0 && program.text(above - 1).empty()) --above;
  if (above > 0) return {{above - 1, program.text(above - 1).size()}, {line, length}, {}};
  return {{0, 0}, {line, length}, {}};
}

Edit removed_with_line(const FixRequest& request, Span span) {
  const std::string_view line = request.line.text;
  if (!is_blank(line.substr(0, span.begin)) || !is_blank(line.substr(span.end))) return removed(request, span);
  return removed_line(request.program, request.number, line.size());
}

bool is_blank(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return text::is_blank(c); });
}

int decimals_of(std::string_view number) {
  const std::size_t point = number.find('.');
  if (point == std::string_view::npos) return 0;
  return static_cast<int>(std::min<std::size_t>(number.size() - point - 1, kMaxDecimals));
}

std::string_view indentation(std::string_view line) {
  std::size_t blanks = 0;
  while (blanks < line.size() && text::is_blank(line[blanks])) ++blanks;
  return line.substr(0, blanks);
}

const Word* word_at(const LineTree& line, Span span) {
  const auto at = std::lower_bound(line.words.begin(), line.words.end(), span.begin,
                                   [](const Word& word, std::uint32_t begin) { return word.begin < begin; });
  return at != line.words.end() && at->begin == span.begin ? &*at : nullptr;
}

bool is_g(const Word& word, double number) {
  return word.letter == 'G' && word.is_plain_integer() && word.value == number;
}

const Instruction* owner_of(const LineTree& line, const Word& word) {
  const auto owner = std::find_if(line.instructions.begin(), line.instructions.end(),
                                  [&](const Instruction& each) { return each.number == word.owner; });
  return owner != line.instructions.end() ? &*owner : nullptr;
}

bool lacks_frame_arguments(const LineTree& line, const Word& g) {
  const Instruction* const owner = owner_of(line, g);
  const bool is_frame = owner && owner->g() && owner->g()->group == dialect::ModalGroup::Face;
  const Word* const next = &g + 1;
  return is_frame && next != line.words.data() + line.words.size() && next->owner != owner->number &&
         dialect::contains(dialect::kDimensionLetters, next->letter);
}

const Word* first_word(const LineTree& line) {
  const auto first =
      std::find_if(line.words.begin(), line.words.end(), [](const Word& word) { return word.letter != 'N'; });
  return first != line.words.end() ? &*first : nullptr;
}

}  // namespace isocnc::fixes
