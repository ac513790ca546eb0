#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::system {

/// A file whose bytes are the system's until they are looked at.
class MappedFile {
 public:
  /// Of an open file, which may be closed afterwards. `path` is what it is called when its bytes are lost.
  MappedFile(const std::filesystem::path& path, int descriptor, std::size_t size, dialect::Language language);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  /// An errno when it cannot be mapped; else 0.
  int error() const { return error_; }
  std::string_view bytes() const { return {begin_, size_}; }
  void will_be_read_in_order() const;

  /// What is told when an access to this address fails; nullptr when it is none of the bytes.
  const std::string* complaint_of(const void* address) const;

 private:
  const char* begin_ = nullptr;
  std::size_t size_;
  int error_ = 0;
  std::string complaint_;
};

/// From now on a program that touches bytes of a mapped file that another one has cut short says so, in the file's
/// name, and ends with the status of trouble. Without this it ends by SIGBUS.
void report_lost_bytes(std::string_view program);

}  // namespace isocnc::system
