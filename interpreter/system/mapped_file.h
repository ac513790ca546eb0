#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::system {

/// A file mapped into memory; the system loads its bytes on access.
class MappedFile {
 public:
  /// Maps an open file, which may be closed afterward. `path` names the file in the message about lost bytes.
  MappedFile(const std::filesystem::path& path, int descriptor, std::size_t size, dialect::Language language);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  /// 0, or the errno if the file cannot be mapped.
  int error() const { return error_; }
  std::string_view bytes() const { return {begin_, size_}; }
  void will_be_read_in_order() const;

  /// The message for a failed access to this address; nullptr if the address is outside the file.
  const std::string* complaint_of(const void* address) const;

 private:
  const char* begin_ = nullptr;
  std::size_t size_;
  int error_ = 0;
  std::string complaint_;
};

/// After this call, access to bytes of a mapped file that another program has cut short prints a message with the
/// file's name and ends the program with ExitStatus::Failure. Without this call SIGBUS ends it.
void report_lost_bytes(std::string_view program);

}  // namespace isocnc::system
