#include "interpreter/system/same_file.h"

#include <system_error>

#include "interpreter/system/paths.h"

namespace isocnc::system {

namespace fs = std::filesystem;

static constexpr int kMaxSymlinks = 40;

fs::path place_of(fs::path path) {
  std::error_code error;
  for (int i = 0; i < kMaxSymlinks && fs::is_symlink(path, error); ++i)
    path = path.parent_path() / fs::read_symlink(path, error);
  return system::weakly_canonical(system::absolute(path, error), error);
}

bool names_descriptor(fs::path path) {
  std::error_code error;
  for (int i = 0; i < kMaxSymlinks && fs::is_symlink(path, error); ++i) {
    const fs::path folder = system::canonical(system::absolute(path, error).parent_path(), error);
    if (generic_name(folder).starts_with("/proc/")) return true;
    path = folder / fs::read_symlink(path, error);
  }
  return false;
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (fs::exists(a, error) || fs::exists(b, error)) return fs::is_regular_file(a, error) && fs::equivalent(a, b, error);
  const fs::path place = place_of(a);
  return !place.empty() && place == place_of(b);
}

}  // namespace isocnc::system
