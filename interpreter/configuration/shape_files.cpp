#include "interpreter/configuration/shape_files.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/configuration/configurations.h"
#include "interpreter/solids/clearance.h"
#include "interpreter/solids/stl.h"
#include "interpreter/stock/stock_file.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/source_file.h"

namespace isocnc::configuration {

namespace fs = std::filesystem;
using dialect::Text;
using solids::Mesh;
using solids::StlProblem;
using solids::Triangle;

static Mistake mistake(const Text& text, const std::string& name, std::string detail = {}) {
  return {.at = 0, .key = {}, .text = text, .names = {shortened(name), std::move(detail)}, .meant = {}};
}

static Mistake mistake_of(const StlProblem& problem, const std::string& name) {
  using Kind = StlProblem::Kind;
  const bool is_text = problem.line > 0;
  const auto counted = [&](const Text& text, std::uint64_t number) {
    return mistake(text, name, fmt::format("{}", number));
  };
  switch (problem.kind) {
    case Kind::Empty:
      break;
    case Kind::Truncated:
      return is_text || problem.stated == 0 ? counted(mistakes::kMeshTruncated, problem.triangle)
                                            : counted(mistakes::kMeshShort, problem.stated);
    case Kind::TooLong:
      return counted(mistakes::kMeshLong, problem.stated);
    case Kind::UnexpectedWord:
      return counted(mistakes::kMeshWord, problem.line);
    case Kind::NotANumber:
      return counted(mistakes::kMeshNumber, problem.line);
    case Kind::NotFinite:
      return counted(mistakes::kMeshNotFinite, problem.triangle + 1);
    case Kind::TooFar:
      return counted(mistakes::kMeshTooFar, problem.triangle + 1);
    case Kind::TooManyTriangles:
      return mistake(mistakes::kMeshHuge, name);
  }
  return mistake(mistakes::kMeshEmpty, name);
}

/// The texts of a kind of file for what hinders reading it.
struct ReadingTexts {
  const Text& too_large;
  const Text& unreadable;
};

static Mistake mistake_of(const system::FileBytesProblem& problem, const std::string& name, const ReadingTexts& texts) {
  using Kind = system::FileBytesProblem::Kind;
  switch (problem.kind) {
    case Kind::NotRegular:
      return mistake(mistakes::kNotThisKind, name);
    case Kind::TooLarge:
      return mistake(texts.too_large, name, fmt::format("{} MiB", kLargestMesh >> 20));
    case Kind::Unreadable:
      break;
  }
  return mistake(texts.unreadable, name, problem.message);
}

ShapeFiles::MeshOrMistake ShapeFiles::read_mesh(const fs::path& file, const std::string& name) const {
  const auto bytes = system::read_bytes(file, kLargestMesh, language_);
  if (const auto* const problem = std::get_if<system::FileBytesProblem>(&bytes))
    return mistake_of(*problem, name, {mistakes::kMeshTooLarge, mistakes::kFileProblem});
  auto triangles = solids::read_stl(std::get<std::string>(bytes));
  if (const auto* const problem = std::get_if<StlProblem>(&triangles)) return mistake_of(*problem, name);
  auto mesh = std::make_shared<const Mesh>(std::get<std::vector<Triangle>>(std::move(triangles)));
  // Where nothing is inside, nothing can be found to be inside.
  const solids::MeshTopology& topology = mesh->topology();
  if (topology.open_edges > 0) return mistake(mistakes::kMeshOpen, name, fmt::format("{}", topology.open_edges));
  if (!topology.is_closed()) return mistake(mistakes::kMeshFlat, name);
  if (topology.faces_outwards()) return mesh;
  // All triangles face inwards, as after mirroring in a CAD system: the solid is the same.
  std::vector<Triangle> turned(mesh->triangles().begin(), mesh->triangles().end());
  for (Triangle& triangle : turned) std::swap(triangle.corners[1], triangle.corners[2]);
  return std::make_shared<const Mesh>(std::move(turned));
}

/// The file of a name; none if it is outside the folder.
static std::optional<fs::path> file_below(const fs::path& folder, const std::string& name) {
  const fs::path file = real_path(folder / name);
  const fs::path below = file.lexically_relative(folder);
  return below.empty() || *below.begin() == ".." ? std::nullopt : std::optional(file);
}

/// What a file holds, which is read the first time that it is asked for.
template <class Loaded, class Read>
const Loaded& ShapeFiles::loaded(LoadedFiles<Loaded>& files, const fs::path& folder, const std::string& name,
                                 const Read& read) {
  LoadedFile<Loaded>& known = [&]() -> LoadedFile<Loaded>& {
    const std::lock_guard lock(mutex_);
    return files[{system::generic_name(folder), name}];
  }();
  const std::lock_guard lock(known.mutex);
  if (known.content) return *known.content;
  const std::optional<fs::path> file = file_below(folder, name);
  return known.content.emplace(file ? read(*file) : Loaded(mistake(mistakes::kOutsideFolder, name)));
}

ShapeFiles::MeshOrMistake ShapeFiles::mesh(const fs::path& folder, const std::string& name,
                                           const std::optional<geometry::Vec3>& shift) {
  const MeshOrMistake& unshifted =
      loaded(meshes_, folder, name, [&](const fs::path& file) { return read_mesh(file, name); });
  const auto* const mesh = std::get_if<std::shared_ptr<const Mesh>>(&unshifted);
  if (mesh == nullptr || !shift || shift->isZero(0)) return unshifted;
  const std::lock_guard lock(mutex_);
  const std::tuple key(system::generic_name(folder), name, shift->x(), shift->y(), shift->z());
  if (const auto known = shifted_.find(key); known != shifted_.end()) return known->second;
  const solids::BoundingBox box = (*mesh)->bounds().translated(*shift);
  if (box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff() > solids::kMaxCoordinate)
    return mistake(mistakes::kMeshShiftedTooFar, name);
  std::vector<Triangle> triangles((*mesh)->triangles().begin(), (*mesh)->triangles().end());
  for (Triangle& triangle : triangles)
    for (geometry::Vec3& corner : triangle.corners) corner += *shift;
  return shifted_[key] = std::make_shared<const Mesh>(std::move(triangles));
}

ShapeFiles::StockOrMistake ShapeFiles::read_stock(const fs::path& file, const std::string& name) const {
  const auto bytes = system::read_bytes(file, kLargestMesh, language_);
  if (const auto* const problem = std::get_if<system::FileBytesProblem>(&bytes))
    return mistake_of(*problem, name, {mistakes::kStockTooLarge, mistakes::kStockUnreadable});
  auto read = stock::read_stock(std::get<std::string>(bytes));
  if (auto* const left = std::get_if<stock::Stock>(&read))
    return std::make_shared<const stock::Stock>(std::move(*left));
  using Kind = stock::StockFileProblem::Kind;
  const auto& problem = std::get<stock::StockFileProblem>(read);
  switch (problem.kind) {
    case Kind::NotAStock:
      return mistake(mistakes::kNoStock, name);
    case Kind::OtherVersion:
      return mistake(mistakes::kStockVersion, name);
    case Kind::TooLarge:
      return mistake(mistakes::kStockTooLarge, name);
    case Kind::Damaged:
      return mistake(mistakes::kStockDamaged, name);
    case Kind::Truncated:
    case Kind::TooLong:
    case Kind::ImpossibleValue:
      break;
  }
  return mistake(mistakes::kStockBroken, name, fmt::format("{}", problem.offset));
}

ShapeFiles::StockOrMistake ShapeFiles::stock(const fs::path& folder, const std::string& name) {
  return loaded(stocks_, folder, name, [&](const fs::path& file) { return read_stock(file, name); });
}

}  // namespace isocnc::configuration
