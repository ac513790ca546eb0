#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "lsp/features/feature.h"
#include "lsp/queries/assignments.h"
#include "lsp/queries/jump_paths.h"

/// Go to definition: from a GOTO to its label, from a register to its assignments, from coordinates without G to the G
/// in force.
namespace isocnc::features {

using protocol::Location;
using queries::JumpPaths;
using queries::NameKind;
using queries::Occurrence;
using syntax::Span;

namespace {

/// A line and a span; ordered, so that duplicates can be removed.
using Spot = std::pair<std::size_t, Span>;

std::vector<Spot> spans_of(const std::vector<Occurrence>& all) {
  std::vector<Spot> spans;
  for (const Occurrence& each : all)
    if (each.is_definition) spans.emplace_back(each.line, each.span);
  return spans;
}

/// The label that the jump leads to; if it leads nowhere, all labels with that number.
std::vector<Spot> labels_of(const Snapshot& snapshot, const Occurrence& target) {
  std::vector<Spot> labels = spans_of(queries::occurrences(snapshot, target.name));
  const auto below =
      std::find_if(labels.begin(), labels.end(), [&](const Spot& label) { return label.first > target.line; });
  return below == labels.end() ? labels : std::vector<Spot>{*below};
}

/// The assignments that can reach this read of the register; if there is none, all of its assignments.
std::vector<Spot> assignments_of(const Snapshot& snapshot, const Occurrence& read) {
  const std::vector<Occurrence> reaching = queries::assignments_reaching(snapshot, read);
  return spans_of(reaching.empty() ? queries::occurrences(snapshot, read.name) : reaching);
}

/// The last motion G of a line.
std::optional<Span> motion_span(const syntax::LineTree& line) {
  for (auto instruction = line.instructions.rbegin(); instruction != line.instructions.rend(); ++instruction) {
    const bool is_g = instruction->kind == syntax::InstructionKind::G;
    if (is_g && instruction->g() && instruction->g()->is_motion()) return line.command(*instruction).span();
  }
  return std::nullopt;
}

bool is_continuation(const syntax::LineTree& line, std::uint32_t column) {
  return std::any_of(line.instructions.begin(), line.instructions.end(), [&](const syntax::Instruction& it) {
    if (it.kind != syntax::InstructionKind::Continuation) return false;
    const Span span = syntax::hull(line.words[it.begin].span(), line.words[it.end - 1u].span());
    return span.begin <= column && column <= span.end;
  });
}

/// The motion Gs that may be in force before a line.
std::vector<Spot> motions_before(const Snapshot& snapshot, std::size_t line) {
  return JumpPaths(snapshot).nearest_above(line, [&](std::size_t first, std::size_t end) -> std::optional<Spot> {
    for (std::size_t at = end; at-- > first;) {
      if (at % 1024 == 0) snapshot.throw_if_unwanted();
      const syntax::DocumentLine line = snapshot.document().line(at);
      if (const auto span = motion_span(*line)) return Spot{at, *span};
    }
    return std::nullopt;
  });
}

std::vector<Spot> spans_for(const Snapshot& snapshot, const syntax::Position& place) {
  if (const auto name = queries::name_at(snapshot, place)) {
    if (name->is_definition) return {{name->line, name->span}};
    return name->name.kind == NameKind::Label ? labels_of(snapshot, *name) : assignments_of(snapshot, *name);
  }
  const syntax::DocumentLine read = snapshot.document().line(place.line);
  const syntax::LineTree& line = *read;
  if (!is_continuation(line, static_cast<std::uint32_t>(place.column))) return {};
  return motions_before(snapshot, place.line);
}

std::optional<std::vector<Location>> answer_definition(const Snapshot& snapshot,
                                                       const protocol::PositionParams& params) {
  std::vector<Location> locations;
  for (const auto& [line, span] : spans_for(snapshot, snapshot.from_client(params.position)))
    locations.push_back({snapshot.uri(), snapshot.to_client(line, span)});
  return locations.empty() ? std::nullopt : std::optional(std::move(locations));
}

Json definition_capabilities(const Client&) { return {{"definitionProvider", true}}; }

}  // namespace

extern const Feature definition = {.capabilities = definition_capabilities,
                                   .methods = {on<&answer_definition>("textDocument/definition")}};

}  // namespace isocnc::features
