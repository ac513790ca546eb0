#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "interpreter/motion/stretch.h"
#include "interpreter/removal/joined_path.h"
#include "interpreter/removal/raised_motion.h"
#include "interpreter/removal/tip_paths.h"
#include "interpreter/removal/tool_forms.h"
#include "interpreter/stock/stock.h"

namespace isocnc::removal {

/// What a sweep is for.
enum class SweepRole : std::uint8_t {
  Cut,
  Rest,  ///< Of what has been passed through where nothing may be cut.
  RapidCutter,
  StandingCutter,
  Shank,
  ShankWall,
  Holder,
  HolderNear,
  Nose,
  NoseNear
};

/// Whether the cutter may cut.
enum class Cutting : std::uint8_t { Allowed, InRapid, Standing };

/// A stretch that waits for being cut, between two path parameters.
struct UncutStretch {
  motion::Stretch stretch;
  double from = 0;
  double to = 0;
  Cutting cutting = Cutting::Allowed;
  std::size_t line = 0;
  std::size_t frame = 0;  ///< Index of the frame in force.
  bool is_in_inches = false;
  bool is_feed = false;
  bool is_standing = false;                       ///< A tool where it is mounted.
  ProgrammedMotion programmed;                    ///< Machine frame.
  std::optional<std::size_t> spindle_stopped_by;  ///< Line.
  // Known once it has sweeps.
  double length = 0;                               ///< Of the tip's path, mm.
  geometry::Vec3 travel = geometry::Vec3::Zero();  ///< Of the tip from its start to its end, mm.
  double way = 0;                                  ///< Of the tip up to its start, mm.
  double rise = 0;                                 ///< From its start to its end, along Z of the frame, mm.
  bool is_from_cut = false;  ///< A cut in feed has led to the height of its start. Known once it has been cut.
};

/// A sweep's purpose, beside the sweep.
struct SweepUse {
  std::uint32_t first = 0;  ///< Indexes among the stretches that wait; mostly one.
  std::uint32_t last = 0;
  SweepRole role = SweepRole::Cut;
  double from = 0;  ///< Path parameter of the first.
  double to = 0;    ///< Path parameter of the last.
};

/// What sweeps are made for.
struct SweepSetting {
  const ToolForms& forms;  ///< Of the mounted tool.
  const kinematics::Kinematics& kinematics;
  geometry::Vec3 origin = geometry::Vec3::Zero();  ///< Of the workpiece frame; machine frame, mm.
  double spacing = 0;                              ///< Of the dexels, mm.
  double top = 0;                                  ///< Of the blank, workpiece frame, mm.
  double skin = 0;                                 ///< What a cut may leave of what its program says, mm.
  bool asks = true;                                ///< Whether other bodies than the cutter matter.
};

/// Motions are cut to this part of the spacing: as pieces of curved paths, and where one piece stands for several.
inline constexpr double kPathShare = 1.0 / 40;

/// What a cut may leave standing beside its body, mm.
double rim_of(double spacing);

/// A cut that is deeper is too deep, mm.
double depth_limit(const SweepSetting& setting);

/// What removes material. Where the cutter must not cut, no more than is asked for: else it would clear its own way,
/// and of many short motions through material none would meet any.
const solids::RevolvedBody* removing_cutter(const ToolForms& forms, Cutting cutting);

/// The path of a body in a role whose tip goes along a path.
stock::SweepPath placed(const ToolForms& forms, const stock::SweepPath& tip, SweepRole role);

/// False only if the body is above the blank all the time, by more than a margin.
bool may_meet(const SweepSetting& setting, const solids::RevolvedBody& body, const stock::SweepPath& path,
              double margin = 0);

/// The pieces of a stretch between its begin and a path parameter, workpiece frame.
void divide(const SweepSetting& setting, const UncutStretch& stretch, double to, std::vector<TipPath>& pieces);

/// The sweeps of the bodies of a tool along stretches of motion. Indexes are those of the stretches that wait.
class MotionSweeps {
 public:
  /// Appends the sweeps of stretches that wait, but those that their last motion may still join; and sets what is known
  /// of each then. The result does not depend on the number of threads.
  void append(const SweepSetting& setting, std::span<UncutStretch> waiting, std::size_t first,
              const stock::Workers& workers);
  /// Appends what waits to be joined, and the rapid that waits for its end.
  void append_rest_of_motion(const SweepSetting& setting, std::span<const UncutStretch> waiting);
  /// Takes the sweeps of the rest of what has been passed through where nothing may be cut.
  std::vector<stock::Sweep> take_rest(const ToolForms& forms);

  /// The part of a motion whose sweeps wait for more of it.
  struct OpenPart {
    std::size_t first = 0;                ///< Its first stretch.
    std::vector<stock::SweepPath> paths;  ///< Of the tip up to now.
  };
  /// None if all stretches have their sweeps.
  std::optional<OpenPart> open_part() const;

  std::span<const stock::Sweep> sweeps() const { return sweeps_; }
  std::span<const SweepUse> uses() const { return uses_; }
  /// Forgets the sweeps. Of the stretches, those before the open part are gone.
  void clear();

 private:
  /// A way on which nothing may be cut.
  struct PassedPath {
    stock::SweepPath path;
    stock::CutTag tag = 0;
  };

  /// What sweeps are made of, of the bodies of the tool: the tip's path, workpiece frame, and what SweepUse has of it.
  struct PathOfSweeps {
    stock::SweepPath tip;
    std::size_t first = 0;
    double from = 0;
    std::size_t last = 0;
    double to = 0;
  };

  /// The pieces of a motion's path that wait for the next one.
  struct JoinedPieces {
    JoinedPath path;
    std::uint64_t tag = 0;  ///< Of the motion.
    std::size_t first = 0;
    double from = 0;
    std::size_t last = 0;
    double to = 0;
  };

  class SweepWriter;

  std::vector<stock::Sweep> sweeps_;
  std::vector<SweepUse> uses_;
  Cutting cutting_ = Cutting::Allowed;                  ///< On the last motion.
  std::vector<PassedPath> passed_;                      ///< Since it has been allowed, or not for this reason.
  std::vector<std::pair<TipPath, std::size_t>> rapid_;  ///< Of the present rapid in phases, each with its stretch.
  std::optional<JoinedPieces> joined_;                  ///< Of the present motion.
};

}  // namespace isocnc::removal
