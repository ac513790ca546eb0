#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <span>

#include <fmt/format.h>

#include "interpreter/kinematics/kinematics.h"
#include "interpreter/restart/restart.h"
#include "interpreter/simulation/timed_run.h"
#include "tests/restart/program_lines.h"
#include "tests/support/random.h"

/// What a restart promises of the machine: with tools of some radius and length it stands where it stood before the
/// line, and goes on from there exactly as in the program. All of it is read from timed runs, as `isorun --trace` does.
namespace isocnc::restart {
namespace {

namespace fs = std::filesystem;
using execution::MoveKind;
using geometry::Vec3;
using support::Random;
using support::seeds;

constexpr double kNear = 1e-5;  // mm, degrees

/// A motion of the machine.
struct Motion {
  std::uint64_t line = 0;
  MoveKind kind = MoveKind::Rapid;
  kinematics::Move move;
};

/// What a run does, from its start.
struct MachineRun {
  std::vector<Motion> motions;      ///< That go anywhere.
  std::vector<std::string> others;  ///< Of all other events, `line: event`, where only their order matters.
  running::Ending ending = running::Ending::Error;
};

bool goes(const kinematics::Move& move) {
  return move.is_arc || (move.to.tip - move.from.tip).norm() > 1e-7 || move.to.b != move.from.b ||
         move.to.c != move.from.c;
}

/// Lines count from `first`; what comes before has the lines that it has.
std::string in_words(const running::Event& event, std::uint64_t first) {
  running::Event shifted = event;
  shifted.line = event.line >= first ? event.line - first : event.line;
  if (auto* const jump = std::get_if<running::JumpEvent>(&shifted.what)) jump->target_line = 0;
  if (std::holds_alternative<running::FrameEvent>(event.what)) return "frame";  // Shows in the motions.
  return to_json(shifted);
}

MachineRun course_of(std::string_view text, const RestartOptions& options, std::uint64_t first) {
  MachineRun course;
  const running::RunResult result = simulation::run_timed(
      text, options.run, options.machine, {.event = [&](const timing::TimedEvent& timed) {
        if (!timed.move) {
          if (timed.event.line >= first) course.others.push_back(in_words(timed.event, first));
        } else if (goes(*timed.move)) {
          course.motions.push_back(
              {timed.event.line, std::get<running::MoveEvent>(timed.event.what).kind, *timed.move});
        }
      }});
  course.ending = result.ending;
  return course;
}

bool is_close(const Vec3& a, const Vec3& b) { return (a - b).norm() < kNear; }
bool is_close(const geometry::Pose& a, const geometry::Pose& b) {
  return is_close(a.tip, b.tip) && std::abs(a.b - b.b) < kNear && std::abs(a.c - b.c) < kNear;
}

/// Where the nose and the rotary axes are, by the kinematics alone.
kinematics::Coordinates joints_at(const kinematics::Machine& machine, const geometry::Pose& tip, double tool_length) {
  return kinematics::inverse(machine.kinematics, kinematics::coordinates(tip), tool_length);
}

bool has_near_joints(const kinematics::Machine& machine, const kinematics::Move& a, const kinematics::Move& b) {
  const auto joints = [&](const geometry::Pose& tip, double length) { return joints_at(machine, tip, length); };
  return (joints(a.from, a.tool_length) - joints(b.from, b.tool_length)).norm() < kNear &&
         (joints(a.to, a.tool_length) - joints(b.to, b.tool_length)).norm() < kNear;
}

/// A tool change in between moves no joint.
bool end_alike(const kinematics::Machine& machine, const kinematics::Move& a, const kinematics::Move& b) {
  return (joints_at(machine, a.to, a.tool_length) - joints_at(machine, b.to, b.tool_length)).norm() < kNear;
}

bool is_same(const kinematics::Machine& machine, const Motion& a, const Motion& b) {
  if (a.kind != b.kind || a.move.is_arc != b.move.is_arc || a.move.exact_stop != b.move.exact_stop) return false;
  if (!is_close(a.move.from, b.move.from) || !is_close(a.move.to, b.move.to)) return false;
  if (!has_near_joints(machine, a.move, b.move)) return false;
  if (a.move.feed.kind != b.move.feed.kind || std::abs(a.move.feed.value - b.move.feed.value) > kNear) return false;
  return !a.move.is_arc ||
         (is_close(a.move.center, b.move.center) && std::abs(a.move.sweep_deg - b.move.sweep_deg) < kNear);
}

std::string in_words(const Motion& motion) {
  const kinematics::Move& move = motion.move;
  return fmt::format("line {} kind {}: {} {} {} to {} {} {}, feed {}", motion.line + 1, static_cast<int>(motion.kind),
                     move.from.tip.x(), move.from.tip.y(), move.from.tip.z(), move.to.tip.x(), move.to.tip.y(),
                     move.to.tip.z(), move.feed.value);
}

/// From the first motion on a line or below.
std::span<const Motion> from_line(const MachineRun& course, std::uint64_t line) {
  const auto first = std::find_if(course.motions.begin(), course.motions.end(),
                                  [&](const Motion& motion) { return motion.line >= line; });
  return {first, course.motions.end()};
}
std::span<const Motion> before_line(const MachineRun& course, std::uint64_t line) {
  return std::span(course.motions).first(course.motions.size() - from_line(course, line).size());
}

/// How many restarts there were, of which kinds.
struct Tally {
  int tried = 0;
  int made = 0;
  int made_off_program = 0;     ///< Where the machine was not where the program had it.
  int refused_off_program = 0;  ///< For that reason.
};

/// The state before a line: what motions do not show.
execution::State state_before(std::string_view text, running::RunOptions options, std::uint64_t line) {
  options.until = line;
  return running::run(text, options, [](const running::Event&) {}).state;
}

/// The way to the line: level motions as high as the highest place at which the program has cut so far, and the rest
/// straight down at the place where the machine stood.
void expect_safe_approach(std::span<const Motion> approach, std::span<const Motion> before,
                          const std::string& context) {
  if (approach.empty()) return;
  double safe = -std::numeric_limits<double>::infinity();
  for (const Motion& motion : before)
    if (motion.kind != MoveKind::Rapid) safe = std::max({safe, motion.move.from.tip.z(), motion.move.to.tip.z()});
  const Vec3 place = approach.back().move.to.tip;  // Where the machine stood, as is seen elsewhere.
  const bool has_cut = !before.empty() && before.back().kind != MoveKind::Rapid;
  for (const Motion& motion : approach.subspan(1)) {  // The first leads up from home.
    const Vec3& from = motion.move.from.tip;
    const Vec3& to = motion.move.to.tip;
    const bool is_there = (to - place).head<2>().norm() < kNear && (from - place).head<2>().norm() < kNear;
    EXPECT_TRUE(is_there || std::min(from.z(), to.z()) > safe - kNear) << in_words(motion) << '\n' << context;
    if (motion.kind == MoveKind::Rapid) {
      EXPECT_GT(to.z(), std::min(safe, has_cut ? place.z() + 5 : place.z()) - kNear) << context;
    }
  }
}

void expect_same_machine(const std::string& program, const std::string& restarted, const RestartOptions& options,
                         bool is_upright, Tally& tally) {
  const std::string context = fmt::format("before line {} of\n{}\nby\n{}", options.line + 1, program, restarted);
  const std::uint64_t preamble = line_count(restarted) - line_count(rest_of(program, options.line));
  const MachineRun wanted = course_of(program, options, options.line);
  const MachineRun found = course_of(restarted, options, preamble);
  ASSERT_EQ(found.ending, running::Ending::ProgramEnd) << context;
  EXPECT_EQ(found.others, wanted.others) << context;
  const auto rest = from_line(wanted, options.line);
  const auto continues = from_line(found, preamble);
  ASSERT_EQ(continues.size(), rest.size()) << context;
  for (std::size_t i = 0; i < rest.size(); ++i)
    ASSERT_TRUE(is_same(options.machine.motion, continues[i], rest[i])) << in_words(continues[i]) << '\n'
                                                                        << in_words(rest[i]) << '\n'
                                                                        << context;
  const auto before = before_line(wanted, options.line);
  const auto approach = before_line(found, preamble);
  const auto state = state_before(program, options.run, options.line);
  const auto state_then = state_before(restarted, options.run, preamble);
  EXPECT_EQ(state.spindle_speed, state_then.spindle_speed) << context;
  EXPECT_EQ(state.tool, state_then.tool) << context;
  EXPECT_EQ(feed_in_force(state), feed_in_force(state_then)) << context;
  if (before.empty()) return;
  if (!approach.empty()) {
    EXPECT_TRUE(end_alike(options.machine.motion, approach.back().move, before.back().move)) << context;
  }
  if (is_upright) expect_safe_approach(approach, before, context);
  if (!is_close(before.back().move.to.tip, state.to_machine(state.position.tip))) ++tally.made_off_program;
}

/// Tries each line of a program.
void try_lines(const std::string& program, RestartOptions options, bool is_upright, Tally& tally) {
  for (options.line = 0; options.line < line_count(program); ++options.line) {
    const auto made = restart_program(program, options);
    ++tally.tried;
    if (const auto* const restarted = std::get_if<std::string>(&made)) {
      ++tally.made;
      expect_same_machine(program, *restarted, options, is_upright, tally);
      if (testing::Test::HasFailure()) return;
      continue;
    }
    const auto& refusal = std::get<RestartRefusal>(made);
    EXPECT_NE(refusal.obstacle, RestartObstacle::NotProved) << options.line + 1 << '\n' << program;
    if (refusal.obstacle == RestartObstacle::OnContour || refusal.obstacle == RestartObstacle::OffProgram)
      ++tally.refused_off_program;
    for (const auto& proposed : {refusal.before, refusal.after}) {
      RestartOptions there = options;
      if (!proposed) continue;
      there.line = *proposed;
      EXPECT_TRUE(std::holds_alternative<std::string>(restart_program(program, there))) << *proposed + 1 << program;
    }
  }
}

/// Contours in compensation, and what may come before and after the motion that leads the tool back.
class RandomContours {
 public:
  explicit RandomContours(Random& random) : random_(random) {}

  std::string text() {
    if (random_.one_in(2)) add("G17 G71 G90 G94");
    if (random_.one_in(2)) add(fmt::format("G92 X{} Y{} Z-{}", number(), number(), random_.between(1, 90)));
    for (int i = random_.between(1, 3); i > 0; --i) section();
    add("G00 Z60");
    add("M02");
    return std::move(text_);
  }

 private:
  void add(std::string_view line) { text_.append(line).append("\n"); }
  int number() { return random_.between(-90, 90); }
  std::string place() { return fmt::format("X{} Y{}", number(), number()); }

  void section() {
    add(fmt::format("M06 T10100{}", random_.between(1, 4)));
    if (random_.one_in(2)) add(fmt::format("S{} M03", 1000 * random_.between(1, 9)));
    add("G00 " + place());
    add("Z30");
    for (int i = random_.between(1, 2); i > 0; --i) contour();
  }

  void contour() {
    add("G00 Z2");
    add(fmt::format("G01 Z-{} F{}", random_.between(1, 9), 100 * random_.between(5, 50)));
    add(random_.any_of({"G41", "G42", "G39 G41", "G38 G42"}));
    add(fmt::format("G01 {} F{}", place(), 100 * random_.between(5, 50)));
    for (int i = random_.between(1, 4); i > 0; --i) element();
    if (random_.one_in(3)) {
      add("G01 " + place() + " G40");
    } else {
      add("G40");
    }
    for (int i = random_.between(0, 5); i > 0; --i) between();
    add(random_.any_of({"G00 " + place(), "G00 " + place() + " Z40", fmt::format("X{}", number()),
                        fmt::format("G01 Y{}", number()), fmt::format("G91 G01 X{}\nG90", number()),
                        fmt::format("G02 {} R200", place()), "G41 G01 " + place() + "\nX5\nG40\nG00 " + place()}));
    if (random_.one_in(2)) add("G00 Z40");
  }

  void element() {
    add(random_.any_of({"X" + std::to_string(number()), "Y" + std::to_string(number()), place(), "Z-3",
                        fmt::format("G03 {} R180", place()), fmt::format("G01 {}", place()), std::string("M100")}));
  }

  void between() {
    add(random_.any_of({std::string("G00 Z30"), std::string("Z2"), fmt::format("G01 Z-{}", random_.between(1, 6)),
                        std::string("G04 P0.5"), std::string("M100"), std::string(""), std::string("S7000"),
                        std::string("G41\nG40"), std::string("G18\nG00 Z25\nG17"), std::string("IF VGPL > 1 GOTO N9"),
                        fmt::format("G92 X{}", number()), fmt::format("M06 T10100{}", random_.between(1, 4)),
                        std::string("G91 G00 Z4\nG90"), std::string("G09")}));
  }

  Random& random_;
  std::string text_;
};

/// T101003 is known to have no radius, of T101004 nothing is known.
timing::TimedMachine machine_with_tools() {
  timing::TimedMachine machine;
  machine.tool_lengths = {{{1, 1, 1}, 80}, {{1, 1, 2}, 120}, {{1, 1, 3}, 95}};
  machine.tool_radii = {{{1, 1, 1}, 3}, {{1, 1, 2}, 8}, {{1, 1, 3}, 0}};
  machine.home.tip.z() = 400;
  return machine;
}

/// Takes out the lines at which the control would stop.
std::string runnable(std::string text, const running::RunOptions& options) {
  for (;;) {
    const running::RunResult result = running::run(text, options, [](const running::Event&) {});
    if (result.ending == running::Ending::ProgramEnd) return text;
    const std::size_t begin = text.size() - rest_of(text, result.line).size();
    text.erase(begin, text.find('\n', begin) + 1 - begin);
    if (line_count(text) == 0) return "M02\n";
  }
}

TEST(RestartMachine, GoesOnAsInTheProgramAfterContours) {
  Tally tally;
  for (const std::uint64_t seed : seeds(400)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    RestartOptions options;
    options.machine = machine_with_tools();
    options.run.setup.home = options.machine.home;
    options.run.vgpl = random.between(0, 3);
    if (random.one_in(3)) options.run.setup.clearance = random.between(0, 40);
    try_lines(runnable(RandomContours(random).text(), options.run), options, true, tally);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(tally.made, tally.tried / 3);
  EXPECT_GT(tally.made_off_program, tally.tried / 20);
  EXPECT_GT(tally.refused_off_program, tally.tried / 100);
}

/// The programs of a file that run to their end.
std::vector<std::string> programs_in(const fs::path& file) {
  std::vector<std::string> programs(1);
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line == "; ====") {
      programs.emplace_back();
    } else {
      programs.back() += line + '\n';
    }
  }
  std::erase_if(programs, [](const std::string& program) {
    return running::run(program, {}, [](const running::Event&) {}).ending != running::Ending::ProgramEnd;
  });
  return programs;
}

/// Each tool that the program mounts has a radius and a length of its own.
void add_tools(const std::string& program, timing::TimedMachine& machine) {
  running::run(program, {}, [&](const running::Event& event) {
    const auto* const tool = std::get_if<running::ToolEvent>(&event.what);
    if (tool == nullptr) return;
    machine.tool_radii[tool->tool] = 2.5 + tool->tool.tool % 5;
    machine.tool_lengths[tool->tool] = 60 + 7.0 * (tool->tool.tool % 9);
  });
}

TEST(RestartMachine, GoesOnAsInEachProgramThatComesAlong) {
  Tally tally;
  for (const char* const folder : {"/examples", "/tests/programs"})
    for (const auto& entry : fs::recursive_directory_iterator(std::string(ISOCNC_SOURCE_DIR) + folder)) {
      if (entry.path().extension() != ".iso") continue;
      for (const std::string& program : programs_in(entry.path())) {
        SCOPED_TRACE(entry.path());
        RestartOptions options;
        options.machine.motion.kinematics = kinematics::head_router().kinematics;
        add_tools(program, options.machine);
        options.machine.home.tip.z() = options.run.setup.home.tip.z() = 450;
        if (running::run(program, options.run, [](const running::Event&) {}).ending != running::Ending::ProgramEnd)
          continue;
        try_lines(program, options, false, tally);
        if (testing::Test::HasFailure()) return;
      }
    }
  EXPECT_GT(tally.tried, 1000);
  EXPECT_GT(tally.made, tally.tried / 2);
  EXPECT_GT(tally.made_off_program, 20);
}

}  // namespace
}  // namespace isocnc::restart
