#pragma once

#include <optional>
#include <vector>

#include "interpreter/removal/material_check.h"
#include "interpreter/verification/contact.h"
#include "interpreter/verification/scene.h"

namespace isocnc::verification {

/// How the material is simulated, where the setup does not say otherwise.
struct MaterialOptions {
  bool is_cut = true;                ///< Otherwise nothing is asked about material.
  std::optional<double> resolution;  ///< Spacing of the dexels, mm; outweighs that of the setup.
  /// The part of the blank that is looked at, in the frame of the setup; all of it without.
  std::optional<stock::Window> window = {};
  std::optional<double> max_dexels;  ///< Makes the spacing coarser, so that there are not more.
};

/// Spacings of dexels that may be asked for, mm.
inline constexpr double kFinestResolution = 0.01;
inline constexpr double kCoarsestResolution = 100;

/// The memory that a stock may take, bytes.
inline constexpr double kMaxStockMemory = 2e9;

/// What a scene has to be cut, with its spacing; none if it describes no stock. `origin` is that of the setup's frame.
std::optional<removal::Workpiece> workpiece_of(const Scene& scene, const geometry::Vec3& origin,
                                               const MaterialOptions& options);

/// The spacing that would fit instead, mm, if a workpiece takes more memory than a stock may.
std::optional<double> coarser_spacing(const removal::Workpiece& workpiece);

/// The bodies of a mounted tool, for cutting. The result refers to the scene.
removal::CuttingTool cutting_tool(const Scene& scene, const MountedTool& tool);

/// What an incident is reported as.
dialect::DiagnosticId diagnostic_of(removal::IncidentKind kind);

/// An incident with the material as a contact.
Contact contact_of(const removal::Incident& incident, const Scene& scene);

/// What has become of the material in a run.
struct MaterialReport {
  double blank_volume = 0;  ///< mm^3
  std::vector<removal::RemovedByTool> by_tool;
  std::vector<simulation::RemovedOnLine> by_line;  ///< In the order of the run.
  stock::Stock stock;                              ///< What remains; in the frame of the setup.
  geometry::Vec3 origin = geometry::Vec3::Zero();  ///< Of that frame; machine frame, mm.
};

}  // namespace isocnc::verification
