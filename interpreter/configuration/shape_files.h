#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>

#include "interpreter/configuration/mistake.h"
#include "interpreter/geometry/vectors.h"
#include "interpreter/solids/mesh.h"
#include "interpreter/stock/stock.h"

namespace isocnc::configuration {

/// Maximum size of an STL file, in bytes: some ten million triangles.
inline constexpr std::size_t kLargestMesh = std::size_t{512} * 1024 * 1024;

/// The usual extensions of these files.
inline constexpr std::string_view kShapeExtensions[] = {".stl", ".stock"};

/// The meshes of STL files, and the stocks of files that `isorun --stock-out` has written. Each file is read once, and
/// bodies with the same file and shift share one mesh. All functions may be called by several threads at the same time:
/// a caller waits for the file that it needs, and for no other.
class ShapeFiles {
 public:
  using MeshOrMistake = std::variant<std::shared_ptr<const solids::Mesh>, Mistake>;
  using StockOrMistake = std::variant<std::shared_ptr<const stock::Stock>, Mistake>;

  /// `language` is the language of system errors about files.
  explicit ShapeFiles(dialect::Language language) : language_(language) {}

  /// The mesh of a file, shifted; else a mistake without place and key. `name` is relative to `folder`, which is
  /// absolute and without symlinks; a file that a symlink takes out of the folder is refused.
  MeshOrMistake mesh(const std::filesystem::path& folder, const std::string& name,
                     const std::optional<geometry::Vec3>& shift);
  /// The stock of a file, in the same way.
  StockOrMistake stock(const std::filesystem::path& folder, const std::string& name);

 private:
  /// What files hold, by folder and name.
  template <class Loaded>
  struct LoadedFile {
    std::mutex mutex;  // Of the other member, which does not change once it is there.
    std::optional<Loaded> content;
  };
  template <class Loaded>
  using LoadedFiles = std::map<std::pair<std::string, std::string>, LoadedFile<Loaded>>;

  template <class Loaded, class Read>
  const Loaded& loaded(LoadedFiles<Loaded>& files, const std::filesystem::path& folder, const std::string& name,
                       const Read& read);

  MeshOrMistake read_mesh(const std::filesystem::path& file, const std::string& name) const;
  StockOrMistake read_stock(const std::filesystem::path& file, const std::string& name) const;

  const dialect::Language language_;
  std::mutex mutex_;  // Of the members below, but not of the files in them. No file is read under it.
  LoadedFiles<MeshOrMistake> meshes_;
  LoadedFiles<StockOrMistake> stocks_;
  /// By folder, name and shift.
  std::map<std::tuple<std::string, std::string, double, double, double>, std::shared_ptr<const solids::Mesh>> shifted_;
};

}  // namespace isocnc::configuration
