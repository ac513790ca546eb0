#include "lsp/documents/line_run.h"

#include "interpreter/execution/execute.h"

namespace isocnc::lsp::documents {

namespace {

/// Keeps the motion of a line.
class MoveKeeper final : public execution::Sink {
 public:
  explicit MoveKeeper(LineRun& run) : Sink(true), run_(run) {}
  void report(const syntax::Finding&) override {}
  void move(const execution::Move& move, const execution::State& state) override {
    run_.move = move;
    run_.moved_in = state;
  }
  void dwell(double seconds) override { run_.dwell = seconds; }

 private:
  LineRun& run_;
};

}  // namespace

static LineRun run_from(const Snapshot& snapshot, const execution::State& before, const syntax::LineTree& line) {
  LineRun run{.before = before, .after = before, .move = {}, .moved_in = {}};
  MoveKeeper keeper(run);
  execution::execute(line, run.after, snapshot.setup(), keeper);
  return run;
}

std::optional<LineRun> run_line(const Snapshot& snapshot, std::size_t line) {
  if (line >= snapshot.document().line_count()) return std::nullopt;
  const auto before = snapshot.state_before(line);
  if (!before) return std::nullopt;
  const syntax::DocumentLine read = snapshot.document().line(line);
  return run_from(snapshot, *before, *read);
}

std::vector<LineRun> run_line_on_all_paths(const Snapshot& snapshot, std::size_t line) {
  if (line >= snapshot.document().line_count()) return {};
  const check::Frontier frontier = snapshot.frontier_before(line);
  if (frontier.reduced) return {};
  const syntax::DocumentLine read = snapshot.document().line(line);
  std::vector<LineRun> runs;
  const check::Groups groups = frontier.live_at(*read);
  for (const check::Group& group : groups) runs.push_back(run_from(snapshot, group.state, *read));
  return runs;
}

}  // namespace isocnc::lsp::documents
