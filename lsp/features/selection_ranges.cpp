#include <utility>
#include <vector>

#include "lsp/features/feature.h"
#include "lsp/queries/names.h"
#include "lsp/queries/outline.h"

/// Selection ranges: a selection grows to number, word, instruction, line, section, program.
namespace isocnc::features {

using syntax::LineTree;
using syntax::Span;

namespace {

struct SelectionRangeParams : protocol::DocumentParams {
  std::vector<ClientPosition> positions;
};

void from_json(const Json& json, SelectionRangeParams& params) {
  from_json(json, static_cast<protocol::DocumentParams&>(params));
  params.positions = json.at("positions").get<std::vector<ClientPosition>>();
}

/// The ranges, each of which contains the one before.
struct SelectionRange {
  std::vector<ClientRange> ranges;
};

void to_json(Json& json, const SelectionRange& selection) {
  for (auto range = selection.ranges.rbegin(); range != selection.ranges.rend(); ++range) {
    Json inner = {{"range", *range}};
    if (!json.is_null()) inner["parent"] = std::move(json);
    json = std::move(inner);
  }
}

bool touches(Span span, std::uint32_t column) { return span.begin <= column && column <= span.end; }

/// The word that contains the column, else the one that ends there; null if there is none.
const syntax::Word* word_at(const LineTree& line, std::uint32_t column) {
  if (const syntax::Word* const word = line.word_at(column)) return word;
  return column == 0 ? nullptr : line.word_at(column - 1);
}

Span instruction_span(const LineTree& line, const syntax::Word& word) {
  Span all = word.span();
  for (const syntax::Word& other : line.words)
    if (word.owner != syntax::Word::kNoOwner && other.owner == word.owner) all = syntax::hull(all, other.span());
  return all;
}

/// The spans on the line around a column, smallest first.
std::vector<Span> spans_at(const LineTree& line, std::uint32_t column) {
  std::vector<Span> spans;
  const auto add = [&](Span span) {
    const bool grows = spans.empty() || (spans.back() != span && syntax::hull(spans.back(), span) == span);
    if (grows && touches(span, column)) spans.push_back(span);
  };
  for (const Span comment : line.comments) {
    if (!comment.holds(column)) continue;
    const bool is_closed = line.text[comment.begin] == '(' && line.text[comment.end - 1] == ')';
    add({comment.begin + 1, comment.end - (is_closed ? 1u : 0u)});
    add(comment);
  }
  if (const syntax::Word* const word = spans.empty() ? word_at(line, column) : nullptr) {
    for (const Span piece : queries::outside_comments(line, {word->begin + 1, word->end}))
      if (dialect::contains(dialect::kWordLetters, word->letter)) add(piece);
    add(word->span());
    add(instruction_span(line, *word));
  }
  const std::size_t size = line.text.size();
  const std::size_t first = line.text.find_first_not_of(" \t");
  if (first != std::string_view::npos)
    add({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(line.text.find_last_not_of(" \t") + 1)});
  add({0, static_cast<std::uint32_t>(size)});
  return spans;
}

std::vector<SelectionRange> answer_selection_ranges(const Snapshot& snapshot, const SelectionRangeParams& params) {
  const std::vector<queries::Section> sections = queries::outline(snapshot);
  const auto lines = [&](std::size_t first, std::size_t last) {
    return ClientRange{snapshot.to_client({first, 0}),
                       snapshot.to_client({last, snapshot.document().text_of_line(last).size()})};
  };
  std::vector<SelectionRange> selections;
  for (const ClientPosition& position : params.positions) {
    snapshot.throw_if_unwanted();
    const syntax::Position place = snapshot.from_client(position);
    SelectionRange selection;
    const auto add = [&](const ClientRange& range) {
      if (selection.ranges.empty() || selection.ranges.back() != range) selection.ranges.push_back(range);
    };
    const syntax::DocumentLine line = snapshot.document().line(place.line);
    for (const Span span : spans_at(*line, static_cast<std::uint32_t>(place.column)))
      add(snapshot.to_client(place.line, span));
    for (auto section = sections.rbegin(); section != sections.rend(); ++section)
      if (section->first_line <= place.line && place.line <= section->last_line)
        add(lines(section->first_line, section->last_line));
    add(lines(0, snapshot.document().line_count() - 1));
    selections.push_back(std::move(selection));
  }
  return selections;
}

Json selection_ranges_capabilities(const Client&) { return {{"selectionRangeProvider", true}}; }

}  // namespace

extern const Feature selection_ranges = {.capabilities = selection_ranges_capabilities,
                                         .methods = {on<&answer_selection_ranges>("textDocument/selectionRange")}};

}  // namespace isocnc::features
