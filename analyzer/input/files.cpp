#include "analyzer/input/files.h"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analyzer/input/gitignore.h"
#include "interpreter/system/file_status.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/system_texts.h"

namespace isocnc::input {

namespace fs = std::filesystem;

/// A path as the user writes it, and as the system resolves it, without symlinks.
struct NamedPath {
  fs::path shown;
  fs::path real;

  NamedPath operator/(const fs::path& name) const { return {shown / name, real / name}; }
};

/// Pipes and other files without a real path keep the given one.
static NamedPath place_of(const fs::path& path) {
  std::error_code error;
  fs::path real = system::canonical(path, error);
  if (error) real = path;
  return {path, std::move(real)};
}

/// The prefix of files in a directory, so that one is `part.iso`, not `./part.iso` or `parts//part.iso`.
static fs::path as_prefix(std::string directory) {
  if (system::normal(fs::path(directory)) == ".") return {};
  while (directory.size() > 1 && directory.ends_with('/')) directory.pop_back();
  return directory;
}

static std::string problem(const fs::path& path, const std::error_code& error, dialect::Language language) {
  return system::generic_name(path) + ": " + system::cannot_read(error, language);
}

namespace {

/// The search of one directory given by the user.
class Search {
 public:
  Search(const RulesOfFolder& rules, dialect::Language language) : rules_(rules), language_(language) {}

  /// Searches a directory, without symlinks: in a tree from elsewhere one may lead to any file, which would then be
  /// shown or overwritten although the user has not named it.
  void search(const NamedPath& directory, const GitIgnore& ignored) {
    const SearchRules rules = rules_(directory.real);
    // The directory is closed before its subdirectories are opened, however deep they go.
    for (const system::FolderEntry& entry : entries(directory)) {
      if (entry.is_symlink) continue;
      if (rules.excluded != nullptr && rules.excluded->name(directory.real / entry.name, entry.is_folder)) continue;
      if (entry.is_folder) {
        enter(directory / entry.name, ignored);
      } else if (is_program(entry, directory.real, rules.extensions) &&
                 !ignored.ignores(directory.real / entry.name, false)) {
        programs_.push_back(directory / entry.name);
      }
    }
  }

  /// The programs, sorted by path.
  std::vector<NamedPath> take_programs() {
    std::sort(programs_.begin(), programs_.end(), [](const NamedPath& a, const NamedPath& b) {
      return system::generic_name(a.shown) < system::generic_name(b.shown);
    });
    return std::move(programs_);
  }
  /// The problems, sorted by path.
  std::vector<std::string> take_problems() {
    std::sort(problems_.begin(), problems_.end());
    return std::move(problems_);
  }

 private:
  std::vector<system::FolderEntry> entries(const NamedPath& directory) {
    std::error_code error;
    std::vector<system::FolderEntry> result = system::entries_of(directory.real, error);
    if (error) problems_.push_back(problem(directory.shown.empty() ? "." : directory.shown, error, language_));
    return result;
  }

  void enter(const NamedPath& directory, const GitIgnore& ignored) {
    if (directory.real.filename().generic_string().starts_with(".git") || ignored.ignores(directory.real, true)) return;
    search(directory, ignored.entering(directory.real));
  }

  /// Whether the entry is a regular file with one of the extensions. A pipe is not: reading it would block.
  static bool is_program(const system::FolderEntry& entry, const fs::path& folder,
                         std::span<const std::string> extensions) {
    if (!entry.is_file || !configuration::is_program_name(entry.name.generic_string(), extensions)) return false;
    const auto status = system::status_of(folder / entry.name);  // Emscripten lists pipes as files.
    // What cannot be looked at is not passed over: who reads it says why.
    return status ? status->kind == system::FileStatus::Kind::Regular : errno != ENOENT;
  }

  const RulesOfFolder& rules_;
  dialect::Language language_;
  std::vector<NamedPath> programs_;
  std::vector<std::string> problems_;
};

/// Collects the files of several paths, each file once.
class Selector {
 public:
  Selector(const RulesOfFolder& rules, dialect::Language language) : rules_(rules), language_(language) {}

  void select(const std::string& path) {
    const std::optional<system::FileStatus> status = system::status_of(fs::path(path));
    if (!status) {
      selection_.problems.push_back(problem(path, std::error_code(errno, std::generic_category()), language_));
    } else if (status->kind == system::FileStatus::Kind::Folder) {
      select_directory(path);
    } else {
      add(place_of(path));
    }
  }

  FileSelection take() { return std::move(selection_); }

 private:
  void select_directory(const std::string& path) {
    const NamedPath directory{as_prefix(path), place_of(path).real};
    Search search(rules_, language_);
    search.search(directory, GitIgnore::at(directory.real));
    for (NamedPath& program : search.take_programs()) add(std::move(program));
    for (std::string& text : search.take_problems()) selection_.problems.push_back(std::move(text));
  }

  void add(NamedPath file) {
    if (taken_.insert(system::generic_name(file.real)).second) selection_.files.push_back(std::move(file.shown));
  }

  const RulesOfFolder& rules_;
  dialect::Language language_;
  std::unordered_set<std::string> taken_;
  FileSelection selection_;
};

}  // namespace

FileSelection select_files(std::span<const std::string> paths, const RulesOfFolder& rules, dialect::Language language) {
  Selector selector(rules, language);
  for (const std::string& path : paths) selector.select(path);
  return selector.take();
}

FileSelection select_files(std::span<const std::string> paths, std::span<const std::string> extensions,
                           dialect::Language language) {
  return select_files(
      paths,
      [&](const fs::path&) {
        return SearchRules{extensions, nullptr};
      },
      language);
}

static constexpr dialect::Text kDashNotAlone{"- (standard input) must be given alone",
                                             "- (lo standard input) va indicato da solo"};
static constexpr dialect::Text kNothingFound{"no programs found", "nessun programma trovato"};

FileSelection select_programs(std::span<const std::string> paths, configuration::Configurations& configurations,
                              dialect::Language language) {
  if (std::find(paths.begin(), paths.end(), "-") != paths.end()) {
    if (paths.size() == 1) return {.files = {"-"}, .problems = {}, .is_refused = false};
    return {.files = {}, .problems = {std::string(kDashNotAlone.in(language))}, .is_refused = true};
  }
  const auto rules = [&](const fs::path& folder) -> SearchRules {
    const configuration::Lint& lint = configurations.in_folder(folder).lint;
    return {lint.extensions, &lint.excluded};
  };
  FileSelection selection = select_files(paths, rules, language);
  if (selection.files.empty() && selection.problems.empty()) {
    const auto& extensions = configurations.of(paths.front()).lint.extensions;
    selection.problems.push_back(fmt::format("{} ({})", kNothingFound.in(language), fmt::join(extensions, " ")));
    selection.is_refused = true;
  }
  return selection;
}

fs::path place_of_program(const fs::path& path, const std::string& stdin_name) {
  return path == "-" ? fs::path(stdin_name) : path;
}

std::uint64_t bytes_of(const std::vector<fs::path>& files) {
  std::uint64_t bytes = 0;
  for (const fs::path& file : files) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (!error) bytes += size;
  }
  return bytes;
}

}  // namespace isocnc::input
