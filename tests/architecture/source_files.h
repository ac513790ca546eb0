#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace isocnc::architecture {

inline const std::filesystem::path kRoot = ISOCNC_SOURCE_DIR;

/// The bytes of a file, whose path counts from the root of the repository.
std::string read(const std::filesystem::path& file);

/// The C++ files of the four wings, as sorted paths from the root.
std::vector<std::string> sources();

struct Include {
  std::string header;
  bool is_ours = false;  ///< In quotes.
};

std::vector<Include> includes_of(const std::string& file);

/// A type that a file defines at the level of a namespace or a class: not a forward declaration, not a specialization.
struct TypeDefinition {
  std::string name;   ///< Without namespaces and classes.
  std::string alias;  ///< What an alias stands for; empty for other types.
};

std::vector<TypeDefinition> types_defined_in(const std::string& file);

}  // namespace isocnc::architecture
