#include "interpreter/configuration/configurations.h"

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "interpreter/configuration/read.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/source_file.h"
#include "interpreter/system/system_texts.h"
#include "interpreter/text/unicode.h"

namespace isocnc::configuration {

namespace fs = std::filesystem;
using dialect::Language;
using system::SourceFile;

fs::path real_path(const fs::path& path) {
  std::error_code error;
  fs::path real = system::weakly_canonical(path.empty() ? "." : path, error);
  if (error) real = system::normal(system::absolute(path, error));
  // A path that does not exist is still relative.
  if (!system::is_absolute(real)) real = system::normal(fs::current_path(error) / real);
  return real;
}

/// The path as shown to users: relative if it is below the current folder.
static fs::path shown_path(const fs::path& file) {
  std::error_code error;
  const fs::path relative = file.lexically_relative(fs::current_path(error));
  return error || relative.empty() || *relative.begin() == ".." ? file : relative;
}

Configurations::Configurations(ConfigurationSource source, Language language)
    : source_(std::move(source)), language_(language) {}

const Configuration* Configurations::find(const ByPath& known, const fs::path& path) const {
  const std::lock_guard lock(mutex_);
  const auto found = known.find(system::generic_name(path));
  return found == known.end() ? nullptr : found->second;
}

/// Another thread may have found the same meanwhile.
const Configuration& Configurations::keep(ByPath& known, const fs::path& path, const Configuration& found) {
  const std::lock_guard lock(mutex_);
  return *known.try_emplace(system::generic_name(path), &found).first->second;
}

const Configuration& Configurations::in_folder(const fs::path& folder) {
  if (source_.none) return none_;
  if (source_.file) return load(*source_.file, *source_.file);
  if (const Configuration* const before = find(asked_, folder)) return *before;
  return keep(asked_, folder, nearest(real_path(folder)));
}

const Configuration& Configurations::of(const fs::path& path) {
  std::error_code error;
  return in_folder(fs::is_directory(path, error) ? path : path.parent_path());
}

/// Whether a file may be there although it could not be looked at: a disk or a server in trouble, unlike a folder in
/// which the user may not look for anything.
static bool is_trouble(const std::error_code& error) {
  static constexpr std::errc kNoTrouble[] = {
      std::errc::no_such_file_or_directory, std::errc::not_a_directory,   std::errc::permission_denied,
      std::errc::operation_not_permitted,   std::errc::filename_too_long, std::errc::too_many_symbolic_link_levels,
      std::errc::invalid_argument};
  return error &&
         std::none_of(std::begin(kNoTrouble), std::end(kNoTrouble), [&](std::errc each) { return error == each; });
}

Configurations::File& Configurations::file_of(const fs::path& file) {
  const std::lock_guard lock(mutex_);
  File*& named = file_named_[system::generic_name(file)];
  if (named == nullptr) named = files_.emplace_back(std::make_unique<File>()).get();
  return *named;
}

const Configuration& Configurations::note_unreachable(const fs::path& file, const std::error_code& error) {
  File& noted = file_of(file);
  const std::lock_guard lock(noted.mutex);
  if (!noted.is_read) {
    noted.configuration.file = shown_path(file);
    noted.problem = system::cannot_read(error, language_);
    noted.is_read = true;
  }
  return noted.configuration;
}

const Configuration& Configurations::nearest(const fs::path& folder) {
  if (const Configuration* const before = find(folders_, folder)) return *before;
  const fs::path file = folder / kFileName;
  std::error_code error;
  const bool is_here = fs::exists(fs::symlink_status(file, error));  // Includes broken links, which are reported.
  const Configuration* found = &none_;
  if (is_here) {
    found = &load(file, shown_path(file));
  } else if (is_trouble(error)) {
    found = &note_unreachable(file, error);
  } else if (folder.has_relative_path()) {
    found = &nearest(folder.parent_path());
  }
  return keep(folders_, folder, *found);
}

const Configuration& Configurations::load(const fs::path& file, const fs::path& shown) {
  File& loaded = file_of(file);
  const std::lock_guard lock(loaded.mutex);
  if (!loaded.is_read) read(file, shown, loaded);
  loaded.is_read = true;
  return loaded.configuration;
}

void Configurations::read(const fs::path& file, const fs::path& shown, File& loaded) const {
  loaded.configuration.file = shown;
  std::error_code error;
  const auto complain = [&](Mistake mistake, std::string_view text) {
    loaded.mistakes.emplace_back(place_of(mistake.at, text), std::move(mistake));
  };
  // Reading a pipe would block, so one is read only if the user names it.
  const fs::file_status status = fs::status(file, error);
  if (!source_.file && fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) {
    loaded.problem = mistakes::kNoFile.in(language_);
    return;
  }
  const auto opened = SourceFile::open(file, language_);
  if (const auto* const problem = std::get_if<SourceFile::Problem>(&opened)) {
    loaded.problem = problem->message;
    return;
  }
  const auto& source = std::get<SourceFile>(opened);
  if (source.has_byte_order_mark()) complain({.text = mistakes::kByteOrderMark}, {});
  if (source.text().size() > kLongestFile) {
    complain({.text = mistakes::kTooLarge}, {});
    return;
  }
  ReadConfiguration content = read_configuration(source.text(), real_path(file.parent_path()));
  for (Mistake& mistake : content.mistakes) complain(std::move(mistake), source.text());
  loaded.configuration = std::move(content.configuration);
  loaded.configuration.file = shown;
  loaded.configuration.machine.file = shown;
}

std::vector<std::string> Configurations::mistakes(Language language) const {
  std::vector<File*> files;
  {
    const std::lock_guard lock(mutex_);
    for (const std::unique_ptr<File>& file : files_) files.push_back(file.get());
  }
  std::vector<std::string> lines;
  const std::string_view error = dialect::severity_name(dialect::Severity::Error, language);
  for (File* const file : files) {
    const std::lock_guard lock(file->mutex);
    const std::string name = system::generic_name(file->configuration.file);
    if (!file->problem.empty()) lines.push_back(text::printable(fmt::format("{}: {}: {}", name, error, file->problem)));
    for (const auto& [place, mistake] : file->mistakes)
      lines.push_back(located_message(name, place, mistake, language));
  }
  return lines;
}

}  // namespace isocnc::configuration
