#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/given_name.h"
#include "interpreter/execution/setup.h"
#include "interpreter/geometry/frame.h"
#include "interpreter/removal/depth_levels.h"
#include "interpreter/verification/body_pairs.h"
#include "interpreter/verification/scene.h"

namespace isocnc::verification {

/// A moving body that hits an obstacle, from the first touch to the last, or passes too near; or something that goes
/// wrong with the material.
struct Contact {
  /// E152, E153, E155, or W154 for a near miss; of the material E150, E151, W154, W156 to E158, W161.
  dialect::DiagnosticId id = dialect::kNoDiagnostic;
  std::size_t line = 0;        ///< Of the first touch; of a near miss, of the nearest place; from 0.
  std::size_t end_line = 0;    ///< Of the last touch.
  double time = 0;             ///< Of the first touch, or of the nearest place; seconds since the start of the run.
  double end_time = 0;         ///< Of the last touch, seconds.
  execution::ToolCode tool;    ///< All 0: none is mounted.
  dialect::GivenName who;      ///< The moving body that is nearest, or deepest.
  dialect::GivenName whom;     ///< The obstacle.
  double distance = 0;         ///< Smallest distance, mm; negative: the largest depth.
  std::size_t worst_line = 0;  ///< Of that place; from 0.
  double worst_time = 0;       ///< When it is reached, or of the material, when the motion begins; seconds.
  /// Of the obstacle, at that place; mm, machine frame of the program: on a table that turns it turns with the
  /// workpiece.
  geometry::Vec3 point = geometry::Vec3::Zero();
  geometry::Frame frame;      ///< In force at `line`, or of the material, at `worst_line`; in the machine frame.
  bool is_in_inches = false;  ///< G70 is in force there: it is told in inches.
  std::vector<removal::DepthLevel> levels;  ///< Lines at which it is told, so that none is accepted unseen; not empty.
  Mover mover = kSpindle;
  std::int32_t mistake = -1;  ///< Equal for contacts of the same mover, with the same tool, with the same obstacle.
  BodyDescription described;  ///< Where the obstacle is described.
  bool is_of_material = false;
  bool is_of_edge = false;       ///< W157: because the edge is too short.
  double limit = 0;              ///< W157: how deep the tool may cut; W156: the tolerance; mm.
  std::optional<double> volume;  ///< W156, W161: of what is left or comes free, mm^3.
  std::optional<double> enough;  ///< E150, E151: the Z, in `frame`, with which nothing would have been met, if any; mm.
  /// E150, E151, W154: the line that cut last what is met. E158: that which stopped the spindle. From 0.
  std::optional<std::size_t> shaped_by;

  bool is_near_miss() const;
  /// Whether nothing is hit and nothing passes near: a hint alone (W159), which lists of contacts leave out.
  bool is_hint() const;
};

/// Why something could not be verified.
enum class Gap : std::uint8_t {
  ToolWithoutShape,   ///< The mounted tool has no shape: only the nose and the machine have been compared.
  ToolWithoutLength,  ///< Its length is not known, so that nothing of it is at its place.
  ResolutionTooFine,  ///< The stock would take more memory than there is for it: no material has been removed.
  SetupMistaken,      ///< What describes the setup has a mistake: the run was made without what surrounds the machine.
  Undecided,          ///< A motion for which neither a contact nor its absence could be proven.
  OtherPaths,         ///< A jump that other values of VGPL decide otherwise.
  OtherRegisters,     ///< A jump that other values of a register decide otherwise, which the program has not assigned.
};

/// Something that could not be verified, with the line where it begins.
struct Unverified {
  Gap gap = Gap::Undecided;
  std::size_t line = 0;     ///< From 0.
  dialect::GivenName name;  ///< Of the tool or the register; none for the others.
  std::size_t paths = 1;    ///< Of OtherPaths: the number of paths that have been run.
  double spacing = 0;       ///< Of ResolutionTooFine: one that would fit, mm.
};

/// Where the machine moves with a tool of known length, and is not compared, since a tool before it had none: it is not
/// known where it is.
struct UnknownPlaces {
  std::string after;  ///< That tool, as `T101001`.
  /// From a tool change to the last motion that does not begin and end at a known place; from 0, by their starts.
  std::vector<std::pair<std::size_t, std::size_t>> lines;
};

/// What has been proven, and what not.
struct Certificate {
  std::size_t motions = 0;          ///< Motions of the machine that were examined.
  std::size_t paths = 1;            ///< Paths of the program that were run; what they share counts on each.
  std::size_t contacts = 0;         ///< Near misses do not count.
  double epsilon = 0;               ///< Nothing nearer than this is unseen, mm.
  std::optional<double> soft_disc;  ///< Overlaps with material that hold a disc of this diameter are seen, mm,
  /// where all of the disc is deeper in it than this, mm.
  std::optional<double> soft_depth;
  std::optional<stock::Window> window;  ///< Outside of it nothing is known of the material; frame of the setup.
  bool is_window_empty = false;         ///< Nothing of the blank is in it.
  std::string scene;                    ///< The file that describes the setup, or the machine; as shown to users.
  bool has_setup = true;                ///< Whether a setup is for the program.
  bool is_setup_empty = false;          ///< It describes no body.
  bool has_nose = true;                 ///< Whether the spindle nose is described.
  std::vector<std::string> bare_tools;  ///< Tools without a holder, as `T101001`, whose length is known.
  std::vector<Unverified> gaps;
  std::vector<UnknownPlaces> unknown_places;  ///< One for each tool.
  /// Bodies of the machine that are not compared, since they touch each other from the start: `gantry` and `rails`.
  std::vector<std::pair<std::string, std::string>> touching;
  std::size_t more_contacts = 0;            ///< Contacts and near misses that repeat others and are not kept.
  std::optional<std::size_t> stopped_at;    ///< The line at which an error stopped the run; from 0.
  std::optional<std::size_t> ended_before;  ///< The line before which the run was to end; from 0.
};

}  // namespace isocnc::verification
