#pragma once

#include <filesystem>
#include <string_view>

#include "interpreter/configuration/scenes.h"
#include "interpreter/dialect/diagnostic.h"
#include "lsp/protocol/encoding.h"
#include "lsp/protocol/protocol.h"

namespace isocnc::documents {

using rpc::Json;

/// The findings of isolint on the text of an isocnc.json, or of the setup of a program, as a list of diagnostics. Reads
/// no file: of meshes it reports what `scenes` has found.
Json configuration_diagnostics(std::string_view text, const std::filesystem::path& file,
                               const configuration::Scenes& scenes, protocol::Encoding encoding,
                               dialect::Language language);

/// The same for the file on disk; a failure to read it is a diagnostic as well.
Json configuration_diagnostics(const std::filesystem::path& file, const configuration::Scenes& scenes,
                               protocol::Encoding encoding, dialect::Language language);

}  // namespace isocnc::documents
