#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/fixes/fix.h"
#include "lsp/documents/snapshot.h"

namespace isocnc::queries {

using rpc::Json;

/// The edit that turns a line into `text`; it leaves the common start and end unchanged. Nothing if the line is equal
/// to `text` already.
std::optional<protocol::TextEdit> line_edit(const documents::Snapshot& snapshot, std::size_t line,
                                            std::string_view text);

/// The edits in the client's positions, with the line ends of the program.
std::vector<protocol::TextEdit> to_client(const documents::Snapshot& snapshot, const std::vector<fixes::Edit>& edits);

/// The edits that turn the document into `text`. `origins` gives, for each line of `text`, the line of the document
/// that it comes from, in ascending order, or any other number for a new line. Unchanged lines are not touched.
std::vector<protocol::TextEdit> edits_to(const documents::Snapshot& snapshot, std::string_view text,
                                         const std::vector<std::size_t>& origins);

/// The edits as JSON text, written without building a tree: a program may change on every line.
protocol::RawJson written(const std::vector<protocol::TextEdit>& edits);

/// A WorkspaceEdit of this document, with its version if the client supports versions.
Json workspace_edit(const documents::Snapshot& snapshot, const std::vector<protocol::TextEdit>& edits);

}  // namespace isocnc::queries
