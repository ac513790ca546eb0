#include <algorithm>
#include <limits>
#include <optional>

#include "analyzer/fixes/line_edits.h"
#include "interpreter/dialect/any_case.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::fixes {

using namespace dialect::literals;
using syntax::Instruction;
using syntax::LineTree;
using syntax::Span;
using syntax::Word;

/// Whether the text holds a comment, such as `X(left)10`, which must not be lost.
static bool holds_comment(std::string_view text) { return text.find('(') != std::string_view::npos; }

Draft removed_mark(const FixRequest& request) {
  if (holds_comment(request.marked())) return {};
  return {{removed_with_line(request, request.finding.span)}};
}

/// Whether all other words keep their commands when the marked word is removed. In G01 G27 X5 the X would not.
static bool keeps_other_words(const FixRequest& request) {
  const Word* const marked = word_at(request.line, request.finding.span);
  if (marked && lacks_frame_arguments(request.line, *marked)) return false;
  const LineTree& before = request.line;
  std::string text(before.text);
  text.replace(request.finding.span.begin, request.finding.span.end - request.finding.span.begin, " ");
  const syntax::ParsedLine parsed(text);
  const LineTree after = parsed.tree();
  const auto command_of = [](const LineTree& line, const Word& word) -> const Word* {
    const Instruction* const owner = owner_of(line, word);
    return owner ? &line.command(*owner) : nullptr;
  };
  const auto same = [](const Word* a, const Word* b) {
    return (a == nullptr) == (b == nullptr) &&
           (a == nullptr || (a->letter == b->letter && (a->value == b->value || (!a->known() && !b->known()))));
  };
  std::size_t next = 0;
  for (const Word& word : before.words) {
    if (word.span() == request.finding.span) continue;
    if (next == after.words.size()) return false;
    const Word& there = after.words[next++];
    const bool is_the_same = same(&word, &there) && word.has(Word::kBreak) == there.has(Word::kBreak) &&
                             same(command_of(before, word), command_of(after, there));
    if (!is_the_same) return false;
  }
  return next == after.words.size();
}

/// A word without effect on one path may be needed on another.
Draft removed_on_every_path(const FixRequest& request) {
  return request.on_every_path && keeps_other_words(request) ? removed_mark(request) : Draft{};
}

/// The word that the marked one repeats.
static Span first_of_two(const FixRequest& request) {
  if (!request.finding.related.empty()) return request.finding.related;
  const Word* const marked = word_at(request.line, request.finding.span);
  if (!marked) return {};
  const auto is_first = [&](const Word& word) { return word.letter == marked->letter && word.owner == marked->owner; };
  const auto first = std::find_if(request.line.words.begin(), request.line.words.end(), is_first);
  return first->begin < marked->begin ? first->span() : Span{};
}

static double value_of(std::string_view word) {
  const syntax::ParsedLine parsed(word);
  const LineTree tree = parsed.tree();
  return tree.words.size() == 1 ? tree.words.front().value : std::numeric_limits<double>::quiet_NaN();
}

/// The same word again: X10 X10.0. If the values differ, the intended one is unknown.
Draft removed_repetition(const FixRequest& request) {
  const Span first = first_of_two(request);
  if (first.empty() || !(value_of(request.line.text_of(first)) == value_of(request.marked()))) return {};
  return removed_mark(request);
}

/// G90 G91: the first has no effect, unless an instruction between them uses it. No G between them does: a motion would
/// keep the rule from reporting the first (D14), and a dwell, a frame or an unknown G is an error on such a line.
Draft removed_earlier_mode(const FixRequest& request) {
  const Span earlier = request.finding.related;
  const auto matters = [&](const Word& word) {
    if (word.begin <= earlier.begin || word.begin >= request.finding.span.begin) return false;
    const Instruction* const owner = owner_of(request.line, word);
    return owner != nullptr && owner->kind != syntax::InstructionKind::G;
  };
  if (earlier.empty() || holds_comment(request.line.text_of(earlier))) return {};
  if (std::any_of(request.line.words.begin(), request.line.words.end(), matters)) return {};
  return {{removed(request, earlier)}, std::string(request.line.text_of(earlier))};
}

/// `%`, which encloses programs of other controls.
Draft removed_foreign_frame(const FixRequest& request) {
  const bool is_percent = request.marked().find_first_not_of('%') == std::string_view::npos;
  return is_percent && request.line.words.size() == 1 ? removed_mark(request) : Draft{};
}

/// G80 ends canned cycles, which this control does not have.
Draft removed_canned_cycle_end(const FixRequest& request) {
  const Word* const word = word_at(request.line, request.finding.span);
  return word && word->value == 80 && word->is_plain_integer() ? removed_mark(request) : Draft{};
}

/// K0 in G17: the circle is given without it.
Draft removed_stray_center(const FixRequest& request) {
  const Word* const stray = word_at(request.line, request.finding.span);
  if (!stray) return {};
  dialect::LetterSet given = 0;
  for (const Word& word : request.line.words)
    if (word.owner == stray->owner && word.letter >= 'A' && word.letter <= 'Z')
      given |= dialect::letter_bit(word.letter);
  const dialect::LetterSet others = dialect::kCenterLetters & ~dialect::letter_bit(stray->letter);
  const bool is_complete = (given & others) == others || dialect::contains(given, 'R');
  return is_complete ? removed_mark(request) : Draft{};
}

/// G00 G01 X10: the first G moves nothing.
Draft removed_first_motion(const FixRequest& request) {
  const Span first = request.finding.related;
  const Word* const word = first.empty() ? nullptr : word_at(request.line, first);
  const Instruction* const motion = word ? owner_of(request.line, *word) : nullptr;
  if (!motion || motion->end != motion->command + 1 || holds_comment(request.line.text_of(first))) return {};
  return {{removed(request, first)}, std::string(request.line.text_of(first))};
}

static bool is_one_of(std::string_view word, std::initializer_list<std::string_view> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view name) { return dialect::equal_words(word, name); });
}

static bool names_w190(std::string_view line) {
  const dialect::DiagnosticDef& def = dialect::definition("useless-suppression"_diag);
  std::string upper(line);
  std::transform(upper.begin(), upper.end(), upper.begin(), text::upper);
  std::string name(def.name);
  std::transform(name.begin(), name.end(), name.begin(), text::upper);
  return upper.find(def.code) != std::string::npos || upper.find(name) != std::string::npos;
}

/// `isolint: ignore ISO003`, or one of its codes. A misspelled verb or code had a purpose, so it stays.
Draft removed_suppression(const FixRequest& request) {
  static constexpr std::string_view kCall = "isolint:";
  const std::string_view line = request.line.text;
  const Span span = request.finding.span;
  const std::string_view text = request.marked();
  const bool is_whole = text.size() > kCall.size() && dialect::begins_with(text, kCall);
  if (!is_whole) {
    // Without its last code, the comment would suppress all findings. Single codes are reported if the comment also has
    // a useful code, an unknown one, or W190.
    const std::optional<dialect::DiagnosticId> code = dialect::find_diagnostic(text);
    if (!code || names_w190(line)) return {};
    const bool has_comma = span.end < line.size() && line[span.end] == ',';
    return {{removed(request, {span.begin, span.end + (has_comma ? 1u : 0u)})}};
  }
  const std::string_view words = text::trimmed(text.substr(kCall.size()));
  const std::string_view verb = words.substr(0, words.find_first_of(" \t,"));
  if (!is_one_of(verb, {"ignore", "disable", "enable", "ignore-file"})) return {};
  const auto holds = [&](Span comment) { return comment.holds(span.begin); };
  const auto comment = std::find_if(request.line.comments.begin(), request.line.comments.end(), holds);
  if (comment == request.line.comments.end()) return {};
  const bool is_closed = line[comment->end - 1] == ')';
  const std::string_view before = text::trimmed(line.substr(comment->begin + 1, span.begin - comment->begin - 1));
  const std::string_view after = text::trimmed(line.substr(span.end, comment->end - (is_closed ? 1 : 0) - span.end));
  const bool is_all = before.empty() && (after.empty() || after.front() == '-');
  return {{is_all ? removed_with_line(request, *comment) : removed(request, span)}};
}

}  // namespace isocnc::fixes
