#include "interpreter/running/same_file.h"

#include <system_error>

namespace isocnc::running {

namespace fs = std::filesystem;

/// Where a file would be made that is not there yet: links to nowhere are followed.
static fs::path place_of(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i)
    path = path.parent_path() / fs::read_symlink(path, error);
  return fs::weakly_canonical(fs::absolute(path, error), error);
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (fs::exists(a, error) || fs::exists(b, error)) return fs::is_regular_file(a, error) && fs::equivalent(a, b, error);
  const fs::path place = place_of(a);
  return !place.empty() && place == place_of(b);
}

}  // namespace isocnc::running
