#pragma once

#include <filesystem>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/documents/encoding.h"
#include "lsp/documents/protocol.h"

namespace isocnc::lsp::documents {

/// What is wrong with the text of an isocnc.json in this folder, as isolint would tell it: a list of diagnostics. Reads
/// no file.
Json configuration_diagnostics(std::string_view text, const std::filesystem::path& folder, Encoding encoding,
                               dialect::Language language);

/// The same for the file as it stands on disk; what keeps it from being read is a mistake, too.
Json configuration_diagnostics(const std::filesystem::path& file, Encoding encoding, dialect::Language language);

}  // namespace isocnc::lsp::documents
