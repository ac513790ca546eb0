#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "interpreter/simulation/simulation.h"
#include "tests/support/random.h"

namespace isocnc::simulation {

/// A tolerance for what differs by rounding alone; mm, seconds or degrees.
inline constexpr double kTiny = 1e-9;

/// A machine on which every action takes time, so that a run can be stopped within each.
inline timing::TimedMachine machine_of_tests(bool limits_jerk = false) {
  timing::TimedMachine machine{.motion = kinematics::head_router()};
  if (limits_jerk)
    for (kinematics::AxisLimits& axis : machine.motion.axes) axis.jerk = 20 * axis.acceleration;
  machine.durations = {.tool_change = 5, .spindle = 0.5, .channel = 0.25, .functions = {{100, 0.75}}};
  machine.tool_lengths = {{execution::tool_code(101001), 80}, {execution::tool_code(101002), 120}};
  machine.tool_radii = {{execution::tool_code(101001), 3}, {execution::tool_code(101002), 8}};
  machine.home.tip.z() = 400;
  return machine;
}

/// Advances to `seconds` after the program start, or to the end.
inline void advance_to(Simulation& simulation, double seconds) {
  while (!simulation.has_ended() && seconds > simulation.time()) simulation.advance_in_block(seconds);
}

/// Options with which the program starts at the machine's home.
inline running::RunOptions options_for(const timing::TimedMachine& machine) {
  running::RunOptions options;
  options.setup.home = machine.home;
  return options;
}

/// Writes programs that run and contain everything that makes a machine move, wait and jump.
class RandomRun {
 public:
  explicit RandomRun(support::Random& random) : random_(random) {}

  std::string text(int sections) {
    for (int i = 0; i < sections; ++i) section();
    if (random_.one_in(6)) add("G02 X1");  // An arc without a center, which is an error.
    if (!random_.one_in(6)) add("M02");
    return text_;
  }

 private:
  void add(std::string_view line) { text_.append(line).append(random_.one_in(9) ? "\r\n" : "\n"); }
  double number() { return random_.between(-900, 900) / 10.0; }

  void section() {
    add(fmt::format("M06 T10100{}", random_.between(1, 2)));
    if (random_.one_in(2)) add("S12000 M03");
    add(fmt::format("{} {} {} G0 X{} Y{} Z{}", random_.one_in(3) ? "G70" : "G71", random_.one_in(4) ? "G93" : "G94",
                    "G90", number() / 9, number() / 9, random_.between(1, 9)));
    add("G94");
    add(fmt::format("G1 Z-1 F{}", 100 * random_.between(1, 80)));
    for (int i = random_.between(1, 6); i > 0; --i) pass();
    if (random_.one_in(3)) add("G49");
    if (random_.one_in(3)) add("G48");
  }

  void pass() {
    switch (random_.between(0, 12)) {
      case 0:
        return fork();
      case 1:
        return add(fmt::format("G04 P{}", random_.between(0, 8) / 10.0));
      case 2:
        return add(fmt::format("V{}={}", random_.between(1, 3), random_.between(0, 2)));
      case 3:
        add("");
        return add(random_.one_in(2) ? "; note" : "N5 (note)");
      case 4:
        return add(random_.one_in(2) ? "M100" : "M101 P1=2");
      case 5: {
        const int radius = random_.between(1, 30);
        add(fmt::format("G91 G{} X{} Y0 I{} J0 Z{}", random_.between(2, 3), 2 * radius, radius,
                        random_.between(-1, 1)));
        return add("G90");
      }
      case 6:
        return add(fmt::format("G0 X{} B{} C{}", number(), random_.between(-60, 60), random_.between(-90, 90)));
      case 7:
        return add(fmt::format("G1 X{} Y{} F{}{}", number(), number(), 500 * random_.between(1, 30),
                               random_.any_of({"", " G09", "\nG09"})));
      case 8:
        return add(random_.one_in(2) ? "G1 B10 C20" : "G49\nG1 X3 B15 C-30\nG48");
      case 9:
        return add("G92 X10 Y-5\nG1 X2 Y2\nG92");
      case 10:
        return compensated_contour();
      default:
        return contour();
    }
  }

  void contour() {
    add("G91 G1 F6000");
    for (int i = random_.between(1, 40); i > 0; --i)
      add(fmt::format("X{} Y{}{}", random_.between(1, 20) / 10.0, random_.between(-9, 9) / 10.0,
                      random_.one_in(9) ? " Z0.1" : ""));
    add("G90");
  }

  /// Adds a contour, usually wide enough for the tool. Any other pass may come between two motions, even another
  /// contour.
  void compensated_contour() {
    add(random_.any_of({"G39\nG41", "G38\nG41", "G42"}));
    add(fmt::format("G1 X{} Y{} F{}", number(), number(), 500 * random_.between(1, 10)));
    for (int i = random_.between(1, 5); i > 0; --i) {
      if (random_.one_in(3)) pass();
      add(random_.one_in(4) ? fmt::format("G91 G{} X20 Y0 I10 J0\nG90", random_.between(2, 3))
                            : fmt::format("G1 X{} Y{}", number(), number()));
    }
    add("G40");
    if (random_.one_in(2)) add(fmt::format("G1 X{} Y{}", number(), number()));
  }

  void fork() {
    const int label = 100 + ++labels_;
    add(fmt::format("IF {} {} {} GOTO N{}", random_.any_of({"V1", "V2", "V3", "VGPL"}),
                    random_.any_of({"=", "<>", ">="}), random_.between(0, 2), label));
    pass();
    add(fmt::format("N{}{}", label, random_.one_in(2) ? " G1 X5 Y5" : ""));
  }

  support::Random& random_;
  std::string text_;
  int labels_ = 0;
};

/// The whole visible state of a simulation at a moment; numbers have full precision.
struct Shown {
  std::string text;
  execution::State state;
  running::Registers registers{};

  friend bool operator==(const Shown&, const Shown&) = default;
  friend void PrintTo(const Shown& shown, std::ostream* out) { *out << shown.text; }
};

inline Shown shown(const Simulation& simulation) {
  const motion::Sample sample = simulation.sample();
  const auto numbers = [](const kinematics::Coordinates& values) { return fmt::format("{}", fmt::join(values, " ")); };
  const DistanceToGo to_go = simulation.to_go();
  const running::Event* const event = simulation.event();
  return {.text = fmt::format(
              "time {} blocks {} line {}{}{} event {} tip {} joints {} at {} {} speed {} {} to go {}, {} "
              "vgpl {} end {} {}",
              simulation.time(), simulation.blocks(), simulation.line(), simulation.is_in_block() ? " in block" : "",
              simulation.has_ended() ? " ended" : "",
              event ? fmt::format("{} {}", running::kind_of(*event), event->line) : "none",
              numbers(kinematics::coordinates(sample.tip)), numbers(sample.joints), numbers(sample.joint_speeds),
              numbers(sample.joint_accelerations), sample.speed, sample.acceleration, numbers(to_go.axes), to_go.path,
              simulation.vgpl(), static_cast<int>(simulation.run().ending), simulation.run().line),
          .state = simulation.run().state,
          .registers = simulation.run().registers};
}

/// Advances a simulation at random: by a block or several, by some time, or along some of the path.
template <class Machine>
void go_on(Machine& machine, support::Random& random, double time) {
  switch (random.between(0, 3)) {
    case 0:
      return machine.step_block();
    case 1:
      return machine.advance_in_block(time + random.real(0.001, 1));
    case 2:
      return machine.advance_along(random.real(0.01, 30));
    default:
      for (int i = random.between(1, 20); i > 0; --i) machine.step_block();
  }
}

}  // namespace isocnc::simulation
