// What it costs to compare a run with what surrounds it: isocnc_verification_benchmark FILE [head | board].

#include <benchmark/benchmark.h>

#include <cstdio>
#include <string_view>
#include <vector>

#include "interpreter/simulation/compensation.h"
#include "interpreter/solids/tool_shapes.h"
#include "interpreter/system/source_file.h"
#include "interpreter/verification/verified_run.h"
#include "tests/support/threads.h"

namespace isocnc::verification {
namespace {

constexpr execution::ToolCode kTool{1, 1, 1};
constexpr double kToolLength = 100;

solids::RevolvedBody made(solids::BodyOrProblem body) { return std::get<solids::RevolvedBody>(std::move(body)); }

/// 12 cups below the workpiece and 12 clamps around it, a cutter of diameter 10 in a holder, and the nose: all that the
/// programs of isocnc_corpus reach, who stay within 300 mm of the origin, passes them closely and hits nothing.
Scene scene_with(double cup_top, double clamp_distance) {
  Scene scene;
  ToolBodies& tool = scene.tools[kTool];
  tool.length = kToolLength;
  tool.cutter = made(solids::flat_body(5, 60));
  const solids::StackRow holder{.height = 40, .lower_diameter = 40, .upper_diameter = 50};
  tool.holder = made(solids::stacked_body({&holder, 1}, 60));
  const solids::StackRow nose{.height = 120, .lower_diameter = 120, .upper_diameter = 150};
  scene.nose = made(solids::stacked_body({&nose, 1}, 0));
  const auto add = [&](const geometry::Vec3& middle, const geometry::Vec3& size) {
    scene.setup.push_back(
        {.name = "fixture", .shape = solids::Cuboid{middle - size / 2, middle + size / 2}, .described = {}});
  };
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) add({-225.0 + 150 * column, -200.0 + 200 * row, cup_top - 30}, {120, 120, 60});
  const double d = clamp_distance + 20;
  for (const double at : {-200.0, 0.0, 200.0}) {
    add({at, d, 0}, {60, 40, 40});
    add({at, -d, 0}, {60, 40, 40});
    add({d, at, 0}, {40, 60, 40});
    add({-d, at, 0}, {40, 60, 40});
  }
  return scene;
}

struct Case {
  running::RunOptions options() const {
    running::RunOptions options;
    options.setup.home = machine.home;
    return options;
  }

  std::string_view program;
  timing::TimedMachine machine;
  Scene scene;
  std::uint64_t motions = 0;
};

/// As isorun without what surrounds the program.
void run_alone(benchmark::State& state, const Case& of) {
  for (auto _ : state) {
    simulation::RunFindings findings(of.machine);
    timing::Timing timing(of.machine, {.event =
                                           [&](const timing::TimedEvent& timed) {
                                             if (!timed.move) return;
                                             kinematics::MadeMove made(of.machine.motion, *timed.move);
                                             findings.take(timed.event, made);
                                           },
                                       .stretch = {}});
    simulation::Compensation compensation(of.machine);
    const simulation::Compensation::Listeners compensated{
        .event = [&](const running::Event& event) { timing.take(event); },
        .warning = [&](const simulation::RunWarning& warning) { findings.take(warning); }};
    running::RunOptions options = of.options();
    options.before_block = [&](const running::Block& block) { findings.take(block); };
    run(of.program, options, [&](const running::Event& event) {
      findings.take(event);
      compensation.take(event, compensated);
    });
    compensation.finish(compensated);
    timing.finish();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(of.motions));
}

void verify(benchmark::State& state, Case& of, int threads) {
  const WorkTogether together = support::on_threads(threads);
  std::size_t contacts = 0;
  std::size_t near_misses = 0;
  for (auto _ : state) {
    const VerifiedRun run = verified_run(of.program, of.options(), of.machine, &of.scene, together);
    contacts = run.certificate->contacts;
    near_misses = run.contacts.size() - contacts;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(of.motions));
  state.counters["contacts"] = static_cast<double>(contacts);
  state.counters["near_misses"] = static_cast<double>(near_misses);
}

int run_main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const std::string_view kind = argc == 3 ? argv[2] : "";
  const bool is_head = kind == "head";
  if (argc != 2 && !is_head && kind != "board") {
    std::fputs("usage: isocnc_verification_benchmark [BENCHMARK OPTIONS] FILE [head | board]\n", stderr);
    return 2;
  }
  const auto opened = system::SourceFile::open(argv[1], dialect::Language::English);
  if (const auto* const problem = std::get_if<system::SourceFile::Problem>(&opened)) {
    std::fprintf(stderr, "%s: %s\n", argv[1], problem->message.c_str());
    return 2;
  }
  Case of{.program = std::get<system::SourceFile>(opened).text(),
          .machine = {},
          .scene = is_head ? scene_with(-125, 500) : scene_with(-18, 310)};
  // What the cutter of `short` nearly touches wherever it goes.
  if (kind == "board")
    of.scene.setup.push_back({.name = "",
                              .role = BodyRole::Spoilboard,
                              .shape = solids::Cuboid{{-400, -400, -18}, {400, 400, -1.25}},
                              .described = {}});
  of.machine.tool_lengths[kTool] = kToolLength;
  of.machine.home.tip.z() = 400;
  if (is_head) of.machine.motion.kinematics.kind = kinematics::MachineKind::Head;
  of.motions = verified_run(of.program, of.options(), of.machine, &of.scene).certificate->motions;
  const auto add = [](const char* name, auto&& act) {
    benchmark::RegisterBenchmark(name, act)->Unit(benchmark::kMillisecond)->UseRealTime();
  };
  add("run_alone", [&of](benchmark::State& state) { run_alone(state, of); });
  add("verify/threads:1", [&of](benchmark::State& state) { verify(state, of, 1); });
  add("verify/threads:2", [&of](benchmark::State& state) { verify(state, of, 2); });
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace isocnc::verification

int main(int argc, char** argv) { return isocnc::verification::run_main(argc, argv); }
