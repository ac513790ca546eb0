#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/check/folding.h"
#include "analyzer/formats/rendering.h"
#include "analyzer/selection/run_report.h"
#include "analyzer/selection/style_findings.h"
#include "analyzer/selection/suppressions.h"
#include "analyzer/selection/verified.h"
#include "golden_program.h"
#include "interpreter/running/runner.h"
#include "interpreter/syntax/line_finder.h"
#include "tests/support/report_text.h"

namespace isocnc::golden {
namespace {

/// A finding as a golden file would mark it, with the line's text, so that a difference can be read.
std::string shown(const ExpectedFinding& finding, const std::string& line) {
  const std::string repeats =
      finding.repeats == 0 ? "" : fmt::format(" and {} more, to {}", finding.repeats, finding.last_line);
  return fmt::format("\n  {} at {}-{} of line {}{}: {}\n", finding.code, finding.begin, finding.end, finding.line + 1,
                     repeats, line);
}

std::string line_of(const std::string& program, std::size_t index) {
  return std::string(syntax::LineFinder(program).line(index));
}

/// What isolint would report; in most parts before it is folded, so that each line shows what is judged.
check::Report reported_in(const Part& part) {
  selection::Selection selection;
  EXPECT_THAT(selection.follow({.severities = part.selected}, dialect::Language::English), testing::IsEmpty());
  rules::CheckSetup setup{.machine = part.setup};
  setup.every_motion = !part.selected.empty();
  if (part.is_run) {
    const verification::VerifiedRun run = selection::verified_on_paths(
        part.program, {.setup = part.setup, .vgpl = part.vgpl}, part.machine, part.scene ? &*part.scene : nullptr);
    return selection::shown_report_with_run(check::check_text(part.program, setup), run.outcome, part.program,
                                            selection);
  }
  check::Report report = selection::with_style(check::check_text(part.program, setup), part.program, selection);
  report = selection.shown(selection::suppress(std::move(report), part.program, selection));
  return part.is_folded ? check::folded(std::move(report)) : report;
}

std::vector<std::string> found_in(const Part& part, const check::Report& report) {
  std::vector<std::string> found;
  for (const check::LocatedFinding& located : report.findings) {
    if (!part.is_about_rules && support::is_lint(dialect::definition(located.finding.id).code)) continue;
    const std::string line = line_of(part.program, located.line);
    const syntax::Span span = located.finding.span;
    const std::span<const check::Repetition> repeated = report.repetitions_of(located);
    found.push_back(shown({.line = located.line,
                           .begin = text::column_of(line, span.begin) - 1,
                           .end = text::column_of(line, span.end) - 1,
                           .code = std::string(dialect::definition(located.finding.id).code),
                           .repeats = repeated.size(),
                           .last_line = repeated.empty() ? 0 : repeated.back().line + 1},
                          line));
  }
  return found;
}

/// What is in `a` and not in `b`, as one text.
std::string difference(std::vector<std::string> a, std::vector<std::string> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::vector<std::string> only_a;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only_a));
  std::string text;
  for (const std::string& each : only_a) text += each;
  return text;
}

void expect_findings(const Part& part, const check::Report& report) {
  std::vector<std::string> expected;
  for (const ExpectedFinding& finding : part.findings) {
    ExpectedFinding without_path = finding;
    without_path.via.clear();
    expected.push_back(shown(without_path, line_of(part.program, finding.line)));
  }
  const std::vector<std::string> found = found_in(part, report);
  EXPECT_EQ(difference(expected, found), "") << "missing in " << part.name;
  EXPECT_EQ(difference(found, expected), "") << "not marked in " << part.name;
}

std::string_view cause_of(const syntax::Finding& finding) {
  return finding.cause == 0 ? "usual" : dialect::definition(finding.id).causes[finding.cause - 1].cause;
}

void expect_causes(const Part& part, const check::Report& report) {
  for (const ExpectedFinding& finding : part.findings) {
    if (finding.cause.empty()) continue;
    for (const check::LocatedFinding& located : report.findings)
      if (located.line == finding.line && dialect::definition(located.finding.id).code == finding.code &&
          text::column_of(line_of(part.program, located.line), located.finding.span.begin) - 1 == finding.begin) {
        EXPECT_EQ(cause_of(located.finding), finding.cause) << part.name << " line " << finding.line + 1;
      }
  }
}

/// The jumps that lead to findings.
void expect_paths(const Part& part, const check::Report& report) {
  for (const ExpectedFinding& finding : part.findings) {
    if (finding.via.empty()) continue;
    bool named = false;
    for (const check::LocatedFinding& located : report.findings) {
      if (located.line != finding.line || dialect::definition(located.finding.id).code != finding.code) continue;
      ASSERT_GE(located.path, 0) << part.name << " line " << finding.line + 1 << ": no path";
      std::vector<std::size_t> lines;
      for (const check::PathStep& step : report.paths[static_cast<std::size_t>(located.path)])
        lines.push_back(step.line + 1);
      EXPECT_THAT(lines, testing::IsSupersetOf(finding.via)) << part.name;
      named = true;
    }
    EXPECT_TRUE(named) << part.name;
  }
}

class Golden : public testing::TestWithParam<std::filesystem::path> {};

/// One test, since the report takes the time.
TEST_P(Golden, FindsWhatIsMarkedAndNothingElse) {
  for (const Part& part : read_golden(GetParam())) {
    const check::Report report = reported_in(part);
    expect_findings(part, report);
    expect_causes(part, report);
    expect_paths(part, report);
  }
}

void expect_axes(const std::map<char, double>& expected, const geometry::Vec3& tip, double b, double c,
                 const std::string& where) {
  for (const auto& [axis, value] : expected) {
    const double found = axis == 'B' ? b : axis == 'C' ? c : tip[axis - 'X'];
    EXPECT_NEAR(found, value, 1e-6) << where << " axis " << axis;
  }
}

void expect_effect(const ExpectedEffect& expected, const running::Event& event, const std::string& name) {
  const std::string where =
      fmt::format("{} line {}: {} (found {})", name, expected.line + 1, expected.text, running::to_json(event));
  EXPECT_EQ(running::kind_of(event), expected.kind) << where;
  const auto* const move = std::get_if<running::MoveEvent>(&event.what);
  if (!move) return;
  expect_axes(expected.to, move->to.tip, move->to.b, move->to.c, where);
  expect_axes(expected.center, move->center, 0, 0, where + " center");
  EXPECT_NEAR(move->length, expected.length.value_or(move->length), 1e-5) << where;
  EXPECT_NEAR(move->radius, expected.radius.value_or(move->radius), 1e-6) << where;
  EXPECT_NEAR(move->sweep_deg, expected.sweep.value_or(move->sweep_deg), 1e-6) << where;
}

TEST_P(Golden, DoesWhatIsSaid) {
  for (const Part& part : read_golden(GetParam())) {
    if (part.effects.empty()) continue;
    std::map<std::size_t, std::vector<running::Event>> events;
    running::RunOptions options{.setup = part.setup, .vgpl = part.vgpl, .stop_at_errors = false};
    running::run(part.program, options, [&](const running::Event& event) { events[event.line].push_back(event); });
    for (auto effect = part.effects.begin(); effect != part.effects.end();) {
      const auto line_end =
          std::find_if(effect, part.effects.end(), [&](const auto& e) { return e.line != effect->line; });
      std::vector<running::Event> same_kinds;
      for (const running::Event& event : events[effect->line])
        if (std::any_of(effect, line_end, [&](const auto& e) { return e.kind == running::kind_of(event); }))
          same_kinds.push_back(event);
      EXPECT_EQ(same_kinds.size(), static_cast<std::size_t>(line_end - effect))
          << part.name << " line " << effect->line + 1;
      for (const running::Event& event : same_kinds)
        if (effect != line_end) expect_effect(*effect++, event, part.name);
      effect = line_end;
    }
  }
}

std::string test_name(const testing::TestParamInfo<std::filesystem::path>& info) {
  std::string name = info.param.parent_path().filename().string() + "_" + info.param.stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Programs, Golden, testing::ValuesIn(golden_files()), test_name);

/// Each code has at least two positives among the golden programs, and shows its near miss in the file named after it.
TEST(GoldenCoverage, EveryCodeIsShown) {
  std::map<std::string, int> shown_codes;
  for (const auto& file : golden_files())
    for (const Part& part : read_golden(file))
      for (const ExpectedFinding& finding : part.findings) ++shown_codes[finding.code];
  for (const dialect::DiagnosticDef& def : dialect::kDiagnostics) {
    if (def.code.starts_with("W1") && !def.is_reported_by_runs()) continue;
    EXPECT_GE(shown_codes[std::string(def.code)], 2) << def.code << " has too few positives";
    EXPECT_TRUE(std::filesystem::exists(fmt::format("{}/tests/programs/{}/{}.iso", ISOCNC_SOURCE_DIR,
                                                    def.is_reported_by_runs() ? "runs" : "codes", def.code)))
        << def.code;
  }
}

}  // namespace
}  // namespace isocnc::golden
