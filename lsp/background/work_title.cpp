#include "lsp/background/work_title.h"

#include "interpreter/dialect/format.h"
#include "lsp/protocol/uri.h"

namespace isocnc::background {

std::string work_title(const dialect::Text& title, const std::string& uri, const protocol::Client& client) {
  const auto path = protocol::path_of(uri);
  return dialect::format(title, client.language({}), path ? path->filename().generic_string() : uri);
}

}  // namespace isocnc::background
