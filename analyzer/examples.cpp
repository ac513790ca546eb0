#include "analyzer/examples.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/fixes/fix_table.h"
#include "analyzer/fixing/finding_fixes.h"
#include "analyzer/selection/shown_report.h"
#include "analyzer/selection/verified.h"
#include "interpreter/solids/tool_shapes.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::analyzer {

using namespace dialect::literals;
using dialect::Cause;
using dialect::DiagnosticDef;
using dialect::DiagnosticId;

MarkedProgram read_marked(std::string_view program) {
  MarkedProgram marked;
  std::size_t line = 0;
  std::size_t line_start = 0;
  for (std::size_t i = 0; i < program.size(); ++i) {
    const std::string_view rest = program.substr(i);
    if (rest.starts_with("[!")) {
      marked.has_mark = true;
      marked.line = line;
      marked.begin = marked.text.size() - line_start;
      ++i;
    } else if (rest.starts_with("!]")) {
      marked.end = marked.text.size() - line_start;
      ++i;
    } else {
      marked.text.push_back(program[i]);
      if (program[i] != '\n') continue;
      ++line;
      line_start = marked.text.size();
    }
  }
  return marked;
}

std::string_view wrong_program(Cause cause) {
  const DiagnosticDef& def = dialect::definition(cause.id);
  return cause.number == 0 ? def.wrong : def.causes[cause.number - 1].wrong;
}

/// The rules of a shop that the example programs of W143 break.
static std::vector<dialect::HouseWatch> example_house_rules() {
  using dialect::HouseEvent;
  using dialect::HouseWatch;
  const HouseEvent tool_change{.kind = HouseEvent::Kind::ToolChange};
  HouseWatch coolant{.rule = "coolant",
                     .message = {.en = "coolant before the first cut of each tool",
                                 .it = "il refrigerante va acceso prima del primo taglio di ogni utensile"},
                     .reported = {{.kind = HouseEvent::Kind::Cut}},
                     .started = {tool_change},
                     .ended = {{.kind = HouseEvent::Kind::M, .number = 8}}};
  const auto of_drill = [](std::string rule, HouseWatch::BilingualText message, HouseWatch::Kind kind) {
    return HouseWatch{.rule = std::move(rule),
                      .message = std::move(message),
                      .kind = kind,
                      .tools = {{.first = 101002, .last = 101002}}};
  };
  HouseWatch speed = of_drill("drill-speed", {.en = "our drills", .it = "le nostre punte"}, HouseWatch::Kind::Speed);
  speed.minimum = 3'000;
  speed.maximum = 12'000;
  HouseWatch feed = of_drill("drill-feed", {.en = "our drills", .it = "le nostre punte"}, HouseWatch::Kind::Feed);
  feed.minimum = 100;
  feed.maximum = 2'000;
  HouseWatch depth = of_drill("drill-depth", {.en = "our drills are short", .it = "le nostre punte sono corte"},
                              HouseWatch::Kind::Depth);
  depth.minimum = -20;
  return {std::move(coolant), std::move(speed), std::move(feed), std::move(depth)};
}

rules::CheckSetup example_setup(DiagnosticId id) {
  rules::CheckSetup setup;
  if (id == "tool-not-configured"_diag) setup.machine.tools = {{1, 1, 1}};
  if (id == "unnamed-function"_diag) setup.machine.functions = {100};
  if (id == "travel-exceeded"_diag) setup.machine.limits.travel[0] = {0, 1000};
  if (id == "feed-above-machine"_diag) setup.machine.limits.feed = 10'000;
  if (id == "rotary-speed-above-machine"_diag) setup.machine.limits.rotary_speed = 3'600;
  if (id == "spindle-speed-above-machine"_diag) setup.machine.limits.spindle_speed = 18'000;
  if (id == "rapid-below-clearance"_diag) setup.machine.clearance = 5;
  if (id == "house-rule"_diag) setup.house_rules = std::make_shared<const rules::HouseRules>(example_house_rules());
  setup.every_motion = dialect::definition(id).is_off;
  return setup;
}

check::Report example_report(std::string_view program, DiagnosticId id) {
  selection::Selection selection;
  selection.follow({.severities = {std::string(dialect::definition(id).code) + "=warning"}},
                   dialect::Language::English);
  return selection::shown_report(check::check_text(program, example_setup(id)), program, selection);
}

/// A program with more machine states than are followed: each of its jumps doubles them.
static std::string program_of_many_paths() {
  constexpr int kJumps = 10;
  std::string program = "M06 T101001\nG91\n";
  for (int i = 1; i <= kJumps; ++i) program += fmt::format("IF VGPL = {0} GOTO N{0}\nG00 X{1}\nN{0}\n", i, 1 << i);
  return program + "M02\n";
}

static std::string program_of_long_line() {
  std::string program = "M06 T101001\nG00";
  for (std::size_t i = 0; i < syntax::kMaxWords; ++i) program += fmt::format(" X{}", i);
  return program + "\nM02\n";
}

/// The program that shows a cause, without marks.
static std::string program_of(Cause cause) {
  if (cause.id == "too-many-paths"_diag) return program_of_many_paths();
  if (cause.id == "line-too-long"_diag) return program_of_long_line();
  if (cause.id == "center-legal-both-ways"_diag)
    return "M06 T101001\nG00 X100\nG02 X120 Y0 I10 J0 F1000\nG02 X120 Y0 I5 J0\nM02\n";
  return read_marked(wrong_program(cause)).text;
}

/// A setup with one of each: a clamp, a board, and the finished part.
static verification::Scene example_scene() {
  using verification::BodyRole;
  const auto body = [](std::string name, BodyRole role, const geometry::Vec3& minimum, const geometry::Vec3& maximum) {
    return verification::SceneBody{
        .name = std::move(name), .role = role, .shape = solids::Cuboid{.minimum = minimum, .maximum = maximum}};
  };
  verification::Scene scene{.target_tolerance = 0.2};
  verification::ToolBodies& cutter = scene.tools[{1, 1, 1}];
  cutter.length = 100;
  cutter.cutter = std::get<solids::RevolvedBody>(solids::flat_body(10, 100));
  scene.tools[{1, 1, 2}].length = 100;
  scene.setup = {body("clamp 1", BodyRole::Fixture, {180, 0, 0}, {220, 40, 30}),
                 body("", BodyRole::Spoilboard, {-1000, -1000, -100}, {1000, 1000, -19}),
                 body("", BodyRole::Target, {70, 20, -18}, {170, 100, -2})};
  return scene;
}

/// A setup with a blank that a clamp holds, and what the material's findings need besides.
static verification::Scene example_of_material(DiagnosticId id) {
  using verification::BodyRole;
  const auto made = [](solids::BodyOrProblem body) { return std::get<solids::RevolvedBody>(std::move(body)); };
  verification::Scene scene;
  verification::ToolBodies& cutter = scene.tools[{1, 1, 1}];
  cutter.length = 100;
  cutter.cutter = made(solids::flat_body(10, 60));
  const solids::StackRow holder{.height = 40, .lower_diameter = 50, .upper_diameter = 50};
  cutter.holder = made(solids::stacked_body({&holder, 1}, 60));
  verification::ToolBodies& mill = scene.tools[{1, 1, 2}];
  mill.length = 100;
  mill.cutter = made(solids::flat_body(60, 100));
  verification::ToolBodies& small = scene.tools[{1, 1, 3}];
  small = cutter;
  small.max_depth = 10;
  verification::ToolBodies& edge = scene.tools[{1, 1, 4}];
  edge.length = 100;
  edge.cutter = made(solids::flat_body(5, 20));
  const solids::FormPoint shank[] = {{20, 5}, {100, 5}};
  edge.shank = made(solids::form_body(shank));
  const auto body = [](BodyRole role, const geometry::Vec3& minimum, const geometry::Vec3& maximum) {
    return verification::SceneBody{.role = role, .shape = solids::Cuboid{.minimum = minimum, .maximum = maximum}};
  };
  scene.setup = {body(BodyRole::Stock, {300, 100, 0}, {400, 200, 40})};
  if (id == "loose-piece"_diag) scene.setup.push_back(body(BodyRole::Fixture, {280, 95, 0}, {300, 105, 40}));
  if (id == "material-left"_diag) scene.setup.push_back(body(BodyRole::Target, {300, 100, 0}, {400, 200, 30}));
  return scene;
}

std::vector<simulation::RunFinding> example_run(std::string_view program, DiagnosticId id) {
  timing::TimedMachine machine;
  machine.tool_radii[{1, 1, 1}] = 10;
  if (id == "joint-travel"_diag) {
    machine.motion.axes[0].minimum = 0;
    machine.motion.axes[0].maximum = 1000;
  }
  const dialect::Evidence evidence = dialect::definition(id).evidence;
  const bool is_of_material = evidence == dialect::Evidence::Stock;
  if (evidence == dialect::Evidence::Run && id != "not-verified"_diag)
    return selection::verified_on_paths(program, {}, machine, nullptr).outcome.findings;
  for (int tool = 1; tool <= 4; ++tool)
    if (is_of_material || tool <= 2) machine.tool_lengths[{1, 1, tool}] = 100;
  machine.home.tip.z() = 300;
  running::RunOptions options;
  options.setup.home = machine.home;
  const verification::Scene scene = is_of_material ? example_of_material(id) : example_scene();
  return selection::verified_on_paths(program, options, machine, &scene).outcome.findings;
}

/// A stock whose resolution is too fine takes a setup of its own.
static Example example_of_fine_stock(Cause cause) {
  verification::Scene scene = example_of_material(cause.id);
  scene.resolution = 1e-4;
  const std::string program = "M06 T101001\nM02\n";
  for (const simulation::RunFinding& found :
       selection::verified_on_paths(program, {}, timing::TimedMachine(), &scene).outcome.findings)
    if (found.finding.has(cause)) return {.line = "M06 T101001", .finding = found.finding};
  return {};
}

/// A setup with a mistake is no part of a program.
static Example example_of_mistaken_setup(Cause cause) {
  const std::string program = "M06 T101001\nM02\n";
  verification::VerifiedRun run = selection::verified_on_paths(program, {}, timing::TimedMachine(), nullptr);
  verification::add_gap(run, {.gap = verification::Gap::SetupMistaken}, program);
  for (const simulation::RunFinding& found : run.outcome.findings)
    if (found.finding.has(cause)) return {.line = "M06 T101001", .finding = found.finding};
  return {};
}

static std::optional<Example> example_of_run(Cause cause) {
  if (cause.id == "not-verified"_diag && cause.number == "not-verified/resolution-too-fine"_cause.number)
    return example_of_fine_stock(cause);
  if (cause.id == "not-verified"_diag && cause.number == "not-verified/setup-mistaken"_cause.number)
    return example_of_mistaken_setup(cause);
  const std::string program = program_of(cause);
  syntax::LineFinder lines(program);
  for (const simulation::RunFinding& found : example_run(program, cause.id))
    if (found.finding.has(cause)) return Example{.line = std::string(lines.line(found.line)), .finding = found.finding};
  return std::nullopt;
}

std::optional<Example> example_of(Cause cause) {
  if (dialect::definition(cause.id).is_reported_by_runs()) return example_of_run(cause);
  const std::string program = program_of(cause);
  const rules::CheckSetup setup = example_setup(cause.id);
  const check::Report report = example_report(program, cause.id);
  fixing::FindingFixes fixes(program, report, setup);
  syntax::LineFinder lines(program);
  for (const check::LocatedFinding& located : report.findings)
    if (located.finding.has(cause))
      return Example{
          .line = std::string(lines.line(located.line)), .finding = located.finding, .fix = fixes.offered(located)};
  return std::nullopt;
}

std::vector<fixes::Fix> example_fixes(DiagnosticId id) {
  std::vector<fixes::Fix> offered;
  for (std::uint8_t number = 0; number < dialect::cause_count(dialect::definition(id)); ++number)
    if (std::optional<Example> example = example_of({id, number}); example && example->fix)
      offered.push_back(*std::move(example->fix));
  std::vector<fixes::Fix> all;
  for (const fixes::FixDef& row : fixes::kFixes) {
    if (row.diagnostic != id) continue;
    const auto is_of_row = [&](const fixes::Fix& fix) { return fix.title.en == row.title.en; };
    const auto found = std::find_if(offered.begin(), offered.end(), is_of_row);
    all.push_back(found != offered.end()
                      ? *found
                      : fixes::Fix{.safety = row.safety, .title = row.title, .marked = "...", .what = "..."});
  }
  if (all.empty()) all.push_back({.safety = fixes::Safety::None, .title = fixes::kMeaningUnknown});
  return all;
}

}  // namespace isocnc::analyzer
