#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/dialect/given_name.h"
#include "interpreter/removal/workpiece.h"
#include "interpreter/solids/clearance.h"
#include "interpreter/verification/motion_bounds.h"
#include "interpreter/verification/scene.h"

namespace isocnc::verification {

/// A body that motions move: a part of the tool, the nose, a body of the machine on a link, or a body of the setup on a
/// table that turns. Those on the table are obstacles as well.
struct MovingPart {
  std::optional<removal::ToolPart> of_spindle;     ///< Of what turns in the spindle; none for other bodies.
  const solids::RevolvedBody* revolved = nullptr;  ///< Of the tool and the nose; about the tool's axis.
  double offset = 0;                               ///< Height of the revolved body's z = 0 above the tip, mm.
  const SceneBody* body = nullptr;                 ///< Of the machine or the setup.
  Link on = Link::Machine;                         ///< What moves that body.
  geometry::Vec3 shift = geometry::Vec3::Zero();   ///< From the link's frame to that body's frame, mm.
  dialect::GivenName name;
};

/// A body that parts may hit.
struct Obstacle {
  const SceneBody* body = nullptr;
  BodyShape shape;  ///< In its own frame, which is that of its link after `shift`.
  Link on = Link::Machine;
  geometry::Vec3 shift = geometry::Vec3::Zero();  ///< From the link's frame to the shape's frame, mm.
  dialect::GivenName name;
};

/// What moves as one: the tool with its holder and the nose, or a body of its own. A contact is one of a mover with an
/// obstacle.
using Mover = std::size_t;
inline constexpr Mover kSpindle = 0;

/// A part and an obstacle that motions bring together, with what bounds their speed.
struct BodyPair {
  /// A distance that no bound is made of.
  static constexpr double kNever = 1e30;

  std::size_t part = 0;
  std::size_t obstacle = 0;
  const solids::RevolvedBody* revolved = nullptr;  ///< The part's, or what counts of it; null for other bodies.
  const solids::InnerSurface* core = nullptr;      ///< What counts of the obstacle, if that is not its shape.
  double limit = 0;            ///< What comes nearer is looked at, mm: at least the contact distance.
  bool reports_near = false;   ///< Whether coming nearer than `limit` without a contact is reported (W154).
  bool is_watched = false;     ///< Whether the part should keep away from the obstacle at all.
  double slack = 0;            ///< By how much the compared shapes are smaller than what counts, mm.
  double allowed = 0;          ///< How deep the compared shapes may overlap, mm.
  double reach_tip = kNever;   ///< Largest distance of the part's points from the tip, mm.
  double reach_axes = kNever;  ///< ... from the rotary axes that are between both, mm.
  bool shifts = true;          ///< Whether the linear joints are between both.
  bool swings = false;         ///< Whether the distance from the nose to the table's axes counts as well.

  /// The distance that counts for a distance of the compared shapes.
  solids::Clearance counted(solids::Clearance of_shapes) const {
    of_shapes.lower += allowed;
    of_shapes.upper += allowed;
    return of_shapes;
  }
  /// An upper bound of the speed of any point of the part relative to the obstacle, mm per unit of the path parameter.
  double speed(const MotionBounds& bounds) const {
    const double by_tip = bounds.tip + bounds.turn * reach_tip;
    const double by_joints = (shifts ? bounds.joints : 0) + bounds.turn * (reach_axes + (swings ? bounds.swing : 0));
    return by_tip < by_joints ? by_tip : by_joints;
  }
};

/// The parts, obstacles and pairs of a scene while a tool is mounted.
struct BodyPairs {
  std::vector<MovingPart> parts;
  std::vector<Obstacle> obstacles;
  std::vector<BodyPair> pairs;
  std::deque<solids::RevolvedBody> reduced;  ///< Cutters without the depth to which they may go into the target.
  double tool_length = 0;                    ///< mm
};

/// The mover that a part belongs to.
inline Mover mover_of(const BodyPairs& bodies, std::size_t part) {
  return bodies.parts[part].revolved ? kSpindle : 1 + part;
}

/// What is nearer than this is a contact, mm; twice what is certainly found.
inline constexpr double kContactDistance = 0.02;

/// A tool that is mounted, or the empty spindle.
struct MountedTool {
  const ToolBodies* bodies = nullptr;  ///< Null if nothing is known of it.
  std::string name;                    ///< `T101001`; empty for none.
  double length = 0;                   ///< mm
  /// Otherwise nothing of it, of the nose and of what carries it is compared: parts and obstacles are the same, with
  /// fewer pairs.
  bool is_place_known = true;
};

/// How messages call a part of a tool (`T101001`), or the nose.
dialect::GivenName part_name(removal::ToolPart part, const std::string& tool);

/// What no cutter may reach of a target with this tolerance, mm. Null unless the shape is a closed mesh.
std::shared_ptr<const solids::InnerSurface> core_of_target(const BodyShape& shape, double tolerance);

/// `origin` is that of the setup's frame, in the machine frame. The result refers to the scene.
BodyPairs pairs_of(const Scene& scene, const kinematics::Kinematics& kinematics, const MountedTool& tool,
                   const geometry::Vec3& origin);

}  // namespace isocnc::verification
