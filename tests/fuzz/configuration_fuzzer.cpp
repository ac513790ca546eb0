#include <cmath>
#include <cstdint>
#include <string>

#include "interpreter/configuration/read.h"
#include "interpreter/configuration/show.h"
#include "interpreter/running/runner.h"
#include "interpreter/simulation/summary.h"
#include "require.h"

namespace isocnc::fuzz {

/// Each kind of motion and of stop; short paths, since long ones take the planner time and show nothing more.
static constexpr const char* kProgram =
    "M06 T101001\nM100\nS12000 M03\nG00 X100 Y50 Z20\nG01 Z19 F3000 G09\nX101 Y51\nX102 Y50\nG02 X103 Y50 R0.5\n"
    "G03 X103 Y50 I102.8 J50\nG49\nG01 X103.5 Z18 B1 C2\nG93\nX104 B2 C4 F60\nG02 X105 Y51 R1 B3 F60\n"
    "G48\nG94\nG00 Z50 B0 C0\nM05\nM06 T102002\nM03 S9000\nG04 P0.5\nG29 B90 C90\nG01 X5 Y5 Z5 F99999\nG27\nM05\nM02\n";

/// Whatever machine a file describes, a program on it takes a time that is a number, and has its summary.
static void run_on(const configuration::MachineConfiguration& machine, bool is_summed_up) {
  simulation::Summary summary(machine.timed);
  double last = 0;
  simulation::Timing timing(machine.timed, {.event = [&](const simulation::TimedEvent& timed) {
                              require(timed.start >= last - 1e-9 * last, "events come in the order of their times");
                              require(timed.duration >= 0 && std::isfinite(timed.start + timed.duration),
                                      "times are numbers");
                              last = timed.start;
                              if (is_summed_up) summary.add(timed);
                            }});
  running::RunOptions options;
  options.setup = machine.setup;
  options.stop_at_errors = false;
  const auto result = running::run(kProgram, options, [&](const running::Event& event) { timing.take(event); });
  timing.finish();
  require(std::isfinite(timing.time()), "a run ends");
  if (!is_summed_up) return;
  summary.finish(result, timing.time(), timing.joints(), {});
  require(!summary.json("-", dialect::Language::English).empty(), "a run has its summary");
}

/// What is read can be shown, and read again it is the same.
static void read_twice(std::string_view text) {
  const configuration::ReadConfiguration read = configuration::read_configuration(text, "/shop");
  if (!read.mistakes.empty()) return;
  const std::string shown = configuration::to_json(read.configuration);
  const configuration::ReadConfiguration again = configuration::read_configuration(shown, "/shop");
  require(again.mistakes.empty(), "what is shown is right");
  require(configuration::to_json(again.configuration) == shown, "what is shown says all of it");
  run_on(read.configuration.machine, text.size() % 16 == 0);  // How far axes go takes long to find out.
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::read_twice(isocnc::fuzz::as_text(data, size));
  return 0;
}
