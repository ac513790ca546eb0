#include "lsp/queries/line_run.h"

#include "interpreter/execution/block_recorder.h"

namespace isocnc::queries {

static LineRun run_from(const documents::Snapshot& snapshot, const execution::State& before,
                        const syntax::LineTree& line) {
  const execution::BlockRecorder done(line, before, snapshot.setup());
  LineRun run{.before = before, .after = done.state(), .move = {}, .moved_in = {}, .dwell = done.dwell()};
  if (done.motion()) {
    run.move = done.motion()->move;
    run.moved_in = done.motion()->state;
  }
  return run;
}

std::optional<LineRun> run_line(const documents::Snapshot& snapshot, std::size_t line) {
  if (line >= snapshot.document().line_count()) return std::nullopt;
  const auto before = snapshot.state_before(line);
  if (!before) return std::nullopt;
  const syntax::DocumentLine read = snapshot.document().line(line);
  return run_from(snapshot, *before, *read);
}

std::vector<LineRun> run_line_on_all_paths(const documents::Snapshot& snapshot, std::size_t line) {
  if (line >= snapshot.document().line_count()) return {};
  const check::Frontier frontier = snapshot.frontier_before(line);
  if (frontier.reduced) return {};
  const syntax::DocumentLine read = snapshot.document().line(line);
  std::vector<LineRun> runs;
  const check::Groups groups = frontier.live_at(*read);
  for (const check::Group& group : groups) runs.push_back(run_from(snapshot, group.state, *read));
  return runs;
}

bool is_never_reached(const documents::Snapshot& snapshot, std::size_t line) {
  if (line >= snapshot.document().line_count()) return false;
  const check::Frontier frontier = snapshot.frontier_before(line);
  const syntax::DocumentLine read = snapshot.document().line(line);
  return !frontier.reduced && frontier.live_at(*read).empty();
}

}  // namespace isocnc::queries
