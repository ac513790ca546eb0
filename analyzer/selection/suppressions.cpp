#include "analyzer/selection/suppressions.h"

#include <algorithm>
#include <cstring>

#include "interpreter/dialect/any_case.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::selection {

using dialect::DiagnosticId;
using namespace dialect::literals;

static constexpr std::string_view kCall = "isolint:";
static constexpr DiagnosticId kUseless = "useless-suppression"_diag;

/// The position of the next `isolint:` from `at` on. Colons are rare in programs, so searching for them is fast.
static std::size_t find_call(std::string_view text, std::size_t at) {
  for (std::size_t colon = text.find(':', at); colon != std::string_view::npos; colon = text.find(':', colon + 1)) {
    if (colon + 1 < at + kCall.size()) continue;
    const std::size_t begin = colon + 1 - kCall.size();
    if (dialect::begins_with(text.substr(begin), kCall)) return begin;
  }
  return std::string_view::npos;
}

Suppressions::Suppressions(std::string_view text) {
  const char* const end = text.data() + text.size();
  const char* line = text.data();
  std::size_t number = 0;
  for (std::size_t call = find_call(text, 0); call != std::string_view::npos;) {
    const char* line_end = text::find_line_end(line, end);
    while (line_end < text.data() + call) {
      line = text::skip_line_end(line_end, end);
      line_end = text::find_line_end(line, end);
      ++number;
    }
    read_line(number, {line, static_cast<std::size_t>(line_end - line)});
    call = find_call(text, static_cast<std::size_t>(line_end - text.data()));
  }
}

bool Suppressions::may_have_directives(std::string_view text) { return find_call(text, 0) != std::string_view::npos; }

void Suppressions::read_line(std::size_t number, std::string_view line) {
  if (find_call(line, 0) == std::string_view::npos) return;
  const syntax::ParsedLine parsed(line);
  const syntax::LineTree tree = parsed.tree();
  std::vector<syntax::Span> comments(tree.comments.begin(), tree.comments.end());
  std::sort(comments.begin(), comments.end());
  for (const syntax::Span comment : comments) {
    const std::string_view text = line.substr(0, comment.end);
    for (std::size_t call = find_call(text, comment.begin); call != std::string_view::npos;) {
      const std::size_t next = find_call(text, call + 1);
      read_directive(number, line, static_cast<std::uint32_t>(call),
                     static_cast<std::uint32_t>(std::min(next, text.size())));
      call = next;
    }
  }
}

/// The next word in [begin, end) of the line, between blanks, commas and parentheses; empty at the end.
static syntax::Span next_word(std::string_view line, std::uint32_t begin, std::uint32_t end) {
  const auto separates = [](char c) { return text::is_blank(c) || c == ','; };
  while (begin < end && separates(line[begin])) ++begin;
  std::uint32_t after = begin;
  while (after < end && !separates(line[after]) && line[after] != '(' && line[after] != ')') ++after;
  return {begin, after};
}

void Suppressions::read_directive(std::size_t number, std::string_view line, std::uint32_t begin, std::uint32_t end) {
  const auto text_of = [&](syntax::Span span) { return line.substr(span.begin, span.end - span.begin); };
  static constexpr std::pair<std::string_view, Kind> kKinds[] = {{"ignore", Kind::Ignore},
                                                                 {"disable", Kind::Disable},
                                                                 {"enable", Kind::Enable},
                                                                 {"ignore-file", Kind::IgnoreFile}};
  const std::uint32_t after_call = begin + static_cast<std::uint32_t>(kCall.size());
  const syntax::Span verb = next_word(line, after_call, end);
  Directive directive{.line = number, .span = {begin, std::max(verb.end, after_call)}};
  if (verb.empty()) directive.span = {begin, after_call};
  for (const auto& [name, kind] : kKinds)
    if (dialect::equal_words(text_of(verb), name)) directive.kind = kind;
  if (directive.kind != Kind::Unknown) {
    for (syntax::Span word = next_word(line, verb.end, end); !word.empty(); word = next_word(line, word.end, end)) {
      if (line[word.begin] == '-') break;  // A reason follows.
      directive.codes.push_back({.id = dialect::find_diagnostic(text_of(word)), .span = word});
      directive.span.end = word.end;
    }
  }
  directives_.push_back(std::move(directive));
}

/// The directive with the narrowest scope suppresses a finding; of several with the same scope, the first.
void Suppressions::apply_disable(Directive& directive, SuppressedBy& suppressors) {
  if (directive.codes.empty()) {
    for (std::size_t i = 0; i < suppressors.size(); ++i)
      if (!suppressors[i] && (DiagnosticId{static_cast<std::uint8_t>(i)} != kUseless))
        suppressors[i] = &directive.useful;
    // A directive for the whole program also suppresses W190; other directives must not suppress the W190 on
    // themselves.
    bool*& useless = suppressors[static_cast<std::size_t>(kUseless)];
    if (directive.kind == Kind::IgnoreFile && !useless) useless = &directive.useful;
  }
  for (Code& code : directive.codes) {
    if (!code.id) continue;
    bool*& suppressor = suppressors[static_cast<std::size_t>(*code.id)];
    if (!suppressor) suppressor = &code.useful;
  }
}

void Suppressions::apply_enable(Directive& directive, SuppressedBy& suppressors) {
  if (directive.codes.empty()) {
    directive.useful =
        std::any_of(suppressors.begin(), suppressors.end(), [](const bool* each) { return each != nullptr; });
    suppressors.fill(nullptr);
  }
  for (Code& code : directive.codes) {
    if (!code.id) continue;
    bool*& suppressor = suppressors[static_cast<std::size_t>(*code.id)];
    code.useful = code.useful || suppressor != nullptr;
    suppressor = nullptr;
  }
}

void Suppressions::drop_suppressed(std::vector<check::LocatedFinding>& findings) {
  SuppressedBy of_file{};
  SuppressedBy of_stretch{};
  SuppressedBy of_line{};
  for (Directive& directive : directives_)
    if (directive.kind == Kind::IgnoreFile) apply_disable(directive, of_file);
  auto next = directives_.begin();
  std::size_t line_of_ignores = 0;
  const auto read_up_to = [&](std::size_t line) {
    for (; next != directives_.end() && next->line <= line; ++next) {
      if (next->kind == Kind::Disable) apply_disable(*next, of_stretch);
      if (next->kind == Kind::Enable) apply_enable(*next, of_stretch);
      if (next->kind != Kind::Ignore) continue;
      if (next->line != line_of_ignores) of_line.fill(nullptr);
      line_of_ignores = next->line;
      apply_disable(*next, of_line);
    }
  };
  std::erase_if(findings, [&](const check::LocatedFinding& located) {
    read_up_to(located.line);
    const auto id = static_cast<std::size_t>(located.finding.id);
    bool* const ignored = located.line == line_of_ignores ? of_line[id] : nullptr;
    bool* const suppressor = ignored ? ignored : of_stretch[id] ? of_stretch[id] : of_file[id];
    if (suppressor) *suppressor = true;
    return suppressor != nullptr;
  });
  if (!directives_.empty()) read_up_to(directives_.back().line);
}

void Suppressions::keep_directives_for_unchecked_codes(const Selection& selection, const LookedFor& by_run) {
  const auto is_looked_for = [&](DiagnosticId id, const Directive& directive) {
    if (!selection.shows(id)) return false;
    if (!dialect::definition(id).is_reported_by_runs()) return true;
    return by_run && by_run(id, directive.kind == Kind::Ignore ? std::optional(directive.line) : std::nullopt);
  };
  for (Directive& directive : directives_)
    for (Code& code : directive.codes) code.useful = code.useful || (code.id && !is_looked_for(*code.id, directive));
}

/// Directives without effect, except those that may suppress W190; with `about_w190` only these, after all others have
/// been judged.
std::vector<check::LocatedFinding> Suppressions::useless(bool about_w190) const {
  std::vector<check::LocatedFinding> findings;
  const auto report = [&](std::size_t line, syntax::Span span) {
    findings.push_back({.line = line, .finding = {.id = kUseless, .span = span}});
  };
  for (const Directive& directive : directives_) {
    const auto is_useless = [](const Code& code) { return !code.useful; };
    const bool suppresses_w190 = directive.codes.empty()
                                     ? directive.kind == Kind::IgnoreFile
                                     : std::any_of(directive.codes.begin(), directive.codes.end(),
                                                   [](const Code& code) { return code.id == kUseless; });
    const bool all_known = std::all_of(directive.codes.begin(), directive.codes.end(),
                                       [](const Code& code) { return code.id.has_value(); });
    const bool whole = !directive.useful && all_known && (!suppresses_w190 || directive.codes.size() <= 1) &&
                       std::all_of(directive.codes.begin(), directive.codes.end(), is_useless);
    if (whole) {
      if (suppresses_w190 == about_w190) report(directive.line, directive.span);
      continue;
    }
    for (const Code& code : directive.codes)
      if (is_useless(code) && (code.id == kUseless) == about_w190) report(directive.line, code.span);
  }
  return findings;
}

check::Report Suppressions::apply(check::Report report, const Selection& selection, const LookedFor& by_run) {
  if (empty()) return report;
  drop_suppressed(report.findings);
  keep_directives_for_unchecked_codes(selection, by_run);
  std::vector<check::LocatedFinding> complaints = useless(false);
  drop_suppressed(complaints);
  const auto middle = static_cast<std::ptrdiff_t>(report.findings.size());
  for (const std::vector<check::LocatedFinding>& each : {complaints, useless(true)})
    report.findings.insert(report.findings.end(), each.begin(), each.end());
  const auto by_place = [](const check::LocatedFinding& a, const check::LocatedFinding& b) {
    return a.line != b.line ? a.line < b.line : a.finding.span.begin < b.finding.span.begin;
  };
  std::stable_sort(report.findings.begin() + middle, report.findings.end(), by_place);
  std::inplace_merge(report.findings.begin(), report.findings.begin() + middle, report.findings.end(), by_place);
  return report;
}

check::Report suppress(check::Report report, std::string_view text, const Selection& selection) {
  return Suppressions(text).apply(std::move(report), selection);
}

}  // namespace isocnc::selection
