#include "interpreter/system/paths.h"

namespace isocnc::system {

namespace fs = std::filesystem;

std::string generic_name(const fs::path& path) { return path.generic_string(); }

fs::path normal(const fs::path& path) { return path.lexically_normal(); }

bool has_root_name(const fs::path& path) { return path.has_root_name(); }

bool is_absolute(const fs::path& path) { return path.is_absolute(); }

fs::path absolute(const fs::path& path, std::error_code& error) { return fs::absolute(path, error); }

fs::path canonical(const fs::path& path, std::error_code& error) { return fs::canonical(path, error); }

fs::path weakly_canonical(const fs::path& path, std::error_code& error) { return fs::weakly_canonical(path, error); }

fs::path absolute(const fs::path& path) {
  std::error_code error;
  fs::path whole = fs::absolute(path, error);
  return error ? path : whole;
}

std::vector<FolderEntry> entries_of(const fs::path& folder, std::error_code& error) {
  std::vector<FolderEntry> entries;
  for (fs::directory_iterator at(folder, error); !error && at != fs::end(at); at.increment(error)) {
    std::error_code ignored;
    entries.push_back({.name = at->path().filename(),
                       .is_symlink = at->is_symlink(ignored),
                       .is_folder = at->is_directory(ignored),
                       .is_file = at->is_regular_file(ignored)});
  }
  return entries;
}

}  // namespace isocnc::system
