#include "hunt.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/selection/shown_report.h"

namespace isocnc::slips {

using check::LocatedFinding;
using support::Random;

static check::Report report_of(const std::string& text) {
  static const selection::Selection selection;
  return selection::shown_report(check::check_text(text, {}, 1), text, selection);
}

static std::string code_of(const LocatedFinding& located) {
  return std::string(dialect::definition(located.finding.id).code);
}

std::vector<std::string> codes_in(const std::string& text) {
  std::vector<std::string> codes;
  for (const LocatedFinding& located : report_of(text).findings) codes.push_back(code_of(located));
  return codes;
}

std::string Catch::code_set() const {
  std::string text;
  for (const std::string& code : std::set<std::string>(codes.begin(), codes.end()))
    text += (text.empty() ? "" : " ") + code;
  return text;
}

Hunt::Hunt() : sources_(correct_programs()) {}

const Catch& Hunt::make(std::uint64_t seed) {
  Random random(seed);
  for (;;) {
    const ProgramSource& source = sources_[random.below(sources_.size())];
    const CorrectProgram& program = source.programs[random.below(source.programs.size())];
    const SlipKind& kind = slip_kinds()[random.below(slip_kinds().size())];
    std::optional<Slip> slip;
    for (int tries = 0; tries < 20 && !slip; ++tries) slip = kind.make(program.lines, random);
    if (!slip) continue;
    last_ = {.seed = seed,
             .source = source.name,
             .program = program.name,
             .kind = kind.name,
             .correct = program.lines,
             .slip = std::move(*slip),
             .codes = {}};
    last_.codes = codes_in(joined(slipped(last_.correct, last_.slip)));
    count(last_);
    return last_;
  }
}

void Hunt::count(const Catch& caught) {
  ++made_;
  auto& [made, with_several] = kinds_[std::string(caught.kind)];
  ++made;
  if (!caught.has_several()) return;
  ++with_several;
  ++with_several_;
  Shape& shape = shapes_[{std::string(caught.kind), caught.code_set()}];
  if (++shape.count == 1 || caught.correct.size() < shape.smallest.correct.size()) shape.smallest = caught;
}

/// The slip without one line of the program that it does not touch.
static Catch without_line(const Catch& caught, std::size_t line) {
  Catch less = caught;
  less.correct.erase(less.correct.begin() + static_cast<std::ptrdiff_t>(line));
  if (line < less.slip.first) --less.slip.first;
  return less;
}

Catch reduced(Catch caught) {
  for (bool is_less = true; is_less;) {
    is_less = false;
    for (std::size_t line = caught.correct.size(); line-- > 0;) {
      if (line >= caught.slip.first && line < caught.slip.first + caught.slip.removed) continue;
      Catch less = without_line(caught, line);
      if (!codes_in(joined(less.correct)).empty()) continue;
      if (codes_in(joined(slipped(less.correct, less.slip))) != caught.codes) continue;
      caught = std::move(less);
      is_less = true;
    }
  }
  return caught;
}

std::string shown(const Catch& caught) {
  std::string text = fmt::format("seed {}, {}: {} in {}\n", caught.seed, caught.kind, caught.source, caught.program);
  const Slip& slip = caught.slip;
  for (std::size_t i = 0; i < slip.removed; ++i) text += "  - " + caught.correct[slip.first + i] + '\n';
  const Lines lines = slipped(caught.correct, slip);
  const check::Report report = report_of(joined(lines));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool is_new = i >= slip.first && i < slip.first + slip.inserted.size();
    text += (is_new ? "  + " : "    ") + lines[i] + '\n';
    for (const LocatedFinding& located : report.findings) {
      if (located.line != i) continue;
      const syntax::Span span = located.finding.span;
      text += fmt::format("        {} at {}\n", code_of(located), lines[i].substr(span.begin, span.end - span.begin));
    }
  }
  return text;
}

}  // namespace isocnc::slips
