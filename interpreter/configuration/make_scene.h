#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "interpreter/configuration/configuration.h"
#include "interpreter/solids/mesh.h"
#include "interpreter/stock/stock.h"
#include "interpreter/verification/scene.h"

namespace isocnc::configuration {

/// A mesh or a stock that a file names.
struct ShapeRequest {
  const ShapeFile& shape;
  std::optional<geometry::Vec3> at;     ///< Shift of a mesh, mm.
  const std::filesystem::path& file;    ///< The file that names it, as shown to users.
  const std::filesystem::path& folder;  ///< Its folder.
};

/// What files hold. Null for what cannot be had, whose body is then missing from the scene.
struct ShapeSource {
  std::function<std::shared_ptr<const solids::Mesh>(const ShapeRequest& request)> mesh;
  std::function<std::shared_ptr<const stock::Stock>(const ShapeRequest& request)> stock;
};

/// A setup and the file that describes it.
struct LocatedSetup {
  const DescribedSetup& setup;
  const std::filesystem::path& file;    ///< As shown to users.
  const std::filesystem::path& folder;  ///< Of the file.
};

/// The scene of a machine, with a setup or without. Both come from files without mistakes.
verification::Scene make_scene(const MachineConfiguration& machine, const std::optional<LocatedSetup>& setup,
                               const ShapeSource& shapes);

}  // namespace isocnc::configuration
