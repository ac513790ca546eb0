#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::system {

/// Why a file has no bytes for its reader.
struct FileBytesProblem {
  enum class Kind : std::uint8_t {
    Unreadable,  ///< The system refuses, as `message` says.
    NotRegular,  ///< A folder, a pipe, a device.
    TooLarge,    ///< More bytes than wanted.
  };

  Kind kind = Kind::Unreadable;
  std::string message;  ///< `cannot read: Permission denied`; empty for the other kinds.
};

/// Reads a regular file of any content, of at most `limit` bytes. Never waits for a pipe, and reads no device.
std::variant<std::string, FileBytesProblem> read_bytes(const std::filesystem::path& path, std::size_t limit,
                                                       dialect::Language language);

}  // namespace isocnc::system
