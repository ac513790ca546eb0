#pragma once

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

}  // namespace isocnc::extensions
