#include "interpreter/summary/frame_extents.h"

#include "interpreter/kinematics/travel.h"

namespace isocnc::summary {

static constexpr std::size_t kMaxFrames = 100;

void FrameLog::take(const running::FrameEvent& event, std::size_t line) {
  const bool dismounts = face_ && !event.face_mounted && event.workpiece_origin == workpiece_.frame.origin;
  face_.reset();
  if (event.face_mounted) {
    face_ = {.line = line, .frame = event.in_force};
  } else if (!dismounts) {
    workpiece_ = {.line = line, .frame = {.origin = event.workpiece_origin}};
  }
}

static std::array<geometry::Range, 3> seen_from(const geometry::Vec3& origin, std::array<geometry::Range, 3> ranges) {
  for (std::size_t axis = 0; axis < ranges.size(); ++axis) {
    ranges[axis].minimum -= origin[static_cast<Eigen::Index>(axis)];
    ranges[axis].maximum -= origin[static_cast<Eigen::Index>(axis)];
  }
  return ranges;
}

void FrameLog::take(const kinematics::Machine& machine, const kinematics::Move& move,
                    const std::array<geometry::Range, 3>& extents) {
  InForce& now = face_ ? *face_ : workpiece_;
  if (!now.line) return;
  const bool is_new = !now.place;
  if (is_new) {
    now.place = frames_.size();
    if (frames_.size() == kMaxFrames) {
      ++left_out_;
    } else {
      frames_.push_back({.line = *now.line, .is_face = face_.has_value(), .frame = now.frame});
    }
  }
  if (*now.place == kMaxFrames) return;
  const bool is_shifted = now.frame.axes == geometry::Mat3::Identity();
  const auto reached =
      is_shifted ? seen_from(now.frame.origin, extents) : kinematics::tip_extents(machine, move, now.frame);
  auto& all = frames_[*now.place].extents;
  if (is_new) all = reached;
  for (std::size_t axis = 0; axis < all.size(); ++axis) all[axis].include(reached[axis]);
}

}  // namespace isocnc::summary
