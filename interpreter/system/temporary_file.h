#pragma once

#include <filesystem>

namespace isocnc::system {

/// The name of a temporary file that is to be renamed. The destructor removes the file unless it has been renamed.
class TemporaryFile {
 public:
  /// Takes the path of a file that exists or is about to be created.
  explicit TemporaryFile(std::filesystem::path path);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  /// Renames the file over another one. Returns 0 or the errno.
  int rename(const std::filesystem::path& path);
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool is_renamed_ = false;
};

/// After this call, a signal that ends the program (Ctrl-C) removes its temporary files first.
void leave_no_temporary_files();
/// Removes all temporary files; can be called in a signal handler before the program ends.
void remove_temporary_files();

}  // namespace isocnc::system
