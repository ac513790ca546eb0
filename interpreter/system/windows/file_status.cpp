#include "interpreter/system/file_status.h"

#include <windows.h>

#include <aclapi.h>

#include <algorithm>
#include <cerrno>
#include <memory>

#include "interpreter/system/windows/errors.h"
#include "interpreter/system/windows/handle.h"
#include "interpreter/system/windows/native_path.h"

namespace isocnc::system {

namespace fs = std::filesystem;

namespace {

struct HandleCloser {
  void operator()(void* handle) const { ::CloseHandle(handle); }
};

struct LocalFreer {
  void operator()(void* memory) const { ::LocalFree(memory); }
};

std::optional<FileStatus> status_of(HANDLE file) {
  const DWORD type = ::GetFileType(file);
  if (type == FILE_TYPE_CHAR || type == FILE_TYPE_PIPE) return FileStatus{};
  BY_HANDLE_FILE_INFORMATION info{};
  if (::GetFileInformationByHandle(file, &info) == 0) {
    keep_last_error();
    return std::nullopt;
  }
  const auto joined = [](DWORD high, DWORD low) { return (std::uint64_t{high} << 32) | low; };
  FileStatus status;
  status.kind =
      (info.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0 ? FileStatus::Kind::Folder : FileStatus::Kind::Regular;
  status.size = joined(info.nFileSizeHigh, info.nFileSizeLow);
  status.identity = {info.dwVolumeSerialNumber, joined(info.nFileIndexHigh, info.nFileIndexLow), 0};
  // ReFS has numbers of 128 bits, of which the ones above are a part.
  FILE_ID_INFO wide{};
  if (::GetFileInformationByHandleEx(file, FileIdInfo, &wide, sizeof wide) != 0) {
    std::uint64_t halves[2];
    static_assert(sizeof halves == sizeof wide.FileId);
    std::copy_n(wide.FileId.Identifier, sizeof halves, reinterpret_cast<BYTE*>(halves));
    status.identity = {wide.VolumeSerialNumber, halves[0], halves[1]};
  }
  status.names = info.nNumberOfLinks;
  status.changed =
      static_cast<std::int64_t>(joined(info.ftLastWriteTime.dwHighDateTime, info.ftLastWriteTime.dwLowDateTime));
  return status;
}

}  // namespace

/// Null on failure, with the reason in errno.
static std::unique_ptr<void, HandleCloser> open(const fs::path& path, DWORD access) {
  HANDLE const file = open_shared(path, access, OPEN_EXISTING);
  return std::unique_ptr<void, HandleCloser>(file == INVALID_HANDLE_VALUE ? nullptr : file);
}

std::optional<FileStatus> status_of(const fs::path& path) {
  const auto file = open(path, FILE_READ_ATTRIBUTES);
  return file ? status_of(file.get()) : std::nullopt;
}

std::optional<FileStatus> status_of(int descriptor) { return status_of(handle_of(descriptor)); }

bool may_write(const fs::path& path) {
  const DWORD attributes = ::GetFileAttributesW(native(path).c_str());
  if (attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_READONLY) != 0) {
    errno = EACCES;  // Whoever the user is.
    return false;
  }
  return open(path, FILE_WRITE_DATA) != nullptr;
}

/// Gives a new file the marks of the one that it replaces: hidden, system, to be archived, not to be indexed.
static void take_over_marks(HANDLE file, const fs::path& replaced) {
  constexpr DWORD kMarks =
      FILE_ATTRIBUTE_HIDDEN | FILE_ATTRIBUTE_SYSTEM | FILE_ATTRIBUTE_ARCHIVE | FILE_ATTRIBUTE_NOT_CONTENT_INDEXED;
  const DWORD attributes = ::GetFileAttributesW(native(replaced).c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES) return;
  FILE_BASIC_INFO info{};  // Times of 0 stay as they are.
  info.FileAttributes = (attributes & kMarks) != 0 ? attributes & kMarks : DWORD{FILE_ATTRIBUTE_NORMAL};
  ::SetFileInformationByHandle(file, FileBasicInfo, &info, sizeof info);
}

/// Takes over marks and access rights. Where the user may not set them, those of the folder stay, as for any new file.
bool take_over_attributes(int descriptor, const fs::path& replaced, const FileStatus&) {
  take_over_marks(handle_of(descriptor), replaced);
  PACL rights = nullptr;
  PSECURITY_DESCRIPTOR found = nullptr;
  std::wstring name = native(replaced);
  const DWORD error = ::GetNamedSecurityInfoW(name.data(), SE_FILE_OBJECT, DACL_SECURITY_INFORMATION, nullptr, nullptr,
                                              &rights, nullptr, &found);
  if (error != ERROR_SUCCESS) return true;  // A file system without rights.
  const std::unique_ptr<void, LocalFreer> owned(found);
  SECURITY_DESCRIPTOR_CONTROL control = 0;
  DWORD revision = 0;
  ::GetSecurityDescriptorControl(found, &control, &revision);
  const DWORD inheritance = (control & SE_DACL_PROTECTED) != 0 ? DWORD{PROTECTED_DACL_SECURITY_INFORMATION}
                                                               : DWORD{UNPROTECTED_DACL_SECURITY_INFORMATION};
  ::SetSecurityInfo(handle_of(descriptor), SE_FILE_OBJECT, DACL_SECURITY_INFORMATION | inheritance, nullptr, nullptr,
                    rights, nullptr);
  return true;
}

int rename_over(const fs::path& from, const fs::path& to) {
  // One rename of the file system, so that readers see the one file or the other, and on the disk before we go on.
  const bool is_done =
      ::MoveFileExW(native(from).c_str(), native(to).c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0;
  return is_done ? 0 : errno_of(::GetLastError());
}

void remove_file(const wchar_t* name) { ::DeleteFileW(name); }

}  // namespace isocnc::system
