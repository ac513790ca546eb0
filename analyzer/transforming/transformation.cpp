#include "analyzer/transforming/transformation.h"

#include <array>
#include <cmath>
#include <numbers>

#include "interpreter/syntax/each_tree.h"

namespace isocnc::transforming {

using dialect::GRole;
using geometry::Mat3;
using geometry::Vec3;

/// The rotation about Z. Quarter turns are exact, so that their coordinates need no rounding.
static Mat3 rotation_about_z(double degrees) {
  const double quarters = degrees / 90;
  double sine = std::sin(degrees * std::numbers::pi / 180);
  double cosine = std::cos(degrees * std::numbers::pi / 180);
  if (quarters == std::floor(quarters)) {
    constexpr std::array<double, 4> kSines = {0, 1, 0, -1};
    const auto turn = static_cast<std::size_t>(std::fmod(std::fmod(quarters, 4) + 4, 4));
    sine = kSines[turn];
    cosine = kSines[(turn + 1) % 4];
  }
  Mat3 rotation = Mat3::Identity();
  rotation.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
  return rotation;
}

bool PoseMap::keeps_plane(int normal) const { return std::abs(linear(normal, normal)) > 1 - 1e-12; }

PoseMap PoseMap::about(const Vec3& origin) const {
  PoseMap moved = *this;
  moved.offset = origin + offset - linear * origin;
  return moved;
}

PoseMap face_map(const Transformation& transformation) {
  PoseMap map;
  switch (transformation.movement) {
    case Movement::MirrorX:
      map.linear(0, 0) = map.b_sign = map.c_sign = -1;
      break;
    case Movement::MirrorY:
      map.linear(1, 1) = map.c_sign = -1;
      break;
    case Movement::Rotate:
      map.c_offset = transformation.degrees;
      break;
    case Movement::Shift:
    case Movement::None:
    case Movement::Repeat:
      break;
  }
  return map;
}

PoseMap workpiece_map(const Transformation& transformation) {
  PoseMap map = face_map(transformation);
  const Vec3& place = transformation.place;
  switch (transformation.movement) {
    case Movement::MirrorX:
      map.offset.x() = 2 * place.x();
      break;
    case Movement::MirrorY:
      map.offset.y() = 2 * place.y();
      break;
    case Movement::Rotate:
      map.linear = rotation_about_z(transformation.degrees);
      map.offset = place - map.linear * place;
      break;
    case Movement::Shift:
      map.offset = place;
      break;
    case Movement::None:
    case Movement::Repeat:  // Each copy is a shift.
      break;
  }
  return map;
}

/// Whether a line has a G92 that is not all 0.
static bool has_own_origin(const syntax::LineTree& line) {
  for (const syntax::Instruction& instruction : line.instructions) {
    if (!instruction.is(GRole::Workpiece)) continue;
    for (std::size_t i = instruction.begin; i < instruction.end; ++i)
      if (i != instruction.command && line.words[i].owner == instruction.number && line.words[i].value != 0)
        return true;
  }
  return false;
}

ProgramMap::ProgramMap(const Transformation& transformation, std::string_view text)
    : transformation_(transformation), workpiece_(workpiece_map(transformation)), face_(face_map(transformation)) {
  syntax::each_tree(text, [&](const syntax::LineTree& line, std::string_view) {
    has_workpiece_frame_ = has_workpiece_frame_ || has_own_origin(line);
  });
}

bool ProgramMap::stays(const execution::State& state) const {
  return has_workpiece_frame_ && state.workpiece_origin.isZero(0);
}

PoseMap ProgramMap::in_workpiece(const execution::State& state) const { return stays(state) ? PoseMap{} : workpiece_; }

PoseMap ProgramMap::in_force(const execution::State& state) const {
  if (stays(state)) return {};
  return state.face_mounted ? face_ : workpiece_;
}

}  // namespace isocnc::transforming
