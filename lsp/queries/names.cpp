#include "lsp/queries/names.h"

#include <algorithm>

#include "interpreter/text/characters.h"

namespace isocnc::queries {

using syntax::LineTree;
using syntax::Span;
using syntax::Word;

static std::vector<Occurrence> names_of(const LineTree& tree, std::size_t line) {
  std::vector<Occurrence> names;
  const auto add = [&](NameKind kind, std::uint64_t number, Span span, bool is_definition) {
    names.push_back({line, span, {kind, number}, is_definition});
  };
  if (const Word* const label = tree.label_word()) add(NameKind::Label, tree.label, label->span(), true);
  for (const syntax::Instruction& instruction : tree.instructions) {
    const Word& command = tree.command(instruction);
    if (instruction.kind == syntax::InstructionKind::Assignment && command.register_number() > 0)
      add(NameKind::Register, static_cast<std::uint64_t>(command.register_number()), command.span(), true);
  }
  if (!tree.jump) return names;
  if (tree.jump->variable > 0)
    add(NameKind::Register, static_cast<std::uint64_t>(tree.jump->variable), tree.jump->variable_span, false);
  if (tree.jump->has_target) add(NameKind::Label, tree.jump->target, tree.jump->target_span, false);
  return names;
}

std::optional<Occurrence> name_at(const documents::Snapshot& snapshot, const syntax::Position& place) {
  const syntax::DocumentLine line = snapshot.document().line(place.line);
  const std::vector<Occurrence> names = names_of(*line, place.line);
  const auto column = static_cast<std::uint32_t>(place.column);
  const auto holds = [&](const Occurrence& each) { return each.span.holds(column); };
  const auto ends = [&](const Occurrence& each) { return each.span.end == column; };
  auto found = std::find_if(names.begin(), names.end(), holds);
  if (found == names.end()) found = std::find_if(names.begin(), names.end(), ends);
  return found == names.end() ? std::nullopt : std::optional(*found);
}

std::vector<Occurrence> occurrences(const documents::Snapshot& snapshot, const Name& name) {
  const bool is_label = name.kind == NameKind::Label;
  const documents::LandmarkKinds wanted =
      is_label ? documents::kinds(documents::LandmarkKind::Jump)
               : documents::LandmarkKind::Assignment | documents::LandmarkKind::Comparison;
  const documents::ProgramIndex& index = snapshot.index();
  std::vector<Occurrence> found;
  for (const documents::Landmark& landmark : index.landmarks(wanted, name.number))
    found.push_back({landmark.line, landmark.span, name, landmark.kind == documents::LandmarkKind::Assignment});
  if (is_label)
    for (const std::size_t line : index.lines_of_label(name.number)) {
      const syntax::DocumentLine read = snapshot.document().line(line);
      if (const Word* const word = read->label_word()) found.push_back({line, word->span(), name, true});
    }
  std::sort(found.begin(), found.end(), [](const Occurrence& a, const Occurrence& b) {
    return std::pair(a.line, a.span) < std::pair(b.line, b.span);
  });
  return found;
}

static Span without_blanks(const LineTree& line, Span span) {
  while (!span.empty() && text::is_blank(line.text[span.begin])) ++span.begin;
  while (!span.empty() && text::is_blank(line.text[span.end - 1])) --span.end;
  return span;
}

std::vector<Span> outside_comments(const LineTree& line, Span span) {
  std::vector<Span> pieces;
  const auto add = [&](Span piece) {
    piece = without_blanks(line, piece);
    if (!piece.empty()) pieces.push_back(piece);
  };
  for (const Span comment : line.comments) {
    if (comment.end <= span.begin) continue;
    if (comment.begin >= span.end) break;
    add({span.begin, std::max(span.begin, comment.begin)});
    span.begin = std::min(comment.end, span.end);
  }
  add(span);
  return pieces;
}

}  // namespace isocnc::queries
