#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/fixes/fix.h"
#include "lsp/documents/snapshot.h"

namespace isocnc::lsp::documents {

/// What has to be replaced in a line so that it reads `text`: all between what both begin and end with. Nothing where
/// it reads so already.
std::optional<TextEdit> line_edit(const Snapshot& snapshot, std::size_t line, std::string_view text);

/// Edits as the client makes them, with the line ends of the program.
std::vector<TextEdit> to_client(const Snapshot& snapshot, const std::vector<fixes::Edit>& edits);

/// The edits that make `text` of the document, where each of its lines has the origin told: the line of the document
/// that it was, ascending, or anything else for a new one. Lines that stay are not touched.
std::vector<TextEdit> edits_to(const Snapshot& snapshot, std::string_view text,
                               const std::vector<std::uint64_t>& origins);

/// The edits as JSON, which is not built as a tree: a program may change on every line.
RawJson written(const std::vector<TextEdit>& edits);

/// A WorkspaceEdit of this document, of this version where the client looks at versions.
Json workspace_edit(const Snapshot& snapshot, const std::vector<TextEdit>& edits);

}  // namespace isocnc::lsp::documents
