#include <algorithm>
#include <cmath>
#include <optional>

#include "analyzer/fixes/line_edits.h"
#include "interpreter/execution/executor.h"

namespace isocnc::analyzer::fixes {

using dialect::ModalGroup;
using execution::Plane;
using execution::State;
using geometry::PlanePoint;
using syntax::Instruction;
using syntax::InstructionKind;
using syntax::LineTree;
using syntax::Word;

/// Half of what the control accepts: W112 says nothing of such an arc. mm.
static constexpr double kFits = 0.005;

/// Ten times what the control accepts: up to here a center was meant to fit, and has been rounded or measured. mm.
static constexpr double kNearlyFits = 0.1;

namespace {

/// An arc as it is written, and where it starts; mm, in the frame in force.
struct WrittenArc {
  Plane plane;
  bool incremental = false;
  double mm_per_unit = 1;
  PlanePoint start;
  PlanePoint end;
  const Word* center_u = nullptr;  ///< Null: not written.
  const Word* center_v = nullptr;

  /// The center, should its words count from the start (`from_start`) or from the frame's origin.
  PlanePoint center(bool from_start) const {
    const PlanePoint origin = from_start ? start : PlanePoint{};
    return {origin.u + center_u->value * mm_per_unit, origin.v + center_v->value * mm_per_unit};
  }
  /// How much farther the center is from one end than from the other.
  double mismatch(PlanePoint center) const { return std::abs((center - start).norm() - (center - end).norm()); }
  bool fits(PlanePoint center) const { return (center - start).norm() > 2 * kFits && mismatch(center) < kFits; }
  /// As the program has to write a coordinate of the center.
  double in_program(double coordinate, double start_coordinate) const {
    return (incremental ? coordinate - start_coordinate : coordinate) / mm_per_unit;
  }
};

}  // namespace

/// The state in which the line's motion runs: what stands before it on the line may be new.
static std::optional<State> state_at_motion(const Request& request, const Instruction& motion) {
  std::optional<State> state = request.program.state_before(request.number);
  if (!state || (state->unknown & execution::kLinearAxes) != 0) return std::nullopt;
  for (const Instruction& earlier : request.line.instructions) {
    if (&earlier == &motion) break;
    const dialect::GCode* const code = earlier.kind == InstructionKind::G ? earlier.g() : nullptr;
    if (!code || code->takes_arguments() || code->group == ModalGroup::None) continue;
    if (code->group == ModalGroup::Face) return std::nullopt;
    state->set_mode(code->group, static_cast<std::uint8_t>(code->number));
  }
  return state;
}

static const Instruction* marked_motion(const Request& request) {
  const Word* const word = word_at(request.line, request.finding.span);
  const Instruction* const motion = word ? owner_of(request.line, *word) : nullptr;
  return motion && motion->is_motion() ? motion : nullptr;
}

static std::optional<WrittenArc> written_arc(const Request& request) {
  const Instruction* const motion = marked_motion(request);
  const std::optional<State> state = motion ? state_at_motion(request, *motion) : std::nullopt;
  if (!state) return std::nullopt;
  WrittenArc arc{.plane = execution::plane_in_force(*state),
                 .incremental = state->incremental(),
                 .mm_per_unit = state->mm_per_unit()};
  arc.start = {state->position.tip[arc.plane.u], state->position.tip[arc.plane.v]};
  arc.end = arc.start;
  for (std::size_t i = motion->begin; i < motion->end; ++i) {
    const Word& word = request.line.words[i];
    if (word.owner != motion->number || word.letter == 'G') continue;
    if (!word.known() || request.line.text_of(word.span()).find('(') != std::string_view::npos) return std::nullopt;
    const double value = word.value * arc.mm_per_unit;
    if (word.letter == arc.plane.u_letter) arc.end.u = value + (arc.incremental ? arc.start.u : 0);
    if (word.letter == arc.plane.v_letter) arc.end.v = value + (arc.incremental ? arc.start.v : 0);
    if (word.letter == arc.plane.u_center) arc.center_u = &word;
    if (word.letter == arc.plane.v_center) arc.center_v = &word;
  }
  return arc;
}

static int decimals_of(const Request& request, const Word& word) {
  const std::string_view text = request.line.text_of(word.span());
  const std::size_t point = text.find('.');
  return point == std::string_view::npos ? 0 : static_cast<int>(std::min<std::size_t>(text.size() - point - 1, 9));
}

/// Writes the center with as few decimals as let the arc fit, at least those that are there.
static Draft center_written(const Request& request, const WrittenArc& arc, PlanePoint center) {
  if (!arc.fits(center)) return {};
  const double u = arc.in_program(center.u, arc.start.u);
  const double v = arc.in_program(center.v, arc.start.v);
  const auto rounded = [&](double value, int decimals) {
    return std::round(value * std::pow(10, decimals)) / std::pow(10, decimals) * arc.mm_per_unit;
  };
  const PlanePoint origin = arc.incremental ? arc.start : PlanePoint{};
  int decimals = std::max({decimals_of(request, *arc.center_u), decimals_of(request, *arc.center_v), 3});
  while (decimals < 9 &&
         !(arc.mismatch({origin.u + rounded(u, decimals), origin.v + rounded(v, decimals)}) < kFits / 2))
    ++decimals;
  std::string u_word = arc.plane.u_center + written(u, decimals);
  std::string v_word = arc.plane.v_center + written(v, decimals);
  std::string what = arc.center_u->begin < arc.center_v->begin ? u_word + " " + v_word : v_word + " " + u_word;
  return {{replaced(request, arc.center_u->span(), std::move(u_word)),
           replaced(request, arc.center_v->span(), std::move(v_word))},
          std::move(what)};
}

/// I and J count from the start on other controls, or are meant so: the arc fits when they do. Any center fits a full
/// turn, which proves nothing.
Draft center_from_start(const Request& request) {
  const std::optional<WrittenArc> arc = written_arc(request);
  if (!arc || !arc->center_u || !arc->center_v || (arc->end - arc->start).norm() < kFits) return {};
  return center_written(request, *arc, arc->center(!arc->incremental));
}

/// The nearest point that is as far from one end as from the other. A center that is far off may as well be right, and
/// an end wrong.
Draft center_between_ends(const Request& request) {
  const std::optional<WrittenArc> arc = written_arc(request);
  if (!arc || !arc->center_u || !arc->center_v) return {};
  const PlanePoint chord = arc->end - arc->start;
  if (!(chord.norm() > 2 * kFits)) return {};
  PlanePoint center = arc->center(arc->incremental);
  if (arc->mismatch(center) > kNearlyFits) return {};
  const PlanePoint middle = {(arc->start.u + arc->end.u) / 2, (arc->start.v + arc->end.v) / 2};
  const PlanePoint off = center - middle;
  const double share = (off.u * chord.u + off.v * chord.v) / (chord.norm() * chord.norm());
  center = {center.u - share * chord.u, center.v - share * chord.v};
  return center_written(request, *arc, center);
}

/// G02 X20 I10: the other coordinate is that of the start, and the arc a half circle or a full turn.
Draft center_completed(const Request& request) {
  const std::optional<WrittenArc> arc = written_arc(request);
  if (!arc || (arc->center_u != nullptr) == (arc->center_v != nullptr)) return {};
  const bool has_u = arc->center_u != nullptr;
  const Word& given = has_u ? *arc->center_u : *arc->center_v;
  const double value = given.value * arc->mm_per_unit;
  PlanePoint center = arc->start;
  if (has_u) {
    center.u = value + (arc->incremental ? arc->start.u : 0);
  } else {
    center.v = value + (arc->incremental ? arc->start.v : 0);
  }
  if (!arc->fits(center)) return {};
  const double missing = has_u ? arc->in_program(center.v, arc->start.v) : arc->in_program(center.u, arc->start.u);
  const char letter = has_u ? arc->plane.v_center : arc->plane.u_center;
  std::string word = letter + written(missing, 6);
  if (letter < given.letter) return {{inserted(request, given.begin, word + " ")}, word};
  return {{inserted(request, given.end, " " + word)}, word};
}

/// R9.999 where half the way is 10: a rounding.
Draft radius_large_enough(const Request& request) {
  const double radius = request.finding.values[0];
  const double needed = request.finding.values[1];
  const Instruction* const motion = marked_motion(request);
  const std::optional<State> state = motion ? state_at_motion(request, *motion) : std::nullopt;
  if (!state || !(radius > 0) || needed - radius > needed / 20) return {};
  if (request.marked().find('(') != std::string_view::npos) return {};
  const double least = std::ceil(needed / state->mm_per_unit() * 1e4 - 1e-6) / 1e4;
  std::string word = request.marked().front() + written(least, 4);
  return {{replaced(request, request.finding.span, word)}, word};
}

}  // namespace isocnc::analyzer::fixes
