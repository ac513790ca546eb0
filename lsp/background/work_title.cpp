#include "lsp/background/work_title.h"

#include "interpreter/dialect/format.h"
#include "lsp/protocol/uri.h"

namespace isocnc::background {

std::string work_title(const dialect::Text& title, const std::string& uri, const protocol::Client& client) {
  return dialect::format(title, client.language({}), protocol::name_in(uri));
}

}  // namespace isocnc::background
