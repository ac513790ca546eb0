#include "interpreter/simulation/run_findings.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "interpreter/timing/timing.h"

namespace isocnc::simulation {
namespace {

/// The feeds above the machine's limit, in a run that reads the whole program before the machine moves, or as far as a
/// control does.
std::vector<double> feeds_above(std::string_view program, const timing::TimedMachine& machine, bool reads_ahead) {
  RunFindings findings(machine);
  std::vector<timing::TimedEvent> waiting;
  const auto make = [&](const timing::TimedEvent& timed) {
    if (!timed.move) return;
    kinematics::MadeMove made(machine.motion, *timed.move);
    findings.take(timed.event, made);
  };
  timing::Timing timing(machine, {.event = [&](const timing::TimedEvent& timed) {
                          if (reads_ahead) return waiting.push_back(timed);
                          make(timed);
                        }});
  running::RunOptions options;
  options.before_block = [&](const running::Block& block) { findings.take(block); };
  const running::RunResult result = running::run(program, options, [&](const running::Event& event) {
    findings.take(event);
    timing.take(event);
  });
  timing.finish();
  for (const timing::TimedEvent& timed : waiting) make(timed);
  std::vector<double> feeds;
  for (const RunFinding& each : findings.outcome(program, result).findings) feeds.push_back(each.finding.values[0]);
  return feeds;
}

/// An F that counts as a time for one motion and as a speed for the next: 30000 times 100 mm, and 30000 mm/min.
TEST(RunFindings, TellTheSameHoweverFarTheRunReadsAhead) {
  timing::TimedMachine machine;
  machine.motion.feed_speed = 20'000.0 / 60;
  constexpr std::string_view kProgram = "M06 T101001\nG00 X0 Y0 Z0\nG93 G01 X100 F30000\nG04 P1\nG94\nG01 X200\nM02\n";
  for (const bool reads_ahead : {false, true})
    EXPECT_EQ(feeds_above(kProgram, machine, reads_ahead), std::vector<double>{3'000'000}) << reads_ahead;
}

}  // namespace
}  // namespace isocnc::simulation
