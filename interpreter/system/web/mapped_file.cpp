#include "interpreter/system/mapped_file.h"

#include <cerrno>

namespace isocnc::system {

/// There is no memory but the module's: a mapped file would be a copy, so files are read.
MappedFile::MappedFile(const std::filesystem::path&, int, std::size_t size, dialect::Language)
    : size_(size), error_(ENODEV) {}

MappedFile::~MappedFile() = default;

void MappedFile::will_be_read_in_order() const {}

const std::string* MappedFile::complaint_of(const void*) const { return nullptr; }

void report_lost_bytes(std::string_view) {}

}  // namespace isocnc::system
