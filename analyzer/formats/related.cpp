#include "analyzer/formats/related.h"

#include <algorithm>

#include "interpreter/dialect/format.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::formats {

using namespace dialect::literals;
using syntax::Instruction;
using syntax::LineTree;
using syntax::Word;

/// The maximum distance of a related place, in bytes.
static constexpr std::size_t kReach = 1'000'000;

static constexpr dialect::Text kMounted = {"the face frame was mounted here", "la faccia è stata messa in presa qui"};
static constexpr dialect::Text kSet = {"in force since here", "in presa da qui"};
static constexpr dialect::Text kFirstLabel = {"the label stands here already", "l'etichetta c'è già qui"};

namespace {

/// The target of a search.
struct Wanted {
  dialect::Text note;
  bool mounts_face = false;
  std::uint8_t code_row = dialect::kUnknownGCode;  ///< The G to find.
  bool is_label = false;
  std::uint64_t label = 0;

  /// The matching word on the line, or null.
  const Word* on(const LineTree& line) const {
    if (is_label) return line.has_label() && line.label == label ? line.label_word() : nullptr;
    for (const Instruction& instruction : line.instructions) {
      const dialect::GCode* const code = instruction.kind == syntax::InstructionKind::G ? instruction.g() : nullptr;
      if (!code) continue;
      if (mounts_face ? code->mounts_face() : instruction.row == code_row) return &line.command(instruction);
    }
    return nullptr;
  }
};

std::optional<Wanted> wanted_by(const check::LocatedFinding& located, std::string_view line_text) {
  const dialect::DiagnosticId id = located.finding.id;
  if (id == "face-already-mounted"_diag || id == "workpiece-frame-under-face"_diag)
    return Wanted{.note = kMounted, .mounts_face = true};
  // The message says which G has stayed in force.
  if (located.finding.has("circle-not-given/continuation"_cause) ||
      located.finding.has("missing-coordinate/continuation"_cause))
    return Wanted{.note = kSet,
                  .code_row = dialect::kGCodeRows[static_cast<std::size_t>(located.finding.values.front())]};
  const bool is_label = id == "duplicate-label"_diag;
  if (!is_label && id != "redundant-modal"_diag) return std::nullopt;
  // Parses only the marked word: the line may be huge.
  const syntax::Span span = located.finding.span;
  const syntax::ParsedLine parsed(line_text.substr(span.begin, span.end - span.begin));
  const LineTree word = parsed.tree();
  if (is_label) return Wanted{.note = kFirstLabel, .is_label = true, .label = word.label};
  if (word.instructions.empty()) return std::nullopt;
  return Wanted{.note = kSet, .code_row = word.instructions.front().row};
}

/// The line above the one that starts at `begin`; `begin` must not be the start of the text.
std::string_view line_above(std::string_view text, std::size_t begin) {
  std::size_t end = begin - 1;
  if (end > 0 && text[end] == '\n' && text[end - 1] == '\r') --end;
  std::size_t start = end;
  while (start > 0 && !text::is_line_end(text[start - 1])) --start;
  return text.substr(start, end - start);
}

}  // namespace

std::optional<RelatedPlace> RelatedPlaces::of(const check::LocatedFinding& located, std::string_view line_text) {
  const std::optional<Wanted> wanted = wanted_by(located, line_text);
  if (!wanted) return std::nullopt;
  syntax::TreeStore store;
  std::string_view line = line_text;
  const std::size_t reach = std::min(kReach, bytes_left_);
  std::size_t walked = 0;
  std::optional<RelatedPlace> place;
  for (std::size_t number = located.line; number > 0 && walked < reach; --number) {
    line = line_above(text_, static_cast<std::size_t>(line.data() - text_.data()));
    walked += line.size() + 1;
    store.clear();
    store.append_line(line.data(), line.data() + line.size());
    const LineTree tree = store.tree(0, line.data());
    if (const Word* word = wanted->on(tree)) {
      place = {number - 1, line, word->span(), wanted->note};
      break;
    }
  }
  bytes_left_ -= std::min(bytes_left_, walked);
  return place;
}

std::vector<RunPlace> run_places(const check::LocatedFinding& located, dialect::Language language) {
  static constexpr dialect::Text kLasts = {"it lasts until here", "dura fino a qui"};
  static constexpr dialect::Text kUnknown = {"up to here it is not known where the machine is",
                                             "fin qui non si sa dove sia la macchina"};
  static constexpr dialect::Text kDeepest = {"it is deepest here", "qui è più profondo"};
  static constexpr dialect::Text kNearest = {"it is nearest here", "qui è più vicino"};
  static constexpr dialect::Text kCutLast = {"what is met was last cut here",
                                             "ciò che si incontra è stato tagliato per ultimo qui"};
  static constexpr dialect::Text kStopped = {"the spindle was stopped here", "il mandrino è stato fermato qui"};
  static constexpr dialect::Text kDescribed = {"{} is described here", "{} è descritto qui"};
  std::vector<RunPlace> places;
  if (located.last_line) {
    const dialect::Text& note = located.finding.id == "not-verified"_diag ? kUnknown : kLasts;
    places.push_back({.file = {}, .line = *located.last_line + 1, .note = std::string(note.in(language))});
  }
  if (located.worst_line) {
    const dialect::Text& note = located.finding.id == "near-miss"_diag ? kNearest : kDeepest;
    places.push_back({.file = {}, .line = *located.worst_line + 1, .note = std::string(note.in(language))});
  }
  if (located.shaped_by) {
    const dialect::Text& note = located.finding.id == "cuts-with-spindle-stopped"_diag ? kStopped : kCutLast;
    places.push_back({.file = {}, .line = *located.shaped_by + 1, .note = std::string(note.in(language))});
  }
  if (const dialect::GivenPlace described = located.finding.described) {
    const dialect::FilePlace& place = described.place();
    places.push_back({.file = place.file,
                      .line = place.line + 1,
                      .column = place.column + 1,
                      .note = dialect::format(kDescribed, language, located.finding.names.back().in(language))});
  }
  return places;
}

}  // namespace isocnc::formats
