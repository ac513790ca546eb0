#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "interpreter/configuration/configuration.h"
#include "interpreter/configuration/make_scene.h"
#include "interpreter/configuration/mistake.h"
#include "interpreter/configuration/shape_files.h"
#include "interpreter/verification/scene.h"

namespace isocnc::configuration {

/// The setup of `door.iso` may be a file beside it: `door.setup.json`.
inline constexpr std::string_view kSetupExtension = ".setup.json";
std::filesystem::path setup_file(const std::filesystem::path& program);
/// Whether a file has the name of such a setup.
bool is_setup_file(const std::filesystem::path& file);

/// A mistake in a file that describes surroundings, or why it or a file with a shape that it names cannot be read.
struct SurroundingsMistake {
  std::string file;  ///< As shown to users.
  LineColumn place;
  Mistake mistake;                  ///< Its place in the text is not known.
  bool is_of_whole_file = false;    ///< It has no place.
  std::filesystem::path real_file;  ///< The file without symlinks, where it is one of a shape.
  bool is_of_shape = false;         ///< `mistake.key` names a file with a shape, and `mistake.names` starts with it.
};

/// The scenes of programs. The file beside a program outweighs the `setups` of its configuration. Files are read when a
/// program first needs them, and those with shapes once; another object sees what has changed since. All functions may
/// be called by several threads at the same time: a caller waits for the files that it needs, and for no others.
class Scenes {
 public:
  /// `language` is the language of system errors about files.
  explicit Scenes(dialect::Language language) : language_(language), files_(language) {}

  /// The scene of a program, which programs with the same setup share; an empty path is a program without a file. Null
  /// if no setup is for the program and the machine has no bodies, and where `mistakes` has an error. The
  /// configuration has no mistakes, and stays where it is, unchanged, as long as this object.
  std::shared_ptr<const verification::Scene> of(const Configuration& configuration,
                                                const std::filesystem::path& program);

  /// Whether a program has no scene because of a mistake in what describes it.
  bool is_mistaken(const Configuration& configuration, const std::filesystem::path& program);

  /// Mistakes in the files read so far, one line each: `door.setup.json:3:12: error: fixtures[0].mesh: ...`.
  std::vector<std::string> mistakes(dialect::Language language) const;
  /// The same as data.
  std::vector<SurroundingsMistake> all_mistakes() const;

 private:
  using ScenePointer = std::shared_ptr<const verification::Scene>;

  /// The scene of a program with a setup of its own.
  struct OwnScene {
    std::mutex mutex;  // Of the other members.
    bool has_mistakes = false;
    std::weak_ptr<const verification::Scene> scene;
  };

  /// The scene of an entry of `setups`, or of the machine alone.
  struct EntryScene {
    std::mutex mutex;  // Of the other members.
    bool is_made = false;
    ScenePointer scene;
  };

  template <class Key, class Value>
  Value& member_of(std::map<Key, Value>& scenes, const Key& key);
  void note(SurroundingsMistake mistake);
  ScenePointer own_scene(const Configuration& configuration, const std::filesystem::path& file);
  std::optional<DescribedSetup> read_setup_file(const std::filesystem::path& file, const std::filesystem::path& folder);
  ScenePointer scene_of_entry(const Configuration& configuration, const std::filesystem::path& program);
  static std::optional<std::size_t> entry_of(const Configuration& configuration, const std::filesystem::path& program);
  ScenePointer make(const Configuration& configuration, const std::optional<LocatedSetup>& setup);

  const dialect::Language language_;
  ShapeFiles files_;
  mutable std::mutex mutex_;  // Of the members below, but not of the scenes in them. No file is read under it.
  std::vector<SurroundingsMistake> mistakes_;
  /// Where files name shapes that cannot be had, by file, line and column: one of the machine is missing from many
  /// scenes, and reported once.
  std::set<std::tuple<std::string, std::size_t, std::size_t>> missing_shapes_;
  std::map<std::pair<const Configuration*, std::optional<std::size_t>>, EntryScene> entries_;  // By index in setups.
  std::map<std::pair<const Configuration*, std::string>, OwnScene> own_;                       // By file.
};

}  // namespace isocnc::configuration
