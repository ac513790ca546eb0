#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/rpc/json.h"

namespace isocnc::dap {

using rpc::Json;

/// The editor at the other end, as `initialize` describes it.
struct ClientProfile {
  bool lines_start_at_1 = true;
  bool columns_start_at_1 = true;
  bool supports_invalidated = false;
  bool supports_progress = false;
  std::optional<dialect::Language> locale;

  std::int64_t to_client_line(std::size_t line) const {
    return static_cast<std::int64_t>(line) + (lines_start_at_1 ? 1 : 0);
  }
  std::int64_t to_client_column(std::size_t column) const {
    return static_cast<std::int64_t>(column) + (columns_start_at_1 ? 1 : 0);
  }
  /// From 0; none for a line that cannot be.
  std::optional<std::size_t> from_client_line(std::int64_t line) const {
    const std::int64_t from_zero = line - (lines_start_at_1 ? 1 : 0);
    if (line < 0 || from_zero < 0) return std::nullopt;
    return static_cast<std::size_t>(from_zero);
  }
};

/// Of the arguments of `initialize`. Throws ArgumentError.
void from_json(const Json& json, ClientProfile& client);

}  // namespace isocnc::dap
