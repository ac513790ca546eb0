#pragma once

#include <string>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/protocol/client.h"

namespace isocnc::background {

/// The title of long work on a document for the user: `title` with the file's name in its place `{}`.
std::string work_title(const dialect::Text& title, const std::string& uri, const protocol::Client& client);

}  // namespace isocnc::background
