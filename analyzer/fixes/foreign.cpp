#include <algorithm>
#include <string>

#include "analyzer/fixes/habits.h"
#include "analyzer/fixes/line_edits.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::fixes {

using namespace dialect::literals;
using dialect::ForeignForm;
using syntax::Span;
using syntax::Word;

static const ForeignForm* form_of(const FixRequest& request) {
  return syntax::foreign_form(request.finding, request.line.text);
}

/// Whether a word after an unknown G gives its data: G43 H1, G64 P0.01, G05.1 Q1.
static bool is_data_of(const FixRequest& request, const Word& g, const Word& word) {
  if (word.letter == syntax::kError)
    return dialect::contains(dialect::letters("DHL"), text::upper(request.line.text[word.begin]));
  return word.owner == g.owner && dialect::contains(dialect::letters("PQ"), word.letter);
}

/// Removes a word of other controls with its data.
static Draft removed_with_data(const FixRequest& request) {
  const Word* const marked = word_at(request.line, request.finding.span);
  Span span = request.finding.span;
  std::vector<Edit> apart;
  if (marked && marked->letter == 'G') {
    const Word* const end = request.line.words.data() + request.line.words.size();
    const Word* next = marked + 1;
    for (; next != end && is_data_of(request, *marked, *next); ++next) span.end = next->end;
    for (; next != end; ++next)  // G43 Z50 H1
      if (is_data_of(request, *marked, *next)) apart.push_back(removed(request, next->span()));
  }
  Draft draft{{removed_with_line(request, span)}};
  draft.edits.insert(draft.edits.end(), apart.begin(), apart.end());
  return draft;
}

/// Whether a number of a program (O1204) is below other lines: one of a subprogram, which must not run into the program
/// above it.
static bool is_number_of_subprogram(const FixRequest& request) {
  constexpr std::size_t kLongestHead = 100;
  if (text::upper(request.marked().front()) != 'O' && request.marked().front() != ':') return false;
  if (request.number > kLongestHead) return true;
  for (std::size_t number = 0; number < request.number; ++number) {
    const syntax::ParsedLine parsed(request.program.text(number));
    if (!parsed.tree().is_empty()) return true;
  }
  return false;
}

/// D1, G64 P0.01, G69: what they ask for always holds here, or there is nothing to end. The G70 of %4711 G70 counts.
Draft removed_foreign_word(const FixRequest& request) {
  const ForeignForm* const form = form_of(request);
  if (!form || !form->is_superfluous || is_number_of_subprogram(request)) return {};
  if (form->is_statement && request.marked().find("G70") != std::string_view::npos) return {};
  Draft draft = removed_with_data(request);
  const auto holds_comment = [&](const Edit& edit) {  // X(a)1; the data of CYCLE832(...) are no comment.
    const Span span{static_cast<std::uint32_t>(edit.begin.column), static_cast<std::uint32_t>(edit.end.column)};
    return edit.begin.line == edit.end.line && request.line.text_of(span).find('(') != std::string_view::npos;
  };
  if (!form->is_statement && std::any_of(draft.edits.begin(), draft.edits.end(), holds_comment)) return {};
  return draft;
}

/// The * at the end of a block, and G97, which makes S what it always is here.
Draft removed_certainly_superfluous(const FixRequest& request) {
  const Word* const marked = word_at(request.line, request.finding.span);
  const bool is_block_end =
      request.marked() == "*" && marked + 1 == request.line.words.data() + request.line.words.size();
  const bool is_revolutions = marked && marked->letter == 'G' && marked->is_plain_integer() && marked->value == 97;
  return marked && (is_block_end || is_revolutions) ? removed_mark(request) : Draft{};
}

/// G17 G49 G80: G49 ends the tool length compensation there, as another G of the line shows that only those controls
/// have.
Draft removed_length_cancel(const FixRequest& request) {
  const auto is_foreign = [&](const syntax::Finding& finding) {
    return finding.id == "unsupported-g"_diag && syntax::foreign_form(finding, request.line.text) != nullptr;
  };
  const auto& findings = request.line.findings;
  const bool is_form = form_of(request) != nullptr;
  return is_form && std::any_of(findings.begin(), findings.end(), is_foreign) ? removed_mark(request) : Draft{};
}

/// MSG("TOP FACE") becomes (TOP FACE).
Draft message_as_comment(const FixRequest& request) {
  const std::string_view text = request.marked();
  const std::size_t open = text.find("(\"");
  const bool is_message = text.size() > 3 && text::upper(text[0]) == 'M' && text::upper(text[1]) == 'S' &&
                          text::upper(text[2]) == 'G' && open != std::string_view::npos && text.ends_with("\")");
  if (!is_message || open + 2 > text.size() - 2) return {};
  const std::string_view message = text.substr(open + 2, text.size() - 2 - (open + 2));
  if (message.find_first_of("()\"") != std::string_view::npos) return {};
  std::string comment = "(" + std::string(message) + ")";
  return {{replaced(request, request.finding.span, comment)}, comment};
}

/// CR=5, the radius of an arc of half a turn at most, as R5 is.
Draft radius_of_arc(const FixRequest& request) {
  const std::string_view line = request.line.text;
  const Word* const c = word_at(request.line, request.finding.span);
  const Word* const end = request.line.words.data() + request.line.words.size();
  if (!c || c->letter != 'C' || end - c < 3 || c[1].letter != 'R' || c[2].letter != syntax::kAssign) return {};
  if (!(c[2].value > 0) || line.substr(c->begin, c[2].end - c->begin).find('(') != std::string_view::npos) return {};
  std::string radius = "R" + std::string(text::trimmed(line.substr(c[2].begin + 1, c[2].end - c[2].begin - 1)));
  return {{replaced(request, {c->begin, c[2].end}, radius)}, radius};
}

}  // namespace isocnc::fixes
