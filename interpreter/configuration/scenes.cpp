#include "interpreter/configuration/scenes.h"

#include <system_error>
#include <variant>

#include <fmt/format.h>

#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/read.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/source_file.h"
#include "interpreter/text/unicode.h"

namespace isocnc::configuration {

namespace fs = std::filesystem;
using dialect::Language;
using verification::Scene;

fs::path setup_file(const fs::path& program) {
  fs::path name = program.stem();
  name += kSetupExtension;
  return program.parent_path() / name;
}

bool is_setup_file(const fs::path& file) { return file.filename().generic_string().ends_with(kSetupExtension); }

template <class Key, class Value>
Value& Scenes::member_of(std::map<Key, Value>& scenes, const Key& key) {
  const std::lock_guard lock(mutex_);
  return scenes[key];
}

void Scenes::note(SurroundingsMistake mistake) {
  const std::lock_guard lock(mutex_);
  mistakes_.push_back(std::move(mistake));
}

std::shared_ptr<const Scene> Scenes::of(const Configuration& configuration, const fs::path& program) {
  std::error_code error;
  if (program.has_filename()) {
    const fs::path file = setup_file(program);
    // Includes broken links, which are reported.
    if (fs::exists(fs::symlink_status(file, error))) return own_scene(configuration, file);
  }
  return scene_of_entry(configuration, program);
}

Scenes::ScenePointer Scenes::own_scene(const Configuration& configuration, const fs::path& file) {
  OwnScene& own = member_of(own_, {&configuration, system::generic_name(file)});
  const std::lock_guard lock(own.mutex);
  if (own.has_mistakes) return nullptr;
  if (ScenePointer known = own.scene.lock()) return known;
  const fs::path folder = real_path(file.parent_path());
  const std::optional<DescribedSetup> setup = read_setup_file(file, folder);
  const ScenePointer scene =
      setup ? make(configuration, LocatedSetup{.setup = *setup, .file = file, .folder = folder}) : nullptr;
  own.has_mistakes = !scene;
  own.scene = scene;
  return scene;
}

/// The setup that a file describes; none, after its mistakes, if it is wrong.
std::optional<DescribedSetup> Scenes::read_setup_file(const fs::path& file, const fs::path& folder) {
  const std::string shown = system::generic_name(file);
  const auto refuse = [&](const dialect::Text& text, std::vector<Named> names) {
    note({.file = shown,
          .place = {},
          .mistake = {.at = 0, .key = {}, .text = text, .names = std::move(names), .meant = {}},
          .is_of_whole_file = true});
    return std::nullopt;
  };
  // A link to another folder would show what is in there.
  const fs::path below = real_path(file).lexically_relative(folder);
  if (below.empty() || *below.begin() == "..")
    return refuse(mistakes::kOutsideFolder, {file.filename().generic_string()});
  const auto read = system::read_bytes(file, kLongestFile, language_);
  if (const auto* const problem = std::get_if<system::FileBytesProblem>(&read)) {
    using Kind = system::FileBytesProblem::Kind;
    if (problem->kind == Kind::NotRegular) return refuse(mistakes::kNoFile, {});
    if (problem->kind == Kind::TooLarge) return refuse(mistakes::kTooLarge, {});
    return refuse({"{0}", "{0}"}, {problem->message});
  }
  const auto& text = std::get<std::string>(read);
  ReadSetup result;
  if (text.starts_with(system::kByteOrderMark)) {
    result.mistakes.push_back({.at = 0, .key = {}, .text = mistakes::kByteOrderMark, .names = {}, .meant = {}});
  } else {
    result = read_setup(text);
  }
  for (Mistake& mistake : result.mistakes)
    note({.file = shown, .place = place_of(mistake.at, text), .mistake = std::move(mistake)});
  return result.mistakes.empty() ? std::optional(std::move(result.setup)) : std::nullopt;
}

/// The index of the last entry of `setups` for a program.
std::optional<std::size_t> Scenes::entry_of(const Configuration& configuration, const fs::path& program) {
  std::optional<std::size_t> last;
  if (!program.has_filename() || configuration.setups.empty()) return last;
  const fs::path real = real_path(program.parent_path()) / program.filename();
  for (std::size_t i = 0; i < configuration.setups.size(); ++i)
    if (configuration.setups[i].patterns.match(real)) last = i;
  return last;
}

bool Scenes::is_mistaken(const Configuration& configuration, const fs::path& program) {
  if (of(configuration, program)) return false;
  std::error_code error;
  if (program.has_filename() && fs::exists(fs::symlink_status(setup_file(program), error))) return true;
  return entry_of(configuration, program) || !configuration.machine.bodies.empty();
}

/// The scene of the last entry of `setups` for the program, or of the machine alone.
Scenes::ScenePointer Scenes::scene_of_entry(const Configuration& configuration, const fs::path& program) {
  const std::optional<std::size_t> last = entry_of(configuration, program);
  // A program that no entry names is told, wherever others have one.
  if (!last && configuration.machine.bodies.empty() && configuration.setups.empty()) return nullptr;
  EntryScene& entry = member_of(entries_, {&configuration, last});
  const std::lock_guard lock(entry.mutex);
  if (!entry.is_made && last) {
    entry.scene = make(
        configuration,
        LocatedSetup{.setup = configuration.setups[*last], .file = configuration.file, .folder = configuration.folder});
  } else if (!entry.is_made) {
    entry.scene = make(configuration, std::nullopt);
  }
  entry.is_made = true;
  return entry.scene;
}

Scenes::ScenePointer Scenes::make(const Configuration& configuration, const std::optional<LocatedSetup>& setup) {
  bool is_whole = true;
  const auto complain = [&](const ShapeRequest& request, Mistake mistake) {
    is_whole = false;
    mistake.key = request.shape.key;
    const std::string file = system::generic_name(request.file);
    const LineColumn place = request.shape.place.shown;
    const fs::path real = real_path(request.file);
    const std::lock_guard lock(mutex_);
    if (missing_shapes_.emplace(file, place.line, place.column).second)
      mistakes_.push_back(
          {.file = file, .place = place, .mistake = std::move(mistake), .real_file = real, .is_of_shape = true});
  };
  const auto shape_in = [&](auto loaded, const ShapeRequest& request) {
    if (const auto* const mistake = std::get_if<Mistake>(&loaded)) {
      complain(request, *mistake);
      return std::variant_alternative_t<0, decltype(loaded)>{};
    }
    return std::get<0>(std::move(loaded));
  };
  const ShapeSource source{.mesh =
                               [&](const ShapeRequest& request) {
                                 return shape_in(files_.mesh(request.folder, request.shape.name, request.at), request);
                               },
                           .stock =
                               [&](const ShapeRequest& request) {
                                 return shape_in(files_.stock(request.folder, request.shape.name), request);
                               }};
  auto scene = std::make_shared<Scene>(make_scene(configuration.machine, setup, source));
  return is_whole ? scene : nullptr;
}

std::vector<SurroundingsMistake> Scenes::all_mistakes() const {
  const std::lock_guard lock(mutex_);
  return mistakes_;
}

std::vector<std::string> Scenes::mistakes(Language language) const {
  const std::lock_guard lock(mutex_);
  const std::string_view error = dialect::severity_name(dialect::Severity::Error, language);
  std::vector<std::string> lines;
  for (const SurroundingsMistake& each : mistakes_)
    lines.push_back(each.is_of_whole_file
                        ? text::printable(fmt::format("{}: {}: {}", each.file, error, each.mistake.message(language)))
                        : located_message(each.file, each.place, each.mistake, language));
  return lines;
}

}  // namespace isocnc::configuration
