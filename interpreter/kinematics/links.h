#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "interpreter/kinematics/kinematics.h"

namespace isocnc::kinematics {

/// A part of the machine that carries bodies. X is a gantry that moves along X, Y a carriage on it, and Z a ram on the
/// carriage. On a head, C carries what C turns, and B, the spindle, what B tilts as well; on a table, B is the cradle
/// that B tilts, and C the round table on it, while the spindle is on Z. Without rotary axes, C and B are Z.
enum class Link : std::uint8_t { Machine, X, Y, Z, C, B };

/// Returns where a link is for given positions of the joints: what takes a point of it from its place with all joints
/// at 0, when the spindle nose is at the machine's origin, to its place now; machine frame, mm.
Eigen::Isometry3d link_pose(const Kinematics& kinematics, Link link, const Coordinates& joints);

/// Returns a point of the frame of the link `of` in the frame of the link `in`, mm.
geometry::Vec3 point_on_link(const Kinematics& kinematics, Link in, Link of, const Coordinates& joints,
                             const geometry::Vec3& point);

/// The link that carries the spindle, with the tool.
Link spindle_link(const Kinematics& kinematics);
/// The link that carries the workpiece.
Link workpiece_link(const Kinematics& kinematics);

}  // namespace isocnc::kinematics
