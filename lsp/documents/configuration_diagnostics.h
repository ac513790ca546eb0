#pragma once

#include <filesystem>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/protocol/encoding.h"
#include "lsp/protocol/protocol.h"

namespace isocnc::documents {

using rpc::Json;

/// The findings of isolint on the text of an isocnc.json in this folder, as a list of diagnostics. Reads no file.
Json configuration_diagnostics(std::string_view text, const std::filesystem::path& folder, protocol::Encoding encoding,
                               dialect::Language language);

/// The same for the file on disk; a failure to read it is a diagnostic as well.
Json configuration_diagnostics(const std::filesystem::path& file, protocol::Encoding encoding,
                               dialect::Language language);

}  // namespace isocnc::documents
