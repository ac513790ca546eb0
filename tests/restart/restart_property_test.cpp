#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <sstream>

#include "analyzer/check/check_text.h"
#include "interpreter/restart/restart.h"
#include "tests/restart/program_lines.h"
#include "tests/support/random_program.h"

/// What a restart promises, on random programs and lines: from the line on, the machine does what it does in the
/// program itself.
namespace isocnc::restart {
namespace {

using dialect::ModalGroup;
using support::Random;
using support::RandomProgram;
using support::seeds;

/// Programs as shops write them: tools, faces, passes in absolute, incremental, inches and inverse time, jumps.
class RandomJob {
 public:
  explicit RandomJob(Random& random) : random_(random) {}

  std::vector<std::string> lines() {
    if (random_.one_in(2)) add("G17 G71 G90 G94");
    if (random_.one_in(2)) add(fmt::format("V{}={}", random_.between(1, 4), random_.between(0, 3)));
    if (random_.one_in(2)) add(fmt::format("G92 X{} Y{} Z-{}", number(), number(), random_.between(1, 300)));
    for (int i = random_.between(1, 4); i > 0; --i) section();
    add("M02");
    return std::move(lines_);
  }

 private:
  void add(std::string line) { lines_.push_back(std::move(line)); }
  std::string number() { return fmt::format("{}.{}", random_.between(-90, 90), random_.between(0, 99)); }

  void section() {
    add(fmt::format("M06 T10100{}", random_.between(1, 9)));
    add(fmt::format("S{} M0{}", 1000 * random_.between(1, 20), random_.between(3, 4)));
    if (random_.one_in(3)) add(fmt::format("M{} P1={}", random_.between(100, 103), number()));
    add(fmt::format("G00 X{} Y{} Z60", number(), number()));
    const bool tilts = random_.one_in(2);
    if (tilts) {
      add(fmt::format("G00 B{} C{}", random_.between(0, 90), random_.between(-180, 180)));
      face();
      add("G00 Z40");
    }
    if (!tilts && random_.one_in(3)) add(fmt::format("B{} C{}", random_.between(-95, 95), random_.between(-180, 180)));
    for (int i = random_.between(1, 3); i > 0; --i) pass();
    if (random_.one_in(3)) fork();
    add("G00 Z50");
    if (tilts) add("G27");
    if (random_.one_in(3)) add("M05");
  }

  void face() {
    switch (random_.between(0, 2)) {
      case 0:
        return add(
            fmt::format("G29 X{} Z{} B{} C{}", number(), number(), random_.between(0, 90), random_.between(-180, 180)));
      case 1:
        return add("G28 X4 Z-3 J1 P3 R4");
      default:
        return add(fmt::format("G24 X{} Y{} A1 B.5 I-1 J2 P.1 R1", number(), number()));
    }
  }

  void pass() {
    add(fmt::format("G00 X{} Y{}", number(), number()));
    add("G00 Z3");
    const int way = random_.between(0, 4);
    if (way == 0) add("G70");
    if (way == 1) add("G93");
    add(fmt::format("G01 Z-1.5 F{}", random_.between(1, 9000)));
    if (way == 2) add("G91");
    if (way == 3) add("G41");
    for (int i = random_.between(1, 6); i > 0; --i) cut(way == 1);
    if (way == 0) add("G71");
    if (way == 1) add("G94");
    if (way == 2) add("G90");
    if (way == 3) add("G40");
    add("G00 Z30");
  }

  void cut(bool inverse) {
    const std::string feed = inverse || random_.one_in(4) ? fmt::format(" F{}", random_.between(1, 5000)) : "";
    switch (random_.between(0, 4)) {
      case 0:
        return add(fmt::format("G0{} X{} Y{} R500{}", random_.between(2, 3), number(), number(), feed));
      case 1:
        return add(fmt::format("X{} Y{} R700{}", number(), number(), feed));  // Only directly after an arc.
      case 2:
        return add(fmt::format("G01 X{} Z-{}{}", number(), random_.between(2, 9), feed));
      case 3:
        return add("G09");
      default:
        return add(fmt::format("X{} Y{}{}", number(), number(), feed));
    }
  }

  void fork() {
    const int label = ++labels_;
    const std::string left = random_.one_in(2) ? "VGPL" : fmt::format("V{}", random_.between(1, 4));
    add(fmt::format("IF {} > {} GOTO N{}", left, random_.between(0, 2), label));
    pass();
    if (random_.one_in(2)) add(fmt::format("V{}={}", random_.between(1, 4), random_.between(0, 3)));
    add(fmt::format("N{} G00 Z55", label));
  }

  Random& random_;
  int labels_ = 0;
  std::vector<std::string> lines_;
};

/// Takes out the lines at which the control would stop.
std::string runnable(std::vector<std::string> lines, const running::RunOptions& options) {
  for (;;) {
    const std::string text = support::joined(lines);
    const running::RunResult result = run(text, options, [](const running::Event&) {});
    if (result.ending == running::Ending::ProgramEnd) return text;
    if (dialect::definition(result.error.id).code == "ISO045") {
      lines.push_back("M02");
    } else {
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(result.line));
    }
  }
}

/// What happens on a line and below, and the state before each line there.
struct TracedRun {
  std::vector<running::Event> events;
  std::vector<execution::State> states;
  std::vector<std::uint64_t> lines;  ///< Counted from the first.
  running::RunResult result;
};

TracedRun course_of(std::string_view text, running::RunOptions options, std::uint64_t from) {
  TracedRun course;
  options.before_block = [&](const running::Block& block) {
    if (block.line < from) return;
    course.states.push_back(block.state);
    course.lines.push_back(block.line - from);
  };
  course.result = run(text, options, [&](const running::Event& event) {
    if (event.line < from) return;
    course.events.push_back(event);
    course.events.back().line -= from;
  });
  return course;
}

bool is_near(const geometry::Vec3& a, const geometry::Vec3& b) { return (a - b).norm() < 1e-5; }
bool is_near(const geometry::Pose& a, const geometry::Pose& b) {
  return is_near(a.tip, b.tip) && std::abs(a.b - b.b) < 1e-6 && std::abs(a.c - b.c) < 1e-6;
}

bool is_same(const running::MoveEvent& a, const running::MoveEvent& b) {
  return a.kind == b.kind && is_near(a.from, b.from) && is_near(a.to, b.to) && std::abs(a.length - b.length) < 1e-3 &&
         is_near(a.normal, b.normal) && std::abs(a.sweep_deg - b.sweep_deg) < 1e-3 &&
         (a.kind != execution::MoveKind::Arc || is_near(a.center, b.center));
}
bool is_same(const running::FrameEvent& a, const running::FrameEvent& b) {
  return is_near(a.workpiece_origin, b.workpiece_origin) && a.face_mounted == b.face_mounted &&
         is_near(a.face.origin, b.face.origin) && (a.face.axes - b.face.axes).norm() < 1e-9;
}

bool is_same(const running::Event& a, const running::Event& b) {
  if (a.line != b.line || a.what.index() != b.what.index()) return false;
  if (const auto* const move = std::get_if<running::MoveEvent>(&a.what))
    return is_same(*move, std::get<running::MoveEvent>(b.what));
  if (const auto* const frame = std::get_if<running::FrameEvent>(&a.what))
    return is_same(*frame, std::get<running::FrameEvent>(b.what));
  if (const auto* const jump = std::get_if<running::JumpEvent>(&a.what))
    return jump->taken == std::get<running::JumpEvent>(b.what).taken;
  return to_json(a) == to_json(b);
}

/// Groups of which a repetition is W001 (D3).
constexpr std::uint16_t bit(ModalGroup group) { return static_cast<std::uint16_t>(1u << static_cast<unsigned>(group)); }
constexpr std::uint16_t kNotedGroups =
    bit(ModalGroup::Plane) | bit(ModalGroup::Interpolation) | bit(ModalGroup::Units) | bit(ModalGroup::FeedMode);

/// Modes, feed and spindle; the motion G where it is sure to be the same.
bool is_same(const execution::State& a, const execution::State& b, bool with_motion) {
  for (std::size_t i = with_motion ? 0 : 1; i < dialect::kModalGroupCount; ++i)
    if (i != static_cast<std::size_t>(ModalGroup::Face) && a.in_force[i] != b.in_force[i]) return false;
  return is_near(a.position, b.position) && feed_in_force(a) == feed_in_force(b) && a.tool == b.tool &&
         a.spindle_speed == b.spindle_speed && ((a.written ^ b.written) & kNotedGroups) == 0;
}

void expect_same_course(const std::string& program, const std::string& restarted, const RestartOptions& options) {
  const std::string rest = rest_of(program, options.line);
  ASSERT_TRUE(restarted.ends_with(rest)) << restarted;
  const std::uint64_t preamble = line_count(restarted) - line_count(rest);
  const TracedRun wanted = course_of(program, options.run, options.line);
  const TracedRun found = course_of(restarted, options.run, preamble);
  ASSERT_EQ(found.result.ending, running::Ending::ProgramEnd) << restarted;
  EXPECT_EQ(found.result.registers, wanted.result.registers) << restarted;
  ASSERT_EQ(found.lines, wanted.lines) << restarted;
  ASSERT_EQ(found.events.size(), wanted.events.size()) << restarted;
  for (std::size_t i = 0; i < wanted.events.size(); ++i)
    ASSERT_TRUE(is_same(found.events[i], wanted.events[i])) << to_json(found.events[i]) << '\n'
                                                            << to_json(wanted.events[i]) << '\n'
                                                            << program << restarted;
  const auto is_move = [](const running::Event& event) {
    return std::holds_alternative<running::MoveEvent>(event.what);
  };
  const auto first_move = std::find_if(wanted.events.begin(), wanted.events.end(), is_move);
  for (std::size_t i = 0; i < wanted.states.size(); ++i) {
    const bool has_moved = first_move != wanted.events.end() && first_move->line < wanted.lines[i];
    ASSERT_TRUE(is_same(found.states[i], wanted.states[i], has_moved)) << "line " << i << '\n' << program << restarted;
  }
}

/// Codes of the errors that isolint finds from a line on.
std::multiset<std::string> errors_from(std::string_view text, std::uint64_t line, const execution::Setup& setup) {
  std::multiset<std::string> codes;
  for (const check::LocatedFinding& located : check::check_text(text, {setup}).findings) {
    const dialect::DiagnosticDef& def = dialect::definition(located.finding.id);
    if (def.severity == dialect::Severity::Error && located.line >= line)
      codes.emplace(def.code == "E005" ? "E004" : def.code);  // The label above is removed.
  }
  return codes;
}

/// Whether an IF on the path has shown something of a register that the restart program does not know: paths that it
/// rules out in the original are then possible.
bool assumes_register(const std::string& restarted) {
  static const std::regex kAssumed("; assumed on the way there: .*V[0-9].*");
  std::istringstream lines(restarted);
  for (std::string line; std::getline(lines, line) && line.starts_with(';');)
    if (std::regex_match(line, kAssumed)) return true;
  return false;
}

/// The preamble has no error, and the rest none that it did not have.
void expect_no_new_errors(const std::string& program, const std::string& restarted, const RestartOptions& options) {
  const auto old = errors_from(program, options.line, options.run.setup);
  const auto now = errors_from(restarted, 0, options.run.setup);
  EXPECT_TRUE(std::includes(old.begin(), old.end(), now.begin(), now.end())) << testing::PrintToString(now) << '\n'
                                                                             << program << restarted;
}

/// Straight up, across at the height then reached, straight down, along the axis of the face: nothing else. No rapid
/// goes below the clearance where one is given and an F is known; the last of the way is feed.
void expect_safe_approach(const std::string& program, const std::string& restarted, const RestartOptions& options) {
  const std::uint64_t preamble = line_count(restarted) - line_count(rest_of(program, options.line));
  running::RunOptions watched = options.run;
  watched.until = preamble;
  execution::State before;
  const auto clearance = options.clearance ? options.clearance : options.run.setup.clearance;
  watched.before_block = [&](const running::Block& block) { before = block.state; };
  const execution::State wanted = course_of(program, options.run, options.line).states.front();
  run(restarted, watched, [&](const running::Event& event) {
    const auto* const move = std::get_if<running::MoveEvent>(&event.what);
    if (move == nullptr) return;
    ASSERT_NE(move->kind, execution::MoveKind::Arc);
    const geometry::Vec3 way = move->to.tip - move->from.tip;
    const geometry::Vec3 axis = before.direction_to_machine(geometry::Vec3::UnitZ());
    constexpr double kRounding = 2e-3;  // The place above a face is given to a thousandth.
    const bool is_level = std::abs(way.z()) < kRounding;
    const geometry::Vec3 tool = geometry::axes_from_angles(move->to.b, move->to.c).col(2);
    const bool is_along_axis = way.cross(axis).norm() < 2 * kRounding;
    const bool is_along_tool = way.cross(tool).norm() < 2 * kRounding && move->kind == execution::MoveKind::Feed;
    ASSERT_TRUE(is_level || is_along_axis || is_along_tool) << event.line + 1 << '\n' << restarted;
    if (move->kind != execution::MoveKind::Rapid || !clearance || feed_in_force(wanted).number == 0) return;
    const geometry::Vec3 end = before.face_mounted ? before.face.to_inner(move->to.tip - before.workpiece_origin)
                                                   : geometry::Vec3(move->to.tip - before.workpiece_origin);
    const double minimum = std::min(*clearance, before.position.tip.z());
    const bool is_tilted = !wanted.face_mounted && (wanted.position.b != 0 || wanted.position.c != 0);
    if (before.face_mounted == wanted.face_mounted && !is_tilted) {
      EXPECT_GE(end.z(), minimum - kRounding) << event.line + 1 << '\n' << restarted;
    }
  });
}

/// Tries lines of a program; returns how many it could be taken up at, of how many.
std::pair<int, int> try_lines(const std::string& program, const running::RunOptions& run_options, Random& random) {
  std::pair<int, int> count;
  RestartOptions options;
  options.run = run_options;
  for (int i = 0; i < 6; ++i) {
    options.line = random.below(line_count(program));
    if (random.one_in(3)) options.clearance = random.between(0, 80);
    const auto made = restart_program(program, options);
    ++count.second;
    if (const auto* const restarted = std::get_if<std::string>(&made)) {
      ++count.first;
      expect_same_course(program, *restarted, options);
      if (!assumes_register(*restarted)) expect_no_new_errors(program, *restarted, options);
      expect_safe_approach(program, *restarted, options);
      continue;
    }
    const auto& refusal = std::get<RestartRefusal>(made);
    EXPECT_NE(refusal.obstacle, RestartObstacle::NotProved) << options.line + 1 << '\n' << program;
    for (const auto& proposed : {refusal.before, refusal.after}) {
      if (!proposed) continue;
      options.line = *proposed;
      EXPECT_TRUE(std::holds_alternative<std::string>(restart_program(program, options))) << *proposed + 1 << '\n'
                                                                                          << program;
    }
  }
  return count;
}

running::RunOptions random_options(Random& random) {
  running::RunOptions options;
  options.vgpl = random.between(0, 4);
  if (random.one_in(2)) options.registers[1] = random.between(0, 4);
  if (random.one_in(3)) options.setup.clearance = random.between(0, 60);
  if (random.one_in(3)) options.setup.home.tip = {-100, 50, 250};
  return options;
}

TEST(RestartProperty, OfJobsGoesOnAsTheProgramDoes) {
  int made = 0;
  int tried = 0;
  for (const std::uint64_t seed : seeds(1500)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const running::RunOptions options = random_options(random);
    const std::string program = runnable(RandomJob(random).lines(), options);
    const auto [more_made, more_tried] = try_lines(program, options, random);
    made += more_made;
    tried += more_tried;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(made, tried / 2);
}

TEST(RestartProperty, OfAnyProgramGoesOnAsTheProgramDoes) {
  int made = 0;
  int tried = 0;
  for (const std::uint64_t seed : seeds(1500)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const running::RunOptions options = random_options(random);
    const std::string program = runnable(RandomProgram(random).lines(random.between(5, 80)), options);
    const auto [more_made, more_tried] = try_lines(program, options, random);
    made += more_made;
    tried += more_tried;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(made, tried / 2);
}

}  // namespace
}  // namespace isocnc::restart
