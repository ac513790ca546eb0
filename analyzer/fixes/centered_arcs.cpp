#include "analyzer/fixes/centered_arcs.h"

#include <algorithm>
#include <cmath>

#include "analyzer/fixes/line_edits.h"
#include "interpreter/dialect/format.h"
#include "interpreter/execution/execute.h"
#include "interpreter/execution/silent_sink.h"

namespace isocnc::fixes {

using geometry::PlanePoint;
using syntax::LineTree;
using syntax::Word;

namespace {

/// Collects the arcs of one line.
class ArcCollector final : public execution::Sink {
 public:
  explicit ArcCollector(double tolerance) : Sink(false), tolerance_(tolerance) {}
  void report(const syntax::Finding&) override {}
  void centered_arc(const execution::CenteredArc& read) override {
    ++count;
    start_is_known = read.start_is_known;
    centers = read.centers();
    arc = {.plane = &read.plane,
           .given = read.given,
           .start = read.start,
           .incremental = read.incremental,
           .mm_per_unit = read.mm_per_unit,
           .readings = geometry::read_center_in_both_modes(read.given, read.start, read.incremental, tolerance_)};
  }

  int count = 0;
  bool start_is_known = false;
  syntax::Span centers;
  ArcOfProgram arc;

 private:
  double tolerance_;
};

}  // namespace

std::optional<ArcOfProgram> arc_on(const LineTree& line, const execution::State& before,
                                   const execution::Setup& setup) {
  ArcCollector collector(setup.arc_tolerance);
  execution::State state = before;
  execution::execute(line, state, setup, collector);
  if (collector.count != 1 || !collector.start_is_known) return std::nullopt;
  ArcOfProgram& arc = collector.arc;
  if (line.text_of(collector.centers).find('(') != std::string_view::npos) return std::nullopt;
  for (const Word& word : line.words) {
    if (word.begin < collector.centers.begin || word.end > collector.centers.end) continue;
    if (word.has(Word::kReported)) return std::nullopt;  // A word with a finding, such as I=5.
    if (word.letter == arc.plane->u_center) arc.center_u = &word;
    if (word.letter == arc.plane->v_center) arc.center_v = &word;
  }
  return arc;
}

bool may_be_arc(const LineTree& line, const execution::State& before, const execution::Setup& setup) {
  execution::SilentSink ignored;
  execution::State state = before;
  execution::execute(line, state, setup, ignored);
  return !state.motion() || state.motion()->is_arc();
}

int decimals_of_center(const LineTree& line, const ArcOfProgram& arc) {
  int decimals = 3;
  for (const Word* const word : {arc.center_u, arc.center_v})
    if (word) decimals = std::max(decimals, decimals_of(line.text_of(word->span())));
  return decimals;
}

PlanePoint rounded_center(const ArcOfProgram& arc, PlanePoint center, int decimals) {
  const double unit = std::pow(10, decimals);
  const PlanePoint exact = arc.in_program(center);
  return arc.from_start({std::round(exact.u * unit) / unit, std::round(exact.v * unit) / unit});
}

WrittenCenter center_written(const ArcOfProgram& arc, std::size_t line, PlanePoint center, int decimals) {
  const PlanePoint in_program = arc.in_program(center);
  const std::string u = arc.plane->u_center + dialect::written_number(in_program.u, decimals);
  const std::string v = arc.plane->v_center + dialect::written_number(in_program.v, decimals);
  const auto edit = [&](std::uint32_t begin, std::uint32_t end, std::string text) {
    return Edit{{line, begin}, {line, end}, std::move(text)};
  };
  const auto both = [&](bool u_first) { return u_first ? u + " " + v : v + " " + u; };
  if (arc.center_u && arc.center_v)
    return {{edit(arc.center_u->begin, arc.center_u->end, u), edit(arc.center_v->begin, arc.center_v->end, v)},
            both(arc.center_u->begin < arc.center_v->begin)};
  const Word& given = arc.center_u ? *arc.center_u : *arc.center_v;
  std::string words = both(arc.plane->u_center < arc.plane->v_center);
  return {{edit(given.begin, given.end, words)}, words};
}

}  // namespace isocnc::fixes
