#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>

#include "interpreter/configuration/mistake.h"
#include "interpreter/geometry/vectors.h"
#include "interpreter/solids/mesh.h"

namespace isocnc::configuration {

/// Maximum size of an STL file, in bytes: some ten million triangles.
inline constexpr std::size_t kLargestMesh = std::size_t{512} * 1024 * 1024;

/// The usual extension of STL files.
inline constexpr std::string_view kMeshExtension = ".stl";

/// The meshes of STL files. Each file is read once, and bodies with the same file and shift share one mesh.
class Meshes {
 public:
  using MeshOrMistake = std::variant<std::shared_ptr<const solids::Mesh>, Mistake>;

  /// `language` is the language of system errors about files.
  explicit Meshes(dialect::Language language) : language_(language) {}

  /// The mesh of a file, shifted; else a mistake without place and key. `name` is relative to `folder`, which is
  /// absolute and without symlinks; a file that a symlink takes out of the folder is refused.
  MeshOrMistake load(const std::filesystem::path& folder, const std::string& name,
                     const std::optional<geometry::Vec3>& shift);

 private:
  const MeshOrMistake& unshifted(const std::filesystem::path& folder, const std::string& name);
  MeshOrMistake read(const std::filesystem::path& file, const std::string& name) const;

  const dialect::Language language_;
  std::map<std::pair<std::string, std::string>, MeshOrMistake> files_;  // By folder and name.
  /// By folder, name and shift.
  std::map<std::tuple<std::string, std::string, double, double, double>, std::shared_ptr<const solids::Mesh>> shifted_;
};

}  // namespace isocnc::configuration
