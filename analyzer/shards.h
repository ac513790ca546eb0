#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "analyzer/command_line.h"
#include "interpreter/system/exit_status.h"

namespace isocnc::analyzer {

/// One of several parts of the files that are found, so that as many machines can check them.
struct Shard {
  std::uint64_t index = 0;  ///< From 0.
  std::uint64_t count = 1;

  /// Reads `2/8`, the second of eight; nothing if it is not written so.
  static std::optional<Shard> read(std::string_view text);

  /// Whether the file belongs to the part. Its path below the current directory decides, written with `/`, so that all
  /// machines agree, whatever the folder in which they have the files.
  bool holds(const std::filesystem::path& file) const;
};

/// `isolint --merge FILE...`: writes the report that the files, reports of shards, make together.
system::ExitStatus merge_shards(const LintCommandOptions& options);

}  // namespace isocnc::analyzer
