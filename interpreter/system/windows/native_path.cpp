#include "interpreter/system/windows/native_path.h"

#include <system_error>

namespace isocnc::system {

std::wstring native(const std::filesystem::path& path) {
  static constexpr std::size_t kLongestPlain = 248;
  std::error_code error;
  if (path.native().size() < kLongestPlain || path.native().starts_with(LR"(\\?\)")) return path.native();
  const std::wstring whole = std::filesystem::absolute(path, error).lexically_normal().make_preferred().native();
  if (error) return path.native();
  return whole.starts_with(LR"(\\)") ? LR"(\\?\UNC\)" + whole.substr(2) : LR"(\\?\)" + whole;
}

}  // namespace isocnc::system
