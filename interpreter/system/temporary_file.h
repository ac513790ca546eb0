#pragma once

#include <filesystem>
#include <string>

namespace isocnc::system {

/// The name of a file that is written to be given another one. Gone with this, unless it has got it.
class TemporaryFile {
 public:
  /// Of a file that there is, or is about to be.
  explicit TemporaryFile(std::string path);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  /// Puts the file in the place of another one. Returns 0 or the errno.
  int rename(const std::filesystem::path& path);
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  bool is_renamed_ = false;
};

/// From now on a signal that asks the program to end (Ctrl-C) leaves no temporary files behind.
void leave_no_temporary_files();
/// Removes those that there are; may be called by the handler of a signal, before the end.
void remove_temporary_files();

}  // namespace isocnc::system
