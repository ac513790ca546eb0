#include <cmath>

#include "interpreter/execution/executor.h"

namespace isocnc::execution {

using namespace dialect::literals;
using dialect::GRole;
using dialect::ModalGroup;
using geometry::Frame;
using geometry::Mat3;
using geometry::Vec3;
using syntax::Instruction;

/// Reads X Y Z of a frame's origin, mm; an omitted coordinate is 0. False when one could not be read.
bool Executor::read_point(const Arguments& arguments, Vec3& point) const {
  const double scale = state_.mm_per_unit();
  for (int i = 0; i < 3; ++i) point[i] = arguments.value_or("XYZ"[i], 0) * scale;
  return point.allFinite();
}

/// Transforms the position from the face frame to the workpiece frame: the tip does not move (D25).
void Executor::leave_face() {
  if (!state_.face_mounted) return;
  if ((state_.unknown & kLinearAxes) != 0 || state_.face_undefined || state_.face_unplaced) blur_linear_axes();
  state_.position.tip = state_.face.to_outer(state_.position.tip);
  state_.face = Frame{};
  state_.set_mode(dialect::g_code(GRole::DismountFace));
  state_.face_mounted = false;
  state_.face_undefined = false;
  state_.face_unplaced = false;
}

/// Reads the origin of a G92. Returns its unknown axes: those whose value could not be read, or all if the G92 has no
/// coordinate.
AxisSet Executor::read_origin(const Arguments& arguments, Vec3& origin) const {
  if ((arguments.present() & dialect::kLinearLetters) == 0) {
    origin = Vec3::Zero();
    return kLinearAxes;
  }
  AxisSet unknown = 0;
  read_point(arguments, origin);
  for (int i = 0; i < 3; ++i) {
    if (std::isfinite(origin[i])) continue;
    unknown |= axis_bit(static_cast<Axis>(i));
    origin[i] = 0;
  }
  return unknown;
}

void Executor::workpiece_frame(const Instruction& instruction) {
  end_doubt(ModalGroup::Workpiece);
  const bool is_in_doubt = state_.is_in_doubt(ModalGroup::Face);
  if (state_.face_mounted || is_in_doubt) {
    if (!is_in_doubt) report("workpiece-frame-under-face"_diag, line_.command(instruction).span());
    end_doubt(ModalGroup::Face);
    leave_face();
    state_.dismount_tolerated = true;
  }
  const Arguments arguments(line_, instruction);
  if ((arguments.present() & ~instruction.g()->arguments) != 0) doubt_near_g(instruction, arguments);  // G92 B90
  if (arguments.empty()) doubt_lone_g(instruction);
  Vec3 origin;
  const AxisSet unknown = read_origin(arguments, origin);
  state_.unknown |= state_.workpiece_unknown | unknown;
  state_.workpiece_unknown = unknown;
  state_.position.tip += state_.workpiece_origin - origin;
  state_.workpiece_origin = origin;
  sink_.frame_changed(state_);
}

/// The letters of the dimensions that follow a G27, which takes none.
dialect::LetterSet Executor::letters_after(const Instruction& dismount) const {
  dialect::LetterSet letters = 0;
  for (std::size_t next = dismount.command + 1u;
       next < line_.words.size() && dialect::contains(dialect::kDimensionLetters, line_.words[next].letter); ++next)
    letters |= dialect::letter_bit(line_.words[next].letter);
  return letters;
}

void Executor::dismount_face(const Instruction& instruction) {
  constexpr dialect::LetterSet kOfFace = dialect::kDimensionLetters & ~dialect::kLinearLetters;
  const dialect::LetterSet following = letters_after(instruction);
  if ((following & kOfFace) != 0) return doubt(ModalGroup::Face);  // A G24, G28 or G29 was meant.
  const bool is_known = !state_.is_in_doubt(ModalGroup::Face) && following == 0;
  if (!state_.face_mounted && is_known && !state_.dismount_tolerated && !repetition_is_reported(*instruction.g()))
    report("g27-without-face"_diag, line_.command(instruction).span());
  state_.dismount_tolerated = false;
  leave_face();
  end_doubt(ModalGroup::Face);
  sink_.frame_changed(state_);
}

/// Reads the unit axes of a face. A vector without direction is ISO022; a missing vector has been reported.
/// False when not all axes are known.
bool Executor::read_axes(const Arguments& arguments, const dialect::GCode& code, Mat3& axes) {
  bool complete = true;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view names = code.axes.substr(static_cast<std::size_t>(3 * axis), 3);
    const dialect::LetterSet set = dialect::letters(names);
    Vec3 vector;
    for (int i = 0; i < 3; ++i) vector[i] = arguments.value_or(names[static_cast<std::size_t>(i)], 0);
    if ((arguments.present() & set) == 0 || !vector.allFinite()) {
      complete = false;
    } else if (!geometry::has_direction(vector)) {
      report("zero-axis-vector"_diag, arguments.span_of(set));
      complete = false;
    } else {
      axes.col(axis) = vector.normalized();
    }
  }
  return complete;
}

/// Handles G28 Z0 and G91 G28 Z0, with which other controls go home: no face was meant, so none is mounted, and the
/// position of the tool is unknown. The finding is about the missing axes, or about the codes beside G28, which must be
/// alone.
void Executor::go_home(const Arguments& arguments, const dialect::GCode& code) {
  Mat3 ignored;
  if (!line_.has(syntax::LineTree::kAloneViolated)) read_axes(arguments, code, ignored);
  if (!state_.face_mounted) state_.dismount_tolerated = true;
  if (arguments.empty()) doubt(ModalGroup::Face);  // G28 alone may be a G27.
  blur_linear_axes();
}

/// Whether a G29 defines the orientation of its face: it has an argument, and legible angles within their range.
static bool has_face_angles(const Arguments& arguments) {
  const auto is_in_range = [&](char letter) {
    return std::abs(arguments.value_or(letter, 0)) <= dialect::max_face_angle(letter);
  };
  constexpr dialect::LetterSet kTaken = dialect::kLinearLetters | dialect::kRotaryLetters;
  return (arguments.present() & kTaken) != 0 && is_in_range('B') && is_in_range('C');
}

/// Reads the axes of a face: those that the angles of a G29 give, else axis vectors. False when they define no face.
bool Executor::read_face_axes(const Arguments& arguments, const dialect::GCode& code, syntax::Span place, Mat3& axes) {
  if (code.role == GRole::FaceByAngles) {
    if (!has_face_angles(arguments)) return false;
    axes = geometry::axes_from_angles(arguments.value_or('B', 0), arguments.value_or('C', 0));
    return true;
  }
  if (!read_axes(arguments, code, axes)) return false;
  const bool is_flat = geometry::are_coplanar(axes);
  if (is_flat) report("coplanar-axis-vectors"_diag, place);
  return !is_flat;
}

void Executor::mount_face(const Instruction& instruction, const dialect::GCode& code) {
  const syntax::Span place = line_.command(instruction).span();
  const Arguments arguments(line_, instruction);
  const bool is_at_tip = code.role == GRole::FaceAtTip;
  if (arguments.empty()) doubt_lone_g(instruction);
  const bool is_chamfer = code.role == GRole::FaceByAxes && arguments.present() == dialect::letters("R");
  if (is_chamfer) return;  // Of other controls; reported.
  if (is_at_tip && (arguments.present() & dialect::kFaceVectorLetters) == 0) return go_home(arguments, code);
  const bool is_mounted = state_.face_mounted && !state_.is_in_doubt(ModalGroup::Face);
  if (is_mounted && !repetition_is_reported(code)) report("face-already-mounted"_diag, place);
  leave_face();
  end_doubt(ModalGroup::Face);
  state_.dismount_tolerated = false;
  Frame face;
  face.origin = state_.position.tip;
  const bool has_origin = is_at_tip || read_point(arguments, face.origin);
  const bool has_axes = read_face_axes(arguments, code, place, face.axes);
  state_.set_mode(code);
  enter_face(has_origin && has_axes ? face : Frame{}, has_origin && has_axes, is_at_tip);
  if (!has_axes && fits_near_code(instruction, arguments)) doubt(ModalGroup::Face);  // G24 P2 for G04.
  sink_.frame_changed(state_);
}

/// Mounts a face. The tip's coordinates become unknown if the face is not defined.
void Executor::enter_face(const Frame& face, bool is_defined, bool is_at_tip) {
  const bool is_tip_known = (state_.unknown & kLinearAxes) == 0;
  state_.face = face;
  state_.face_mounted = true;
  state_.face_undefined = !is_defined;
  state_.face_unplaced = is_defined && is_at_tip && !is_tip_known;
  if (is_defined) state_.position.tip = face.to_inner(state_.position.tip);
  if (!is_defined || !is_tip_known) blur_linear_axes();
}

}  // namespace isocnc::execution
