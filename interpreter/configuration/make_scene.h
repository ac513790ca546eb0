#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "interpreter/configuration/configuration.h"
#include "interpreter/solids/mesh.h"
#include "interpreter/verification/scene.h"

namespace isocnc::configuration {

/// A mesh that a file names.
struct MeshRequest {
  const MeshFile& mesh;
  std::optional<geometry::Vec3> at;     ///< Shift, mm.
  const std::filesystem::path& file;    ///< The file that names it, as shown to users.
  const std::filesystem::path& folder;  ///< Its folder.
};

/// Returns null for a mesh that cannot be had, whose body is then missing from the scene.
using MeshSource = std::function<std::shared_ptr<const solids::Mesh>(const MeshRequest& request)>;

/// A setup and the file that describes it.
struct LocatedSetup {
  const DescribedSetup& setup;
  const std::filesystem::path& file;    ///< As shown to users.
  const std::filesystem::path& folder;  ///< Of the file.
};

/// The scene of a machine, with a setup or without. Both come from files without mistakes.
verification::Scene make_scene(const MachineConfiguration& machine, const std::optional<LocatedSetup>& setup,
                               const MeshSource& meshes);

}  // namespace isocnc::configuration
