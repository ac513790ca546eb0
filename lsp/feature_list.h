#pragma once

#include <span>

#include "lsp/features/feature.h"

namespace isocnc::lsp {

/// All that the server can do: the features of the protocol, our own requests, and the code actions that these offer.
std::span<const features::Feature* const> all_features();

}  // namespace isocnc::lsp
