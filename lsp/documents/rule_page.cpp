#include "lsp/documents/rule_page.h"

#include <filesystem>

#include "analyzer/formats/rendering.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/process.h"
#include "lsp/protocol/uri.h"

namespace isocnc::documents {

namespace fs = std::filesystem;

/// The file of a relative page as a URI; empty if the file is not found.
static std::string find_page(const fs::path& page) {
  std::error_code error;
  const fs::path program = system::program_file();
  if (program.empty()) return {};
  // The places of an installation (beside bin/) and of a build (above build/PRESET/bin).
  const fs::path places[] = {program.parent_path() / "../share/doc/isocnc" / page,
                             program.parent_path() / "../../.." / page};
  for (const fs::path& place : places)
    if (fs::exists(place, error)) return protocol::uri_of(system::weakly_canonical(place, error));
  return {};
}

std::string rule_page(dialect::DiagnosticId id) {
  std::string url = formats::rule_url(id);
  if (url.find("://") != std::string::npos) return url;
  const std::size_t anchor = url.find('#');
  static const std::string kFile = find_page(url.substr(0, anchor));
  return kFile.empty() ? url : kFile + url.substr(anchor);
}

}  // namespace isocnc::documents
