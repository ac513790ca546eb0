// What it costs to run a program on the simulated machine, and to go back in it: isocnc_history_benchmark FILE.

#include "interpreter/simulation/history.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <random>
#include <string_view>
#include <variant>

#include "interpreter/system/source_file.h"

namespace isocnc::running {
namespace {

/// The program, and a history that has come to its end.
struct Case {
  explicit Case(std::string_view text) : program(text), history(simulation::Simulation(program, options, machine)) {}

  Program program;
  RunOptions options;
  timing::TimedMachine machine;
  simulation::History history;
};

void count_blocks(benchmark::State& state, std::uint64_t blocks) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(blocks));
}

void interpret(benchmark::State& state, const Case& of) {
  RunResult result;
  for (auto _ : state)
    result = run(of.program.text(), of.options, [](const Event& event) { benchmark::DoNotOptimize(&event); });
  count_blocks(state, result.blocks);
}

void simulate(benchmark::State& state, const Case& of) {
  simulation::Simulation simulation(of.program, of.options, of.machine);
  for (auto _ : state) {
    simulation = simulation::Simulation(of.program, of.options, of.machine);
    while (!simulation.has_ended()) simulation.step_block();
  }
  count_blocks(state, simulation.blocks());
}

/// The first of all: it keeps what the others go back to.
void simulate_with_history(benchmark::State& state, Case& of) {
  for (auto _ : state) of.history.go_to_block(std::numeric_limits<std::uint64_t>::max());
  count_blocks(state, of.history.present().blocks());
  state.counters["MiB"] = static_cast<double>(of.history.memory()) / (1 << 20);
}

/// Also reports how long one call takes at worst, in processor time.
template <class Do>
void time_each(benchmark::State& state, Do&& act) {
  std::clock_t worst = 0;
  for (auto _ : state) {
    const std::clock_t start = std::clock();
    act();
    worst = std::max(worst, std::clock() - start);
  }
  state.counters["worst_ms"] = 1e3 * static_cast<double>(worst) / CLOCKS_PER_SEC;
}

void step_back(benchmark::State& state, Case& of, std::uint64_t from) {
  of.history.go_to_block(from);
  time_each(state, [&] { of.history.step_back(); });
}

void go_anywhere(benchmark::State& state, Case& of, std::uint64_t blocks) {
  std::mt19937_64 random(1);
  time_each(state, [&] { of.history.go_to_block(random() % blocks); });
}

void find_nothing(benchmark::State& state, const Case& of, std::uint64_t blocks) {
  for (auto _ : state) benchmark::DoNotOptimize(of.history.find_before(blocks, [](const Block&) { return false; }));
  count_blocks(state, blocks);
}

/// Blocks of the whole program.
std::uint64_t blocks_of(const Case& of) {
  return run(of.program.text(), of.options, [](const Event&) {}).blocks;
}

void register_all(Case& of) {
  using benchmark::RegisterBenchmark;
  const std::uint64_t blocks = blocks_of(of);
  const auto in_ms = [](benchmark::internal::Benchmark* each) { each->Unit(benchmark::kMillisecond); };
  in_ms(RegisterBenchmark("simulate_with_history", [&of](auto& state) {
          simulate_with_history(state, of);
        })->Iterations(1));
  in_ms(RegisterBenchmark("step_back/end", [&of, blocks](auto& state) {
          step_back(state, of, blocks);
        })->Iterations(5'000));
  in_ms(RegisterBenchmark("step_back/middle", [&of, blocks](auto& state) {
          step_back(state, of, blocks / 2);
        })->Iterations(5'000));
  in_ms(RegisterBenchmark("go_anywhere", [&of, blocks](auto& state) {
          go_anywhere(state, of, blocks);
        })->Iterations(1'000));
  in_ms(RegisterBenchmark("find_nothing", [&of, blocks](auto& state) { find_nothing(state, of, blocks); }));
  in_ms(RegisterBenchmark("interpret", [&of](auto& state) { interpret(state, of); }));
  in_ms(RegisterBenchmark("simulate", [&of](auto& state) { simulate(state, of); }));
}

int run_main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fputs("usage: isocnc_history_benchmark [BENCHMARK OPTIONS] FILE\n", stderr);
    return 2;
  }
  const auto opened = system::SourceFile::open(argv[1], dialect::Language::English);
  if (const auto* const problem = std::get_if<system::SourceFile::Problem>(&opened)) {
    std::fprintf(stderr, "%s: %s\n", argv[1], problem->message.c_str());
    return 2;
  }
  Case of(std::get<system::SourceFile>(opened).text());
  register_all(of);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace isocnc::running

int main(int argc, char** argv) { return isocnc::running::run_main(argc, argv); }
