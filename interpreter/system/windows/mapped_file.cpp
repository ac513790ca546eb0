#include "interpreter/system/mapped_file.h"

#include <cerrno>

namespace isocnc::system {

/// Where files are always read. Under Windows a file that is mapped cannot be cut or replaced, so that a CAM system
/// could not post the program again; for WebAssembly there is no memory but the module's.
MappedFile::MappedFile(const std::filesystem::path&, int, std::size_t size, dialect::Language)
    : size_(size), error_(ENODEV) {}

MappedFile::~MappedFile() = default;

void MappedFile::will_be_read_in_order() const {}

const std::string* MappedFile::complaint_of(const void*) const { return nullptr; }

void report_lost_bytes(std::string_view) {}

}  // namespace isocnc::system
