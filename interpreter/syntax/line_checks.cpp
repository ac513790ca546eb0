#include <algorithm>
#include <cmath>

#include "interpreter/syntax/line_parser.h"

namespace isocnc::syntax {

using namespace dialect::literals;
using dialect::contains;
using dialect::GRole;
using dialect::letters;

void LineParser::check() {
  check_alone();
  check_misplaced_modes();
  for (std::size_t i = 0; i < instruction_count(); ++i) {
    const Instruction& checked = instruction(i);
    if (checked.has(Instruction::kReportedElsewhere)) continue;
    switch (checked.kind) {
      case InstructionKind::G:
        check_g(checked);
        break;
      case InstructionKind::Continuation:
        check_motion(checked);
        break;
      case InstructionKind::Function:
        check_parameters(checked);
        break;
      default:
        break;
    }
  }
  // An instruction with a broken series takes effect at the place of its last word.
  Instruction* const first = store_.instructions_.data() + line_.first_instruction;
  Instruction* const end = store_.instructions_.data() + store_.instructions_.size();
  const auto by_end = [](const Instruction& a, const Instruction& b) { return a.end < b.end; };
  if (!std::is_sorted(first, end, by_end)) std::stable_sort(first, end, by_end);
  const auto settled = [](const Instruction& it) {
    return it.kind == InstructionKind::Continuation && it.has(Instruction::kReportedElsewhere);
  };
  for (auto removed = end - std::remove_if(first, end, settled); removed > 0; --removed)
    store_.instructions_.pop_back();
}

bool LineParser::owns_any(const Instruction& owner, dialect::LetterSet set, bool unbroken) const {
  for (std::uint16_t i = owner.begin; i < owner.end; ++i) {
    const Word& own_word = word(i);
    if (own_word.owner != owner.number || i == owner.command || !contains(set, own_word.letter)) continue;
    if (!unbroken || !own_word.has(Word::kBreak)) return true;
  }
  return false;
}

/// An M whose number is not known may be one.
static bool may_be_user_function(const Word& m) {
  const std::optional<int> number = m.whole();
  return !number || dialect::is_user_function(*number);
}

/// Whether an instruction must be alone on its line, and the diagnostic for a violation (D22).
bool LineParser::must_be_alone(const Instruction& checked, dialect::DiagnosticId& diagnostic) const {
  diagnostic = dialect::kNoDiagnostic;
  switch (checked.kind) {
    case InstructionKind::G:
      if (const dialect::GCode* code = checked.g()) diagnostic = code->alone;
      break;
    case InstructionKind::Function:
      if (word(checked.command).value == dialect::kProgramEnd) {
        diagnostic = "m02-not-alone"_diag;
      } else if (may_be_user_function(word(checked.command)) && owns_any(checked, letters("P"))) {
        diagnostic = "m-params-not-alone"_diag;
      }
      break;
    case InstructionKind::Jump:
      diagnostic = "if-not-alone"_diag;
      break;
    default:
      break;
  }
  return diagnostic != dialect::kNoDiagnostic;
}

/// The line's first correct word that is neither part of the instruction nor the line number, or null.
const Word* LineParser::other_word_on_line(const Instruction& alone) const {
  const dialect::GCode* const code = alone.kind == InstructionKind::G ? alone.g() : nullptr;
  const bool is_end = alone.kind == InstructionKind::Function && word(alone.command).value == dialect::kProgramEnd;
  const bool dwell_without_time = alone.is(GRole::Dwell) && !owns_any(alone, letters("P"));
  for (std::uint16_t i = 0; i < word_count(); ++i) {
    const Word& other = word(i);
    if (other.letter == 'N' || other.letter == kError || other.letter == kNumber || other.has(Word::kMissing)) continue;
    if (other.letter == 'T' && other.owner == Word::kNoOwner) continue;  // G92 X100 T50: reported at the T.
    if (other.owner == alone.number) {
      if (i == alone.command || (!code && !is_end) || (code && contains(code->arguments, other.letter))) continue;
      if (dwell_without_time && !other.has(Word::kBreak)) continue;  // G04 X10: the X is in the place of the P.
    }
    const bool is_time = dwell_without_time && i == alone.command + 1 && contains(letters("FS"), other.letter);
    if (is_time) continue;                                                   // G04 F2: the form of other controls.
    if (other.letter == kAssign && other.owner == Word::kNoOwner) continue;  // A stray `=` is reported elsewhere.
    return &other;
  }
  return nullptr;
}

void LineParser::check_alone() {
  for (std::size_t i = 0; i < instruction_count(); ++i) {
    const Instruction& checked = instruction(i);
    dialect::DiagnosticId diagnostic;
    if (checked.has(Instruction::kReportedElsewhere) || !must_be_alone(checked, diagnostic)) continue;
    const Word* const other = other_word_on_line(checked);
    if (!other) continue;
    report(diagnostic, word(checked.command).span(), {}, other->span());
    line_.flags |= LineTree::kAloneViolated;
    return;
  }
}

void LineParser::check_misplaced_modes() {
  if ((line_.flags & LineTree::kAloneViolated) != 0) misplaced_count_ = 0;
  for (std::size_t i = 0; i < misplaced_count_; ++i) {
    const Word& mode = word(misplaced_[i]);
    report(instruction(mode.owner).g()->misplaced, mode.span());
  }
}

void LineParser::check_g(const Instruction& checked) {
  const dialect::GCode* const code = checked.g();
  if (!code) return;
  switch (code->role) {
    case GRole::Rapid:
    case GRole::Line:
    case GRole::ClockwiseArc:
    case GRole::CounterclockwiseArc:
      return check_motion(checked);
    case GRole::Dwell:
      return check_dwell(checked);
    case GRole::FaceByAxes:
    case GRole::FaceAtTip:
      return check_vectors(checked);
    case GRole::FaceByAngles:
      check_arguments(checked, "missing-arguments"_diag);
      return check_face_angles(checked);
    case GRole::Workpiece:
      return check_arguments(checked, "missing-origin"_diag);
    case GRole::CompensationOff:
    case GRole::CompensationLeft:
    case GRole::CompensationRight:
      return check_compensation(checked);
    case GRole::ExactStop:
    case GRole::PlaneXY:
    case GRole::PlaneZX:
    case GRole::PlaneYZ:
    case GRole::DismountFace:
    case GRole::Mode:
    case GRole::Signal:
    case GRole::PendingEnd:
    case GRole::ApplyMdi:
      return;
  }
}

/// G92 G00 X5: whether the argument that G92 lacks was taken by the G00, which has been reported already.
bool LineParser::neighbor_has_arguments_of(const Instruction& alone) const {
  if ((line_.flags & LineTree::kAloneViolated) == 0) return false;
  for (std::size_t i = alone.command + 1u; i < word_count(); ++i)
    if (word(i).owner != alone.number && contains(alone.g()->arguments, word(i).letter)) return true;
  return false;
}

/// Reports arguments that are missing, or that an N separates from their G: the N breaks the series like an S (D12,
/// D17).
void LineParser::check_arguments(const Instruction& checked, dialect::DiagnosticId when_missing) {
  const bool shared_line_reported = (line_.flags & LineTree::kAloneViolated) != 0;
  if (owns_any(checked, checked.g()->arguments, !shared_line_reported)) return check_unbroken(checked);
  // G92 C5: the C, which has been reported, is in the place of a missing argument.
  if (shared_line_reported && owns_any(checked, dialect::kDimensionLetters)) return;
  const std::size_t next = checked.command + 1u;
  if (shared_line_reported && next < word_count() && word(next).letter == 'S') return;  // G92 S2000
  if (neighbor_has_arguments_of(checked)) return;
  report_missing(when_missing, checked);
}

/// Reports the first argument that an N separates from its G.
void LineParser::check_unbroken(const Instruction& checked) {
  if ((line_.flags & LineTree::kAloneViolated) != 0) return;
  for (std::uint16_t i = checked.begin; i < checked.end; ++i)
    if (word(i).owner == checked.number && word(i).has(Word::kBreak))
      return report("stray-argument"_diag, word(i).span(), {}, breaker_of(checked, i));
}

/// The word that separates an argument from the earlier part of its series.
Span LineParser::breaker_of(const Instruction& owner, std::uint16_t broken) const {
  std::uint16_t breaker = broken;
  while (word(breaker - 1u).owner != owner.number) --breaker;
  const auto breaks_no_series = [](const Word& it) {
    return it.letter == 'F' || it.letter == kError || it.letter == kNumber || it.has(Word::kMissing);
  };
  while (breaker + 1 < broken && breaks_no_series(word(breaker))) ++breaker;
  return word(breaker).span();
}

/// Whether a word between a motion and an argument separated from it has a finding of its own.
bool LineParser::breaker_is_reported(const Instruction& motion, std::uint16_t broken) const {
  for (std::uint16_t i = broken; i-- > 0 && word(i).owner != motion.number;) {
    if (word(i).letter != 'G') continue;
    if (word(i).owner == Word::kNoOwner) return true;  // G without a number, which has been reported.
    const dialect::GCode* const code = instruction(word(i).owner).g();
    if (!code || code->role == GRole::ExactStop || code->group == dialect::ModalGroup::CutterCompensation ||
        code->misplaced != dialect::kNoDiagnostic)
      return true;
  }
  return false;
}

/// Reports a motion without coordinates, or with coordinates separated from their series (D17, D18).
void LineParser::check_motion(const Instruction& motion) {
  if ((line_.flags & LineTree::kAloneViolated) != 0) return;
  const bool is_g = motion.kind == InstructionKind::G;
  bool has_arguments = false;
  int broken = kNone;
  for (std::uint16_t i = motion.begin; i < motion.end; ++i) {
    if (word(i).owner != motion.number || (is_g && i == motion.command)) continue;
    if (!word(i).has(Word::kBreak)) {
      has_arguments = true;
    } else if (broken == kNone) {
      broken = i;
    }
  }
  if (broken != kNone) return report_broken_series(motion, static_cast<std::uint16_t>(broken), has_arguments);
  if (is_g) check_coordinates(motion);
}

/// Reports the first argument that is separated from its motion; without other arguments, the motion lacks them all.
void LineParser::report_broken_series(const Instruction& motion, std::uint16_t broken, bool has_arguments) {
  if (breaker_is_reported(motion, broken)) return;
  if (!has_arguments)
    return report_missing("missing-coordinate/series-broken"_cause, motion, breaker_of(motion, broken));
  Word& stray = word(broken);
  const bool is_reported = stray.has(Word::kMissing | Word::kReported);
  stray.flags |= Word::kReported;
  if (!is_reported) report("stray-argument"_diag, stray.span(), {}, breaker_of(motion, broken));
}

/// Whether a word may be an argument whose letter was hit wrong: U5 of another control, or a T without its six digits.
bool LineParser::is_garbled_argument(std::size_t index) const {
  const Word& it = word(index);
  return it.letter == 'T' ? !it.is_tool() : it.letter == kError && is_foreign_word(text_of(it.span()));
}

/// Reports a motion G without coordinates, unless a finding explains their absence.
void LineParser::check_coordinates(const Instruction& motion) {
  if (owns_any(motion, dialect::kCoordinateLetters)) return;
  // Stray letters without a coordinate are reported where the motion is known. A second motion G, or an unknown G that
  // has taken the arguments, has been reported already.
  if (owns_any(motion, dialect::kDimensionLetters & ~motion.g()->arguments)) return;
  if (word(motion.command).has(Word::kReported) || word(motion.command).span() != first_motion_) return;
  for (std::size_t i = motion.number + 1u; i < instruction_count(); ++i) {
    const Instruction& other = instruction(i);
    if (other.is_unknown_g() || (other.g() && other.g()->is_motion())) return;
  }
  // G00 U5: another control's axis, reported at the U.
  std::size_t next = motion.command + 1u;
  while (next < word_count() && word(next).letter == 'F') ++next;
  if (next < word_count() && is_garbled_argument(next)) return;
  if (next < word_count() && word(next).letter == 'V' && !is_assigned(static_cast<std::uint16_t>(next))) return;
  report_missing("missing-coordinate"_diag, motion);
}

/// Whether a G28 is the zero return of other controls (G28 X0 Y0, D71). Its only finding is that these are not axis
/// vectors.
bool LineParser::is_zero_return(const Instruction& frame) const {
  if (!frame.is(GRole::FaceAtTip) || owns_any(frame, dialect::kFaceVectorLetters) || !owns_any(frame, letters("XYZ")))
    return false;
  for (std::uint16_t i = frame.begin; i < frame.end; ++i)
    if (word(i).owner == frame.number && i != frame.command && word(i).value != 0) return false;
  return true;
}

/// G24 and G28 need at least one component of each axis (D4, D27).
void LineParser::check_vectors(const Instruction& frame) {
  check_unbroken(frame);
  if (neighbor_has_arguments_of(frame)) return;
  // G91 G28 Z0: the home command of other controls. The line has been reported; missing axis vectors need no finding.
  const bool shares_line = (line_.flags & LineTree::kAloneViolated) != 0;
  if (shares_line && frame.is(GRole::FaceAtTip) && !owns_any(frame, dialect::kFaceVectorLetters)) return;
  if (is_zero_return(frame)) return;
  if (frame.is(GRole::FaceByAxes) && owns_any(frame, letters("R")) && !owns_any(frame, letters("ABCIJKPQXYZ")))
    return report_missing("missing-i-vector"_diag, frame);         // G24 R5, a chamfer of other controls.
  for (std::size_t i = frame.command + 1u; i < word_count(); ++i)  // G28 X1 J1 E1: reported at the E.
    if (is_garbled_argument(i)) return;
  const std::string_view axes = frame.g()->axes;
  if (!owns_any(frame, letters(axes.substr(0, 3)))) report_missing("missing-i-vector"_diag, frame);
  if (!owns_any(frame, letters(axes.substr(3, 3)))) report_missing("missing-j-vector"_diag, frame);
  if (!owns_any(frame, letters(axes.substr(6, 3)))) report_missing("missing-k-vector"_diag, frame);
}

void LineParser::check_face_angles(const Instruction& frame) {
  for (std::uint16_t i = frame.begin; i < frame.end; ++i) {
    const Word& angle = word(i);
    if (angle.owner != frame.number || !contains(dialect::kRotaryLetters, angle.letter)) continue;
    const double limit = dialect::max_face_angle(angle.letter);
    if (std::abs(angle.value) > limit) report("face-angle-out-of-range"_diag, angle.span(), {angle.value, limit});
  }
}

void LineParser::check_dwell(const Instruction& dwell) {
  // G04 U1 is reported at the U, and P1 G04 at the G04.
  bool is_garbled = dwell.command > 0 && word(dwell.command - 1u).letter == 'P';
  for (std::size_t i = dwell.command + 1u; i < word_count(); ++i) is_garbled |= word(i).letter == kError;
  if (!is_garbled) check_arguments(dwell, "dwell-time-missing"_diag);
  for (std::uint16_t i = dwell.begin; i < dwell.end; ++i) {
    const Word& time = word(i);
    if (time.owner == dwell.number && time.letter == 'P' && time.value < 0 && !time.has(Word::kReported))
      report("negative-dwell"_diag, time.span(), {time.value});
  }
}

/// The first parameter with this number of a user M.
const Word& LineParser::first_parameter(const Instruction& function, double number) const {
  std::uint16_t i = function.begin;
  while (word(i).owner != function.number || word(i).letter != 'P' || word(i).value != number) ++i;
  return word(i);
}

/// M100 P1=2.5 P2=-3: P1 to P20, each at most once, each with a value; M02 to M05 take none (I.4.4, D48).
void LineParser::check_parameters(const Instruction& function) {
  const bool takes_parameters = may_be_user_function(word(function.command));
  if (word(function.command).value == dialect::kProgramEnd) return;
  std::uint32_t seen = 0;
  for (std::uint16_t i = function.begin; i < function.end; ++i) {
    const Word& name = word(i);
    if (name.owner != function.number || name.letter != 'P') continue;
    const bool has_value = i + 1 < word_count() && word(i + 1u).letter == kAssign;
    const Span span = has_value ? hull(name.span(), word(i + 1u).span()) : name.span();
    const int number = name.parameter_number();
    const std::uint32_t bit = 1u << static_cast<unsigned>(number);
    const bool valued = has_value && !word(i + 1u).has(Word::kMissing);
    if (takes_parameters && (name.has(Word::kMalformed | Word::kMissing) || follows_lone_equals(i)))
      continue;  // Reported: M100 =5 P20.
    if (!takes_parameters)
      return report("m-param-invalid/fixed-function"_cause, span, {}, word(function.command).span());
    if (number == 0) {
      report("m-param-invalid"_diag, span);
    } else if (!valued) {
      report("m-param-invalid/no-value"_cause, span);
    } else if ((seen & bit) != 0) {
      report("m-param-invalid/repeated"_cause, span, {}, first_parameter(function, name.value).span());
    }
    const bool is_doubled =
        !has_value && i + 1 < word_count() && word(i + 1u).letter == 'P' && word(i + 1u).value == name.value;
    if (!is_doubled) seen |= bit;  // P2 P2=1: one finding.
  }
}

/// Whether a word is a G48 or G49.
bool LineParser::is_interpolation_mode(const Word& checked) const {
  if (checked.letter != 'G' || checked.owner == Word::kNoOwner) return false;
  const dialect::GCode* const code = instruction(checked.owner).g();
  return code && code->group == dialect::ModalGroup::Interpolation;
}

/// Whether an instruction is alone on its line, apart from N. Text that is not a word does not count (it has a finding
/// of its own), nor does a G48 or G49, which must itself be alone.
bool LineParser::stands_alone(const Instruction& alone) const {
  for (std::uint16_t i = 0; i < word_count(); ++i) {
    const Word& other = word(i);
    const bool counts = other.letter != 'N' && other.letter != kError && other.letter != kNumber &&
                        !other.has(Word::kMissing) && !is_interpolation_mode(other);
    if (counts && i != alone.command) return false;
  }
  return true;
}

/// Whether the line has a finding that an instruction is not alone, other than a G48 or G49 (D65): then the other codes
/// on the line need no finding.
bool LineParser::is_reported_not_alone() const {
  const auto is_interpolation = [](const Finding& finding) { return finding.id == "g48-g49-not-alone"_diag; };
  return (line_.flags & LineTree::kAloneViolated) != 0 &&
         std::none_of(own_findings(), store_.findings_.end(), is_interpolation);
}

/// G41/G42: alone or before a motion. G40: alone or after the last motion (D24).
void LineParser::check_compensation(const Instruction& checked) {
  if (stands_alone(checked) || is_reported_not_alone() || compensation_reported_) return;
  const bool is_end = checked.is(GRole::CompensationOff);
  bool before_motion = false;
  bool after_motion = false;
  for (std::size_t i = 0; i < instruction_count(); ++i) {
    const Instruction& other = instruction(i);
    const bool is_motion = other.kind == InstructionKind::Continuation ? !other.has(Instruction::kReportedElsewhere)
                                                                       : other.g() && other.g()->is_motion();
    // An unknown G may be the required motion: any G after a G41 (D62), or a G with coordinates before a G40.
    const bool may_be_motion = other.is_unknown_g();
    if (may_be_motion) {
      before_motion |= !is_end && other.command > checked.command;
      after_motion |= other.command < checked.command && owns_any(other, dialect::kCoordinateLetters);
    }
    if (!is_motion) continue;
    // A motion starts at its G: words before it count as its own, but have been reported.
    const std::uint16_t begin = other.kind == InstructionKind::G ? other.command : other.begin;
    before_motion |= (is_end ? other.end : begin) > checked.command;
    after_motion |= begin < checked.command;
  }
  compensation_reported_ = is_end ? before_motion || !after_motion : !before_motion;
  if (compensation_reported_)
    report(is_end ? "misplaced-g40"_diag : "misplaced-g41-g42"_diag, word(checked.command).span());
}

/// A tool number has six digits: head, holder, tool. Zeros mean that nothing is mounted there (I.4.3).
void LineParser::check_tool_number(const Word& tool) {
  if (tool.has(Word::kMissing | Word::kReported)) return;
  if (!tool.is_plain_integer() || tool.digits != 6) return report("invalid-tool-number"_diag, tool.span());
  const auto number = static_cast<std::uint32_t>(tool.value);
  const std::uint32_t head = number / 100000;
  const std::uint32_t holder = number / 1000 % 100;
  const std::uint32_t index = number % 1000;
  if (head == 0 && holder != 0) {
    report("head-not-selected"_diag, tool.span(), {static_cast<double>(holder)});
  } else if (holder == 0 && index != 0) {
    report("holder-not-selected"_diag, tool.span(), {static_cast<double>(index)});
  }
}

}  // namespace isocnc::syntax
