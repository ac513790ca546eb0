#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "interpreter/execution/executor.h"
#include "interpreter/geometry/arc.h"
#include "interpreter/geometry/increment.h"
#include "interpreter/text/characters.h"

namespace isocnc::execution {

using namespace dialect::literals;
using dialect::GCode;
using dialect::GRole;
using dialect::LetterSet;
using dialect::ModalGroup;
using geometry::ArcProblem;
using geometry::Vec3;
using syntax::Instruction;
using syntax::InstructionKind;
using syntax::Span;

/// The letter of the end of an arc that may have been meant by a rotary word, the other of the two being there:
/// G03 C-10 Y5 I0 J5.
LetterSet Executor::end_in_rotary_word(const Arguments& arguments, const GCode& code) const {
  const Plane& plane = plane_in_force(state_);
  if (!code.is_arc() || arguments.has(plane.u_letter) == arguments.has(plane.v_letter)) return 0;
  return dialect::letter_bit(arguments.has(plane.u_letter) ? plane.v_letter : plane.u_letter);
}

/// Whether words give the center or the radius of an arc.
static bool names_circle(const Arguments& arguments) { return (arguments.present() & dialect::kCircleLetters) != 0; }

void Executor::motion(const Instruction& instruction) {
  const bool is_continuation = instruction.kind == InstructionKind::Continuation;
  if (is_continuation && frame_is_lost_) return;
  const Arguments arguments(line_, instruction);
  if (is_continuation && follows_foreign_word(arguments)) return move_of_foreign_word(arguments);
  if (is_continuation && follows_wrong_motion(arguments)) make_motion_illegible();
  if (!is_continuation) {
    state_.set_mode(*instruction.g());
    state_.motion_illegible = false;
    end_doubt(ModalGroup::Motion);
  } else if (!motion_is_in_force(arguments)) {
    return;
  }
  const GCode& code = *state_.motion();
  const Span place = is_continuation ? arguments.first().span() : line_.command(instruction).span();
  (code.is_feed_move() ? feed_move_ : rapid_move_) = true;
  state_.tool_prepared = false;
  if (code.is_feed_move())
    sink_.step(state_.inverse_time() ? BlockStep::InverseTimeFeedMove : BlockStep::FeedMove, state_);
  if ((arguments.present() & ~code.arguments) != 0) report_strays(arguments, code);
  if ((arguments.present() & dialect::kCoordinateLetters) == 0) {
    const bool only_center = is_continuation && (arguments.present() & ~code.arguments) == 0;
    const bool is_explained = has_illegible_equals() || line_.has(syntax::LineTree::kAloneViolated);  // J10 M02
    if (only_center && !is_explained)
      report("missing-coordinate/continuation"_cause, place, {static_cast<double>(code.number)});
    const auto is_missing = [&](const syntax::Finding& it) {
      return it.id == "missing-coordinate"_diag && it.span == place;
    };
    if (std::any_of(line_.findings.begin(), line_.findings.end(), is_missing)) {
      blur_linear_axes();
      if (!is_continuation) doubt_lone_g(instruction);
    }
    if (line_.feed >= 0 && code.is_feed_move()) take_feed();
    return;
  }
  check_first_motion(place);
  if (code.is_feed_move()) {
    check_feed(place);
    if (is_continuation && state_.is_in_doubt(ModalGroup::Motion) && !names_circle(arguments))
      return move_to(arguments);
    const bool has_only_linear = (arguments.present() & dialect::kRotaryLetters) == 0;
    if (!state_.five_axis() && (!has_only_linear || (arguments.present() & dialect::kLinearLetters) == 0)) {
      const bool is_right = check_rotary_axes(arguments, code, place);
      // B and C alone: the finding that they may not turn is enough (D64).
      if (!is_right && arguments.has('C') && !arguments.has('X'))
        state_.unknown |= axis_bit(Axis::X);  // C350 for X350.
      if (!is_right && (arguments.present() & dialect::kLinearLetters) == 0) return move_to(arguments);
      if (!is_right) garbled_ |= end_in_rotary_word(arguments, code);
    }
  }
  if (sink_.wants_effects()) return move_with_effects(arguments, code, place);
  if (code.is_arc()) arc(arguments, code, place, nullptr);
  move_to(arguments);
}

void Executor::move_with_effects(const Arguments& arguments, const GCode& code, Span place) {
  ProgrammedMove move;
  move.kind = code.is_feed_move() ? MoveKind::Feed : MoveKind::Rapid;
  move.from = state_.position;
  if (code.is_feed_move()) {
    const ProgrammedFeed feed = feed_in_force();
    const bool rotary_only = (arguments.present() & dialect::kLinearLetters) == 0;
    move.inverse_time = state_.inverse_time();
    move.feed = feed.number * (rotary_only || move.inverse_time ? 1 : feed.mm_per_unit);
  }
  if (code.is_arc()) arc(arguments, code, place, &move);
  for (int axis = 0; axis < kAxisCount && !state_.incremental(); ++axis)
    if (arguments.has(letter_of(static_cast<Axis>(axis)))) move.placed |= axis_bit(static_cast<Axis>(axis));
  move_to(arguments);
  move.to = state_.position;
  sink_.move(move, state_);
}

/// Handles coordinates without a legible motion G: the named axes become unknown.
void Executor::move_illegibly(const Arguments& arguments) {
  for (int axis = 0; axis < kAxisCount; ++axis)
    if (arguments.has(letter_of(static_cast<Axis>(axis)))) state_.unknown |= axis_bit(static_cast<Axis>(axis));
  if (state_.motion_illegible) sink_.step(BlockStep::IllegibleMotion, state_);
}

/// Whether coordinates follow a word of another control, which has been reported: L X10, TRANS X10.
bool Executor::follows_foreign_word(const Arguments& arguments) const {
  const auto first = static_cast<std::size_t>(&arguments.first() - line_.words.data());
  if (first == 0 || line_.words[first - 1].letter != syntax::kError) return false;
  const syntax::Word& before = line_.words[first - 1];
  const char letter = text::upper(line_.text[before.begin]);
  const bool is_offset_number = (letter == 'D' || letter == 'H') && before.whole() && before.value < 100;
  return letter >= 'A' && letter <= 'Z' && !is_offset_number;  // G41 D1 X10: the offset of a tool.
}

/// What these coordinates mean is not known; nor is the motion, if there has been none.
void Executor::move_of_foreign_word(const Arguments& arguments) {
  if (!motion_is_legible()) make_motion_illegible();
  move_illegibly(arguments);
}

/// Whether coordinates follow an F that was hit for a G: F00 X10. It has been reported.
bool Executor::follows_wrong_motion(const Arguments& arguments) const {
  const auto first = static_cast<std::size_t>(&arguments.first() - line_.words.data());
  if (first == 0) return false;
  const syntax::Word& before = line_.words[first - 1];
  const auto is_of_feed = [](const syntax::Finding& finding) {
    return finding.id == "feed-not-positive"_diag || finding.id == "repeated-feed"_diag;
  };
  return before.letter == 'F' && before.digits == 2 && dialect::is_motion_number(before.value) &&
         std::any_of(line_.findings.begin(), line_.findings.end(), is_of_feed);
}

/// Whether words are those of a face whose G is missing: Y1 I-1 R1.
static bool names_axis_vectors(const Arguments& arguments) {
  return (arguments.present() & dialect::letters("APQ")) != 0 ||
         (arguments.has('R') && (arguments.present() & dialect::kCenterLetters) != 0);
}

/// Coordinates before any motion G belong to no instruction: one finding per line (D21).
bool Executor::motion_is_in_force(const Arguments& arguments) {
  if (motion_is_legible()) return true;
  move_illegibly(arguments);
  if (state_.motion_illegible || line_.number_without_letter()) return false;
  bool reported = line_.has(syntax::LineTree::kAloneViolated) ||
                  arguments.first().has(syntax::Word::kReported | syntax::Word::kMissing);
  for (const syntax::Finding& finding : line_.findings)
    reported |= finding.id == "stray-argument"_diag || finding.id == "units-after-dimensions"_diag ||
                finding.id == "distance-mode-after-dimensions"_diag;
  const char first = arguments.first().letter;
  if (!reported && !follows_reported_g(arguments)) {
    const bool is_of_motion = dialect::contains(dialect::kCoordinateLetters | dialect::kCircleLetters, first);
    report(is_of_motion ? "stray-argument/no-motion"_cause : "stray-argument/no-such-axis"_cause,
           arguments.first().span());
  }
  if (!arguments.has('X') || names_axis_vectors(arguments)) doubt(ModalGroup::Face);  // B90 for G29 B90.
  doubt_code_before(arguments);
  return false;
}

/// Reports letters that the motion does not take (D16).
void Executor::report_strays(const Arguments& arguments, const GCode& code) {
  if (line_.has(syntax::LineTree::kAloneViolated)) return;
  if (line_.number_without_letter()) return;  // 04 P2: the argument of what has lost its letter (D58).
  const bool follows_g = g_before(arguments) != nullptr;
  if (follows_g && follows_reported_g(arguments)) return doubt_code_before(arguments);
  // I5 J0 with a G01 that should be a G02 is one mistake, and so are A1 J1 R1 after a G42 that should be a G24.
  const LetterSet joined = follows_g ? code.arguments | arguments.present() : dialect::kCircleLetters;
  Span together;
  LetterSet reported = 0;
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (!dialect::contains(arguments.present() & ~code.arguments, letter) ||
        arguments.word(letter).has(syntax::Word::kReported | syntax::Word::kMissing))
      continue;
    const Span span = arguments.word(letter).span();
    reported |= dialect::letter_bit(letter);
    if (!dialect::contains(joined, letter)) {
      report("stray-argument/no-such-axis"_cause, span);
    } else {
      together = together.empty() ? span : syntax::hull(together, span);
    }
  }
  if (!together.empty()) {
    const bool is_circle = (reported & joined & ~dialect::kCircleLetters) == 0;
    report(is_circle ? "stray-argument/no-arc"_cause : "stray-argument/no-such-axis"_cause, together,
           {static_cast<double>(code.number)});
  }
  if (arguments.has('A') && !arguments.has('Z')) garbled_ |= dialect::letter_bit('Z');  // The key above it.
  doubt_code_before(arguments);
}

void Executor::check_first_motion(Span place) {
  if (state_.tool_selected || state_.tool_reported) return;
  report("initial-tool-missing"_diag, place);
  state_.tool_reported = true;
}

/// A feed move needs an F: on its own line in G93, on its own or an earlier line in G94 (I.3.7, D43).
void Executor::check_feed(Span place) {
  if (line_.feed >= 0) return take_feed();
  if (state_.is_in_doubt(ModalGroup::FeedMode)) return;
  if (may_have(dialect::letters("F"))) {
    state_.feed_reported = true;
    return;
  }
  if (state_.inverse_time()) {
    // A number without its letter may be the F (D58).
    if (line_.findings.empty() || !line_.number_without_letter()) report("inverse-time-feed-missing"_diag, place);
  } else if (!state_.feed_given && !state_.feed_reported) {
    report(state_.feed_on_rapid ? "feed-missing/on-rapid"_cause : "feed-missing"_diag, place);
    state_.feed_reported = true;
    state_.feed_on_rapid = false;
  }
}

void Executor::take_feed() {
  const double number = line_.words[static_cast<std::size_t>(line_.feed)].value;
  if (number > 0) sink_.step(state_.inverse_time() ? BlockStep::InverseTimeFeed : BlockStep::Feed, state_);
  execution::take_feed(number, state_);
}

ProgrammedFeed Executor::feed_in_force() const {
  if (state_.inverse_time()) return line_.feed >= 0 ? state_.last_feed : ProgrammedFeed{};
  return execution::feed_in_force(state_);
}

/// Whether the motion obeys three-axis interpolation, which moves no rotary axis; a G01 under it needs a linear axis
/// (I.3.4.2, I.3.5, D41).
bool Executor::check_rotary_axes(const Arguments& arguments, const GCode& code, Span place) {
  // B230 G04 P1: reported at the G04.
  if (line_.has(syntax::LineTree::kAloneViolated)) return true;
  if (state_.is_in_doubt(ModalGroup::Interpolation)) return true;
  if (code.role == GRole::Line && (arguments.present() & dialect::kLinearLetters) == 0) {
    report("linear-coordinate-missing"_diag, place);
    return false;
  }
  if (state_.is_in_doubt(ModalGroup::Distance)) return true;
  Span changed;
  for (const char letter : {'B', 'C'}) {
    if (!arguments.has(letter)) continue;
    const Axis axis = letter == 'B' ? Axis::B : Axis::C;
    const double present = letter == 'B' ? state_.position.b : state_.position.c;
    if (!state_.incremental() && (state_.unknown & axis_bit(axis)) != 0) continue;
    const double change = state_.incremental() ? arguments[letter] : arguments[letter] - present;
    if (!(std::abs(change) > geometry::kEqualCoordinate)) continue;
    const Span span = arguments.word(letter).span();
    changed = changed.empty() ? span : syntax::hull(changed, span);
  }
  if (changed.empty()) return true;
  report("five-axis-not-enabled"_diag, changed);
  // A G49 may be missing, so that the G48 after it repeats nothing.
  state_.written &= static_cast<std::uint16_t>(~State::bit(ModalGroup::Interpolation));
  return false;
}

void Executor::move_to(const Arguments& arguments) {
  const double scale = state_.mm_per_unit();
  const bool incremental = state_.incremental();
  const bool is_distance_known = !state_.is_in_doubt(ModalGroup::Distance);
  const bool is_length_known = !state_.is_in_doubt(ModalGroup::Units);
  const auto move_axis = [&](Axis axis, double& position, double target) {
    const AxisSet bit = axis_bit(axis);
    const bool is_known = is_distance_known && (is_length_known || (bit & kLinearAxes) == 0);
    if (!std::isfinite(target) || !is_known) {
      state_.unknown |= bit;
      position = 0;
    } else if (!incremental) {
      state_.unknown &= static_cast<AxisSet>(~bit);
      position = target;
    } else if ((state_.unknown & bit) == 0) {
      position = geometry::advanced(position, target);
    }
  };
  if (arguments.has('X')) move_axis(Axis::X, state_.position.tip[0], arguments['X'] * scale);
  if (arguments.has('Y')) move_axis(Axis::Y, state_.position.tip[1], arguments['Y'] * scale);
  if (arguments.has('Z')) move_axis(Axis::Z, state_.position.tip[2], arguments['Z'] * scale);
  if ((arguments.present() & dialect::kRotaryLetters) == 0) return;
  if (arguments.has('B')) move_axis(Axis::B, state_.position.b, arguments['B']);
  if (arguments.has('C')) move_axis(Axis::C, state_.position.c, arguments['C']);
}

/// Whether the line has an illegible word such as R1=10, which may be the missing word (D61). X=20 is legible, as X20.
bool Executor::has_illegible_equals() const {
  const auto is_illegible = [](const syntax::Word& word) { return word.has(syntax::Word::kReported) && !word.known(); };
  return has_stray_equals() && std::any_of(line_.words.begin(), line_.words.end(), is_illegible);
}

bool Executor::has_stray_equals() const {
  const auto is_stray = [](const syntax::Finding& finding) { return finding.id == "assignment-without-register"_diag; };
  return std::any_of(line_.findings.begin(), line_.findings.end(), is_stray);
}

/// Reports an arc without center and radius; `place` is its G, or a coordinate under a G of an earlier line. It may
/// have been meant as a line (G02 in place of G01), and so may the lines below that continue it without either.
void Executor::report_missing_circle(const Plane& plane, Span place) {
  doubt(ModalGroup::Motion);
  if (may_have(dialect::kCircleLetters) || line_.has(syntax::LineTree::kUnclosed) || has_illegible_equals()) return;
  const bool is_continuation = line_.word_at(place.begin)->letter != 'G';
  if (is_continuation && has_stray_equals()) return;  // X=20: its author writes for another control.
  const double first = std::min(plane.u, plane.v);
  const double second = std::max(plane.u, plane.v);
  report(is_continuation ? "circle-not-given/continuation"_cause : "circle-not-given"_diag, place,
         {static_cast<double>(state_.motion()->number), first, second});
}

/// Whether an arc has all words that its geometry needs; reports the first problem in the order of D45.
bool Executor::arc_is_described(const Arguments& arguments, const Plane& plane, Span place) {
  const bool has_circle = names_circle(arguments);
  if (has_circle) {
    end_doubt(ModalGroup::Motion);
  } else if (state_.is_in_doubt(ModalGroup::Motion)) {
    return false;
  }
  if (state_.is_in_doubt(ModalGroup::Plane)) {
    if (!has_circle) report_missing_circle(plane, place);
    return false;
  }
  if (!arguments.has(plane.u_letter) && !arguments.has(plane.v_letter)) {
    if (may_have(dialect::letter_bit(plane.u_letter) | dialect::letter_bit(plane.v_letter))) return false;
    const double first = std::min(plane.u, plane.v);
    const double second = std::max(plane.u, plane.v);
    report("arc-end-outside-plane"_diag, arguments.span_of(dialect::kCoordinateLetters),
           {static_cast<double>(state_.mode(ModalGroup::Plane)), first, second});
    if (!has_circle) doubt(ModalGroup::Motion);
    return false;
  }
  if (arguments.has(plane.stray_center)) {
    if (!arguments.word(plane.stray_center).has(syntax::Word::kMissing))
      report(plane.stray, arguments.word(plane.stray_center).span());
    return false;
  }
  if (!has_circle) {
    report_missing_circle(plane, place);
    return false;
  }
  if (state_.face_mounted && !state_.face_undefined && !state_.is_in_doubt(ModalGroup::Face)) {
    const double cosine = state_.face.axes.col(plane.u).dot(state_.face.axes.col(plane.v));
    if (std::abs(cosine) >= geometry::kOrthogonalCosine) {
      report("arc-plane-not-orthogonal"_diag, place, {std::acos(cosine) * 180 / std::numbers::pi});
      return false;
    }
  }
  return true;
}

/// Whether an arc under G90 fits, or nearly so, once its center counts from the start, as on other controls (D70).
bool Executor::fits_from_start(const geometry::ArcGiven& given, const Plane& plane) const {
  if (state_.incremental()) return false;
  const geometry::PlanePoint start{state_.position.tip[plane.u], state_.position.tip[plane.v]};
  return geometry::read_center_in_both_modes(given, start, false, setup_.arc_tolerance)
      .nearly_fits_other(setup_.arc_tolerance);
}

/// Reports a center that is not equally far from both ends.
void Executor::report_center(Span centers, const geometry::ArcGiven& given, const geometry::Circle& circle,
                             const Plane& plane) {
  const dialect::Cause cause = circle.found <= geometry::kEqualCoordinate ? "arc-center-mismatch/on-start"_cause
                               : fits_from_start(given, plane)            ? "arc-center-mismatch/from-start"_cause
                                                                          : "arc-center-mismatch"_diag;
  report(cause, centers, {circle.found, circle.wanted});
}

void Executor::report_circle(const Arguments& arguments, const geometry::ArcGiven& given,
                             const geometry::Circle& circle, const Plane& plane) {
  const Span centers = arguments.span_of(dialect::kCenterLetters);
  switch (circle.problem) {
    case ArcProblem::None:
      break;
    case ArcProblem::CenterUndeterminedByU:
      return report(plane.undetermined_by_u, centers);
    case ArcProblem::CenterUndeterminedByV:
      return report(plane.undetermined_by_v, centers);
    case ArcProblem::CenterMismatch:
      return report_center(centers, given, circle, plane);
    case ArcProblem::RadiusMismatch:
      return report("arc-radius-mismatch"_diag, arguments.word('R').span(), {circle.found, circle.wanted});
    case ArcProblem::RadiusTooSmall:
      return report(circle.found > 0 ? "arc-radius-too-small"_diag : "arc-radius-too-small/not-positive"_cause,
                    arguments.word('R').span(), {circle.found, circle.wanted});
  }
}

/// Reads the words of an arc, relative to its start; nothing if a word, or the coordinate of the start that it needs,
/// is unknown.
std::optional<geometry::ArcGiven> Executor::read_arc(const Arguments& arguments, const Plane& plane) const {
  const double scale = state_.mm_per_unit();
  bool is_known = true;
  const auto checked = [&](double value) {
    is_known = is_known && std::isfinite(value);
    return value;
  };
  // The offset from the start. Under G91 it is the value as written, even if the start is unknown.
  const auto offset = [&](char letter, int axis) {
    const double value = arguments[letter] * scale;
    if (state_.incremental()) return checked(value);
    is_known = is_known && (state_.unknown & axis_bit(static_cast<Axis>(axis))) == 0;
    return checked(value - state_.position.tip[axis]);
  };
  geometry::ArcGiven given;
  if (arguments.has(plane.u_letter)) given.end.u = offset(plane.u_letter, plane.u);
  if (arguments.has(plane.v_letter)) given.end.v = offset(plane.v_letter, plane.v);
  if (arguments.has(plane.u_center)) given.center_u = offset(plane.u_center, plane.u);
  if (arguments.has(plane.v_center)) given.center_v = offset(plane.v_center, plane.v);
  if (arguments.has('R')) given.radius = checked(arguments['R'] * scale);
  return is_known ? std::optional(given) : std::nullopt;
}

void Executor::report_centered_arc(const Arguments& arguments, const Plane& plane, const geometry::ArcGiven& given,
                                   const geometry::Circle& circle) {
  const AxisSet in_plane = axis_bit(static_cast<Axis>(plane.u)) | axis_bit(static_cast<Axis>(plane.v));
  sink_.centered_arc({.plane = plane,
                      .given = given,
                      .start = {state_.position.tip[plane.u], state_.position.tip[plane.v]},
                      .start_is_known = (state_.unknown & in_plane) == 0,
                      .incremental = state_.incremental(),
                      .mm_per_unit = state_.mm_per_unit(),
                      .circle = circle,
                      .arguments = arguments});
}

Span CenteredArc::centers() const { return arguments.span_of(dialect::kCenterLetters); }

/// Checks an arc, and computes it unless `move` is null.
void Executor::arc(const Arguments& arguments, const GCode& code, Span place, ProgrammedMove* move) {
  const Plane& plane = plane_in_force(state_);
  if (!arc_is_described(arguments, plane, place)) return;
  if (state_.is_in_doubt(ModalGroup::Units) || state_.is_in_doubt(ModalGroup::Distance)) return;
  const LetterSet in_plane = dialect::letter_bit(plane.u_letter) | dialect::letter_bit(plane.v_letter) |
                             dialect::letter_bit(plane.u_center) | dialect::letter_bit(plane.v_center);
  if (may_have(in_plane | dialect::letter_bit('R'))) return;
  std::optional<geometry::ArcGiven> given = read_arc(arguments, plane);
  if (!given) return;
  given->counterclockwise = code.role == GRole::CounterclockwiseArc;
  const geometry::Circle circle = geometry::find_circle(*given, setup_.arc_tolerance);
  if (given->center_u || given->center_v) report_centered_arc(arguments, plane, *given, circle);
  if (circle.problem != ArcProblem::None) return report_circle(arguments, *given, circle, plane);
  if (!move || circle.goes_nowhere) return;
  move->kind = MoveKind::Arc;
  move->center = state_.position.tip;
  move->center[plane.u] += circle.center.u;
  move->center[plane.v] += circle.center.v;
  move->normal_axis = plane.normal;
  move->normal = Vec3::Unit(plane.normal);
  move->radius = circle.center.norm();
  move->sweep_deg = geometry::sweep_deg(circle.center, given->end, given->counterclockwise);
}

}  // namespace isocnc::execution
