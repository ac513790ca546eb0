#include "interpreter/system/windows/native_path.h"

#include "interpreter/system/paths.h"

namespace isocnc::system {

std::wstring native(const std::filesystem::path& path) {
  static constexpr std::size_t kLongestPlain = 248;
  if (path.native().size() < kLongestPlain || path.native().starts_with(LR"(\\?\)")) return path.native();
  const std::wstring whole = normal(system::absolute(path)).make_preferred().native();
  return whole.starts_with(LR"(\\)") ? LR"(\\?\UNC\)" + whole.substr(2) : LR"(\\?\)" + whole;
}

}  // namespace isocnc::system
