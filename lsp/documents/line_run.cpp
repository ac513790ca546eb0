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

 private:
  LineRun& run_;
};

}  // namespace

std::optional<LineRun> run_line(const Snapshot& snapshot, std::size_t line) {
  if (line >= snapshot.document().line_count()) return std::nullopt;
  const auto before = snapshot.state_before(line);
  if (!before) return std::nullopt;
  LineRun run{.before = *before, .after = *before, .move = {}, .moved_in = {}};
  MoveKeeper keeper(run);
  const syntax::DocumentLine read = snapshot.document().line(line);
  execution::execute(*read, run.after, snapshot.setup(), keeper);
  return run;
}

}  // namespace isocnc::lsp::documents
