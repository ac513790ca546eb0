#include "analyzer/selection/verified.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "interpreter/solids/tool_shapes.h"
#include "tests/support/random.h"

namespace isocnc::selection {
namespace {

using namespace dialect::literals;
using simulation::RunDecision;
using simulation::RunFinding;
using simulation::RunOutcome;
using verification::VerifiedRun;

timing::TimedMachine limited_machine() {
  timing::TimedMachine machine;
  machine.motion.axes[0].minimum = 0;
  machine.motion.axes[0].maximum = 100;
  return machine;
}

/// Random IFs on VGPL, forward, between motions of which some leave the travel of X.
std::string random_program(support::Random& random) {
  const bool has_many = random.one_in(5);  // Jumps, each on another value.
  const int lines = has_many ? random.between(14, 24) : random.between(4, 14);
  std::string program = "M06 T101001\n";
  for (int line = 0; line < lines; ++line) {
    program += fmt::format("N{} ", line);
    if (has_many && !random.one_in(4)) {
      program +=
          fmt::format("IF VGPL = {} GOTO N{}\n", random.any_of({"-2", "-1", "0", "1", "1.5", "2", "2.5", "3", "4"}),
                      random.between(std::max(line + 1, lines - 6), lines));
    } else if (random.one_in(3)) {
      program += fmt::format("IF VGPL {} {} GOTO N{}\n", random.any_of({"=", "<>", "<", "<=", ">", ">="}),
                             random.any_of({"-1", "0", "1", "1.5", "2", "3"}), random.between(line + 1, lines));
    } else if (random.one_in(12)) {
      program += "M02\n";
    } else {
      program += fmt::format("G00 X{} Y{}\n", random.one_in(4) ? 150 : random.between(0, 100), line);
    }
  }
  return program + fmt::format("N{} M02\n", lines);
}

/// The places of findings, without those of jumps whose other side has not been run.
std::set<std::size_t> lines_of(const RunOutcome& outcome) {
  std::set<std::size_t> lines;
  for (const RunFinding& each : outcome.findings)
    if (each.finding.cause == 0) lines.insert(each.line);
  return lines;
}

std::size_t count_of(const RunOutcome& outcome, dialect::Cause cause) {
  return static_cast<std::size_t>(std::count_if(outcome.findings.begin(), outcome.findings.end(),
                                                [&](const RunFinding& each) { return each.finding.has(cause); }));
}

/// Every decision at an IF.
std::string path_of(const RunOutcome& run) {
  std::string path;
  for (const RunDecision& each : run.runs.front().decisions)
    path += fmt::format("{}{} ", each.line, each.taken ? "+" : "-");
  return path;
}

bool has_made_all(const RunOutcome& run, const std::vector<RunDecision>& path) {
  return std::all_of(path.begin(), path.end(), [&](const RunDecision& each) {
    return std::find(run.runs.front().decisions.begin(), run.runs.front().decisions.end(), each) !=
           run.runs.front().decisions.end();
  });
}

/// With all paths, a program has the findings that it has with each value of VGPL, and each path leads to its finding.
TEST(Verified, FindsWhatEachValueOfVgplShows) {
  const timing::TimedMachine machine = limited_machine();
  std::size_t with_path = 0;
  std::size_t incomplete = 0;
  for (const std::uint64_t seed : support::seeds(3000)) {
    support::Random random(seed);
    const std::string program = random_program(random);
    SCOPED_TRACE(fmt::format("seed {}\n{}", seed, program));
    running::RunOptions options;
    const double first_values[] = {0, 0, 1, 2.5, -3};
    options.vgpl = first_values[random.below(std::size(first_values))];
    const RunOutcome first = simulation::outcome_of_run(program, options, machine);
    const RunOutcome all = verified_on_paths(program, options, machine, nullptr).outcome;
    std::set<std::size_t> expected = lines_of(first);
    std::vector<RunOutcome> runs = {first};
    std::set<std::string> paths = {path_of(first)};
    for (const double vgpl :
         {-3.0, -2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.2, 1.5, 1.7, 2.0, 2.2, 2.5, 2.7, 3.0, 3.5, 4.0, 5.0}) {
      running::RunOptions other;
      other.vgpl = vgpl;
      runs.push_back(simulation::outcome_of_run(program, other, machine));
      paths.insert(path_of(runs.back()));
      expected.merge(lines_of(runs.back()));
    }
    const bool is_complete = paths.size() <= kMaxVerifiedPaths;
    EXPECT_EQ(count_of(all, "not-verified/other-paths"_cause), is_complete ? 0 : 1);
    if (is_complete) {
      EXPECT_EQ(lines_of(all), expected);
    }
    for (const RunFinding& each : all.findings) {
      if (each.finding.cause != 0) continue;
      EXPECT_EQ(each.path < 0, lines_of(first).contains(each.line)) << each.line;
      const std::vector<RunDecision> path =
          each.path < 0 ? std::vector<RunDecision>() : all.paths[static_cast<std::size_t>(each.path)];
      EXPECT_TRUE(std::any_of(runs.begin(), runs.end(), [&](const RunOutcome& run) {
        return lines_of(run).contains(each.line) && has_made_all(run, path);
      })) << each.line;
      EXPECT_FALSE(each.path >= 0 && has_made_all(first, path)) << each.line;
    }
    with_path += all.paths.size();
    incomplete += is_complete ? 0 : 1;
  }
  if (support::kTriesAll) {
    EXPECT_GT(with_path, 300u);
    EXPECT_GT(incomplete, 0u);
  }
}

/// What the first run shows comes out as it would alone.
/// What several paths hit on the same line is one contact, as deep as on the worst of them, and a near miss as near.
TEST(Verified, TellsTheDeepestContactOfAllPaths) {
  constexpr execution::ToolCode kTool{1, 1, 1};
  verification::Scene scene;
  scene.clearance = 2;
  scene.tools[kTool] = {.length = 100, .cutter = std::get<solids::RevolvedBody>(solids::flat_body(5, 60))};
  scene.setup.push_back({.name = "clamp", .shape = solids::Cuboid{{90, -100, 0}, {110, 100, 30}}});
  scene.setup.push_back({.name = "post", .shape = solids::Cuboid{{290, -100, 0}, {310, 100, 18}}});
  timing::TimedMachine machine;
  machine.motion = timing::unbounded_machine();
  machine.tool_lengths[kTool] = 100;
  const VerifiedRun run = verified_on_paths(
      "M06 T101001\nG00 Z100\nX0 Y0\nZ27\nIF VGPL = 0 GOTO N3\nZ20\nIF VGPL = 1 GOTO N3\nZ19\nN3 X200\nX400\nM02\n", {},
      machine, &scene);
  ASSERT_EQ(run.outcome.runs.size(), 3u);
  std::vector<std::pair<std::size_t, double>> amounts;
  for (const RunFinding& each : run.outcome.findings) amounts.emplace_back(each.line + 1, each.finding.values[0]);
  EXPECT_EQ(amounts, (std::vector<std::pair<std::size_t, double>>{{9, 11}, {10, 1}}));
}

TEST(Verified, AddsNothingWhereNoJumpComparesVgpl) {
  const std::string program = "M06 T101001\nV1=3\nIF V1 > 2 GOTO N5\nX150\nN5 G00 X150\nM02\n";
  const RunOutcome alone = simulation::outcome_of_run(program, {}, limited_machine());
  const RunOutcome all = verified_on_paths(program, {}, limited_machine(), nullptr).outcome;
  EXPECT_EQ(all.findings, alone.findings);
  EXPECT_EQ(all.runs.size(), 1u);
  EXPECT_THAT(all.paths, testing::IsEmpty());
}

/// Values that no integer, and hardly a number, lies between; and numbers too large for any.
TEST(Verified, TakesConstantsOfAnySize) {
  const std::string huge(400, '9');
  const std::string program = "M06 T101001\nIF VGPL > " + huge + " GOTO N9\nIF VGPL < -" + huge + " GOTO N9\n" +
                              "IF VGPL >= 9007199254740993 GOTO N9\n" +
                              "IF VGPL = 0.1 GOTO N9\nIF VGPL = 0.10000000000000001 GOTO N9\nN9 G00 X150\nM02\n";
  verified_on_paths(program, {}, limited_machine(), nullptr);
  const std::string large = "M06 T101001\nIF VGPL > 1" + std::string(300, '0') + " GOTO N9\nM02\nN9 G00 X150\nM02\n";
  const RunOutcome all = verified_on_paths(large, {}, limited_machine(), nullptr).outcome;
  ASSERT_EQ(all.findings.size(), 1u);
  EXPECT_EQ(all.findings[0].line, 3u);
}

/// An editor that has no use for the result any more gets no further run.
TEST(Verified, EndsBetweenTwoRuns) {
  const std::string program = "M06 T101001\nIF VGPL = 1 GOTO N9\nM02\nN9 G00 X150\nM02\n";
  EXPECT_EQ(verified_on_paths(program, {}, limited_machine(), nullptr).outcome.findings.size(), 1u);
  running::RunOptions options;
  int asked = 0;
  options.stop = [&] { return ++asked > 1; };
  const RunOutcome ended = verified_on_paths(program, options, limited_machine(), nullptr).outcome;
  EXPECT_EQ(count_of(ended, dialect::Cause("joint-travel"_diag)), 0u);
  EXPECT_EQ(asked, 2);
}

}  // namespace
}  // namespace isocnc::selection
