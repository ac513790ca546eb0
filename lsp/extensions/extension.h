#pragma once

#include <cstdint>
#include <optional>

#include "lsp/features/feature.h"

namespace isocnc::extensions {

// An extension is a feature: a request of ours that the protocol does not have. Each has a file in this folder, which
// defines it under the file's name; the build lists them (lsp/feature_list.h).
using features::ActionParams;
using features::BackgroundRequest;
using features::Client;
using features::ClientPosition;
using features::ClientRange;
using features::Feature;
using features::in_background;
using features::Json;
using features::on;
using features::on_any;
using features::Snapshot;
using features::TextContent;

/// The parameters of a text about a program.
struct TextParams {
  std::optional<std::uint32_t> line;  ///< From 0; without it, the text is about the whole program.
};

inline void from_json(const Json& json, TextParams& params) {
  params.line = protocol::member<std::uint32_t>(json, "line");
}

}  // namespace isocnc::extensions
