#include "lsp/queries/obstacles.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "interpreter/verification/verifier.h"
#include "lsp/queries/machine_motion.h"
#include "lsp/queries/timed_program.h"

namespace isocnc::queries {

using documents::LandmarkKind;
using documents::Snapshot;
using geometry::Vec3;
using verification::Neighbor;
using verification::Scene;

/// What is farther away is not worth a word, mm.
static constexpr double kFar = 500;
/// The maximum number of paths whose motions are compared.
static constexpr std::size_t kMaxPaths = 16;

namespace {

/// The surroundings of a document's motions, as of one version of its text and settings.
struct KnownSurroundings {
  std::shared_ptr<const void> settings;
  std::shared_ptr<const Scene> scene;
  std::int64_t version = std::numeric_limits<std::int64_t>::min();
  std::optional<Vec3> origin;  // None where an error hides it.
};

}  // namespace

/// Whether a jump above a line may lead past it.
static bool may_be_jumped_over(const Snapshot& snapshot, std::size_t line) {
  const std::vector<documents::Landmark> jumps = snapshot.index().landmarks(LandmarkKind::Jump);
  return std::any_of(jumps.begin(), jumps.end(), [&](const documents::Landmark& jump) {
    if (jump.line >= line) return false;
    const std::vector<std::size_t> targets = snapshot.index().lines_of_label(jump.number);
    return targets.empty() || targets.back() > line;
  });
}

/// The origin of the first workpiece frame that a run sets; machine frame, mm. Only a program that may jump over its
/// first G92, or sets it by the path, has to be run.
static std::optional<Vec3> first_origin(const Snapshot& snapshot) {
  const std::vector<documents::Landmark> frames = snapshot.index().landmarks(LandmarkKind::WorkpieceFrame);
  if (frames.empty()) return Vec3(Vec3::Zero());
  const std::size_t first = frames.front().line;
  if (!may_be_jumped_over(snapshot, first)) {
    const std::vector<LineRun> runs = run_line_on_all_paths(snapshot, first);
    const auto is_same = [&](const LineRun& run) {
      return run.after.workpiece_unknown == 0 && run.after.workpiece_origin == runs.front().after.workpiece_origin;
    };
    if (!runs.empty() && std::all_of(runs.begin(), runs.end(), is_same)) return runs.front().after.workpiece_origin;
  }
  return TimedProgram(snapshot, 0).workpiece_origin();
}

static const KnownSurroundings& surroundings_of(const Snapshot& snapshot) {
  auto& known = snapshot.memory<KnownSurroundings>();
  if (known.settings != snapshot.settings_owner())
    known = {.settings = snapshot.settings_owner(), .scene = snapshot.settings().scene()};
  if (known.scene && known.version != snapshot.version()) {
    known.version = snapshot.version();
    known.origin = first_origin(snapshot);
  }
  return known;
}

/// Whether the first matters more: a contact before a gap, and what is deeper or nearer.
static bool matters_more(const Neighbor& a, const Neighbor& b) {
  if (a.is_contact() != b.is_contact()) return a.is_contact();
  return a.is_contact() ? a.distance < b.distance : a.clearance < b.clearance;
}

std::optional<NearestObstacle> nearest_obstacle(const Snapshot& snapshot, std::size_t line,
                                                const std::vector<LineRun>& runs) {
  if (runs.size() > kMaxPaths) return std::nullopt;
  const KnownSurroundings& around = surroundings_of(snapshot);
  if (!around.scene || !around.origin) return std::nullopt;
  const timing::TimedMachine& machine = snapshot.configuration().machine.timed;
  std::optional<NearestObstacle> nearest;
  for (const LineRun& run : runs) {
    const auto move = machine_motion(snapshot, line, run);
    const auto tool = mounted_tool(snapshot, line + 1, run.after);
    if (!move || !tool) return std::nullopt;
    const verification::MountedTool mounted = verification::mounted_tool(*around.scene, machine, *tool);
    if (!mounted.is_place_known) return std::nullopt;
    const bool is_without_tool = *tool != execution::ToolCode() && !(mounted.bodies && mounted.bodies->cutter);
    const verification::BodyPairs bodies =
        verification::pairs_of(*around.scene, machine.motion.kinematics, mounted, *around.origin);
    for (const Neighbor& each : verification::neighbors_along(bodies, machine.motion, *move, kFar)) {
      if (!each.is_contact() && !(each.clearance < kFar)) continue;
      if (!nearest || matters_more(each, nearest->neighbor))
        nearest = {.neighbor = each, .is_without_tool = is_without_tool};
    }
  }
  return nearest;
}

}  // namespace isocnc::queries
