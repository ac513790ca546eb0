#include "interpreter/system/temporary_file.h"

#include <utility>

#include "interpreter/system/file_status.h"
#include "interpreter/system/handler_table.h"
#include "interpreter/system/process.h"

namespace isocnc::system {

using NativeCharacter = std::filesystem::path::value_type;

/// The names in use. A file that finds no free slot may be left behind.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a handler sees nothing else.
static HandlerTable<NativeCharacter> temporary_names;

TemporaryFile::TemporaryFile(std::filesystem::path path) : path_(std::move(path)) {
  temporary_names.add(path_.c_str());
}

TemporaryFile::~TemporaryFile() {
  if (!is_renamed_) remove_file(path_.c_str());
  temporary_names.remove(path_.c_str());
}

int TemporaryFile::rename(const std::filesystem::path& path) {
  const int error = rename_over(path_, path);
  is_renamed_ = error == 0;
  return error;
}

void remove_temporary_files() {
  temporary_names.for_each([](const NativeCharacter& name) { remove_file(&name); });
}

void leave_no_temporary_files() { before_forced_end(remove_temporary_files); }

}  // namespace isocnc::system
