#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/syntax/tree_store.h"

namespace isocnc::syntax {

/// A place in a document: line and byte column, both from 0. The column may reach into the line's terminator.
struct Position {
  std::size_t line = 0;
  std::size_t column = 0;

  friend auto operator<=>(const Position&, const Position&) = default;
};

/// The effect of an edit on the lines.
struct Change {
  std::size_t first_line = 0;
  std::size_t removed = 0;   ///< Number of old lines that were removed or read again.
  std::size_t inserted = 0;  ///< Number of lines in their place.
};

/// The tree of one line of a document, with all data that the tree refers to except the text, which the document owns.
/// Valid until the document is edited.
class DocumentLine {
 public:
  /// Reads up to a terminator, or `end`.
  DocumentLine(const char* begin, const char* end) {
    store_.append_line(begin, end);
    tree_ = store_.tree(0, begin);
  }
  DocumentLine(DocumentLine&&) noexcept = default;
  DocumentLine& operator=(DocumentLine&&) noexcept = default;
  DocumentLine(const DocumentLine&) = delete;
  DocumentLine& operator=(const DocumentLine&) = delete;
  ~DocumentLine() = default;

  const LineTree* operator->() const { return &tree_; }
  const LineTree& operator*() const& { return tree_; }
  const LineTree& operator*() const&& = delete;  // The words are destroyed with this object.

 private:
  TreeStore store_;
  LineTree tree_;
};

/// A program that is being edited: its text with line ends as written (CR, LF, CRLF), and the tree of each line. A
/// document always has at least one line; a terminator at the end of the text is followed by an empty line, as in an
/// editor.
///
/// Trees are parsed on demand and not stored: they take four to ten times the memory of the text, and fetching them
/// from memory takes longer than parsing the lines again.
class Document {
 public:
  explicit Document(std::string_view text = {});
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

  /// Replaces the text between two positions by `text`. A position beyond the end of a line or of the document counts
  /// as its end; `end` before `begin` counts as `begin`.
  Change replace(Position begin, Position end, std::string_view text);

  std::size_t line_count() const;
  DocumentLine line(std::size_t index) const;
  /// The text of a line without its terminator.
  std::string_view text_of_line(std::size_t index) const;
  std::string text() const;
  /// CR, LF or CRLF; empty after the last line.
  std::string_view terminator(std::size_t line) const;

  /// Lines are stored in chunks; an edit replaces only the chunks that it touches.
  std::size_t chunk_count() const { return chunks_.size(); }
  std::size_t chunk_lines(std::size_t chunk) const;
  std::size_t first_line_of_chunk(std::size_t chunk) const { return chunks_[chunk].first_line; }
  /// The chunk's lines with their terminators.
  std::string_view chunk_text(std::size_t chunk) const;
  /// The chunk that holds a line of the document.
  std::size_t chunk_of_line(std::size_t line) const { return locate(line).chunk; }
  /// A number that changes whenever the lines of the chunk change, and is never used twice.
  std::uint64_t chunk_version(std::size_t chunk) const { return chunks_[chunk].version; }

 private:
  friend class ChunkTrees;

  class Chunk;
  class ChunkMaker;
  /// The fields that every edit reads for all chunks, stored contiguously for speed.
  struct ChunkEntry {
    std::size_t first_line = 0;
    std::uint64_t version = 0;
    std::unique_ptr<Chunk> chunk;
  };
  struct Place {
    std::size_t chunk;
    std::size_t line;  // Within the chunk.
  };

  Place locate(std::size_t line) const;
  Position clamp(Position position) const;
  std::string_view line_with_terminator(std::size_t line) const;
  void rebuild(std::size_t first_line, std::size_t removed, std::string_view text, bool is_end);
  void renumber(std::size_t first, std::size_t count);

  std::vector<ChunkEntry> chunks_;
  std::uint64_t next_version_ = 1;
};

/// Parses the lines of one chunk at a time, for loops over many lines; reuses the memory for the next chunk. The trees
/// are valid until then, or until the document is edited.
class ChunkTrees {
 public:
  void read(const Document& document, std::size_t chunk) { read(document, chunk, document.chunk_lines(chunk)); }
  /// Parses only the first `lines` lines of the chunk.
  void read(const Document& document, std::size_t chunk, std::size_t lines);

  std::size_t size() const { return store_.size(); }
  const TreeStore& store() const { return store_; }
  LineTree operator[](std::size_t index) const;

 private:
  TreeStore store_;
  const Document::Chunk* chunk_ = nullptr;
};

}  // namespace isocnc::syntax
