#include "interpreter/system/windows/handle.h"

#include <windows.h>

#include <io.h>

#include "interpreter/system/windows/errors.h"
#include "interpreter/system/windows/native_path.h"

namespace isocnc::system {

void* open_shared(const std::filesystem::path& path, unsigned long access, unsigned long how) {
  constexpr DWORD kShared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  // A folder opens only with this flag, so that its status can tell what it is.
  constexpr DWORD kFlags = FILE_ATTRIBUTE_NORMAL | FILE_FLAG_BACKUP_SEMANTICS;
  HANDLE const file = ::CreateFileW(native(path).c_str(), access, kShared, nullptr, how, kFlags, nullptr);
  if (file == INVALID_HANDLE_VALUE) keep_last_error();
  return file;
}

void* handle_of(int descriptor) { return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor)); }

}  // namespace isocnc::system
