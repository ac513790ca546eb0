#include <cmath>
#include <optional>

#include "analyzer/fixes/centered_arcs.h"
#include "analyzer/fixes/habits.h"
#include "analyzer/fixes/line_edits.h"
#include "interpreter/dialect/format.h"

namespace isocnc::fixes {

using execution::State;
using geometry::PlanePoint;
using syntax::Instruction;
using syntax::Word;

static std::optional<ArcOfProgram> marked_arc(const FixRequest& request) {
  const std::optional<State> before = request.program.state_before(request.number);
  return before ? arc_on(request.line, *before, request.program.setup()) : std::nullopt;
}

static Habit habit_of(const ArcOfProgram& arc) { return arc.incremental ? Habit::CentersInG91 : Habit::CentersInG90; }

/// The difference between a center's distances from both ends of the arc.
static double misfit(const ArcOfProgram& arc, PlanePoint center) {
  return std::abs(center.norm() - (center - arc.given.end).norm());
}

/// Whether the center may be meant from the other origin: then this arc alone does not show the right center (D70).
/// Under G91 all controls count from the start, so another arc must show the habit.
static bool may_mean_other_origin(const FixRequest& request, const ArcOfProgram& arc) {
  if (arc.readings.is_same_center) return false;
  const bool fits_other = arc.readings.nearly_fits_other(request.program.setup().arc_tolerance);
  return (fits_other && !arc.incremental) || request.program.habits().shows(habit_of(arc));
}

/// Writes a center with the fewest decimals with which the arc fits well, but no fewer than are written.
static Draft fitting_center(const FixRequest& request, const ArcOfProgram& arc, PlanePoint center) {
  const double tolerance = request.program.setup().arc_tolerance;
  if (!(center.norm() > tolerance && misfit(arc, center) < tolerance / 2)) return {};
  int decimals = decimals_of_center(request.line, arc);
  while (decimals < kMaxDecimals && !(misfit(arc, rounded_center(arc, center, decimals)) < tolerance / 4)) ++decimals;
  WrittenCenter written = center_written(arc, request.number, center, decimals);
  return {std::move(written.edits), std::move(written.words)};
}

/// On other controls I and J count from the start, and some authors write them so: rewrites all centers or none.
Draft center_from_other_origin(const FixRequest& request) {
  const std::optional<ArcOfProgram> arc = marked_arc(request);
  return arc ? habit_draft(request, habit_of(*arc)) : Draft{};
}

/// The nearest point that is equally far from both ends. If the center is far off, it may be right and an end wrong.
Draft center_between_ends(const FixRequest& request) {
  const std::optional<ArcOfProgram> arc = marked_arc(request);
  if (!arc || !arc->center_u || !arc->center_v || may_mean_other_origin(request, *arc)) return {};
  const double tolerance = request.program.setup().arc_tolerance;
  const PlanePoint chord = arc->given.end;
  if (!(chord.norm() > tolerance)) return {};
  const PlanePoint center{*arc->given.center_u, *arc->given.center_v};
  if (misfit(*arc, center) > geometry::CenterReadings::kNearly * tolerance) return {};
  const PlanePoint off{center.u - chord.u / 2, center.v - chord.v / 2};
  const double share = (off.u * chord.u + off.v * chord.v) / (chord.norm() * chord.norm());
  return fitting_center(request, *arc, {center.u - share * chord.u, center.v - share * chord.v});
}

/// G02 X20 I10: takes the missing coordinate from the start, which gives a half circle or a full turn.
Draft center_completed(const FixRequest& request) {
  const std::optional<ArcOfProgram> arc = marked_arc(request);
  if (!arc || (arc->center_u != nullptr) == (arc->center_v != nullptr)) return {};
  const PlanePoint center{arc->given.center_u.value_or(0), arc->given.center_v.value_or(0)};
  // An arc with the same center in both readings is legal in either; but its missing coordinate shows how other centers
  // may be meant.
  if (arc->readings.is_same_center && request.program.habits().leaves_open(habit_of(*arc))) return {};
  if (may_mean_other_origin(request, *arc)) return {};
  if (fitting_center(request, *arc, center).edits.empty()) return {};
  const bool has_u = arc->center_u != nullptr;
  const Word& given = has_u ? *arc->center_u : *arc->center_v;
  const PlanePoint in_program = arc->in_program(center);
  const char letter = has_u ? arc->plane->v_center : arc->plane->u_center;
  std::string word = letter + dialect::written_number(has_u ? in_program.v : in_program.u, 6);
  if (letter < given.letter) return {{inserted(request, given.begin, word + " ")}, word};
  return {{inserted(request, given.end, " " + word)}, word};
}

/// R12 with a center at 10: the center decides, unless the center may be the wrong one. With only one coordinate of the
/// center nearly any circle fits.
Draft removed_contradicting_radius(const FixRequest& request) {
  const std::optional<ArcOfProgram> arc = marked_arc(request);
  const bool is_certain = arc && arc->readings.is_complete && !may_mean_other_origin(request, *arc);
  return is_certain ? removed_mark(request) : Draft{};
}

/// R-10, an arc of more than 180 degrees on other controls: gives its center.
Draft center_of_larger_arc(const FixRequest& request) {
  const Word* const radius = word_at(request.line, request.finding.span);
  const std::optional<State> before = request.program.state_before(request.number);
  if (!radius || !before || !(radius->value < 0) || request.marked().find('(') != std::string_view::npos) return {};
  // The same arc with a center, whose ends are then known.
  const execution::Plane& plane = execution::plane_in_force(*before);
  std::string text(request.line.text);
  text.replace(radius->begin, radius->end - radius->begin, {plane.u_center, '0', ' ', plane.v_center, '0'});
  const syntax::ParsedLine parsed(text);
  const std::optional<ArcOfProgram> arc = arc_on(parsed.tree(), *before, request.program.setup());
  if (!arc) return {};
  const PlanePoint chord = arc->given.end;
  const double length = chord.norm();
  const double size = -radius->value * arc->mm_per_unit;
  if (!(length > request.program.setup().arc_tolerance) || !(size > length / 2)) return {};
  const double height = std::sqrt(size * size - length * length / 4) / length;
  const double side = arc->given.counterclockwise ? height : -height;
  const PlanePoint center{chord.u / 2 + side * chord.v, chord.v / 2 - side * chord.u};
  int decimals = 3;
  const double enough = request.program.setup().arc_tolerance / 4;
  while (decimals < kMaxDecimals && !(misfit(*arc, rounded_center(*arc, center, decimals)) < enough)) ++decimals;
  std::string words = center_written(*arc, request.number, center, decimals).words;
  return {{replaced(request, radius->span(), words)}, words};
}

/// R9.999 for a chord of 20: a rounding error.
Draft radius_large_enough(const FixRequest& request) {
  const double radius = request.finding.values[0];
  const double needed = request.finding.values[1];
  const Word* const word = word_at(request.line, request.finding.span);
  const Instruction* const motion = word ? owner_of(request.line, *word) : nullptr;
  if (!motion || !motion->is_motion() || !(radius > 0) || needed - radius > needed / 20) return {};
  if (request.marked().find('(') != std::string_view::npos) return {};
  // The finding's radius in mm, divided by the word's value, is the length of a unit.
  const double minimum = std::ceil(needed * word->value / radius * 1e4 - 1e-6) / 1e4;
  std::string larger = request.marked().front() + dialect::written_number(minimum, 4);
  return {{replaced(request, request.finding.span, larger)}, larger};
}

}  // namespace isocnc::fixes
