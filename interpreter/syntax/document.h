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

/// What an edit did to the lines.
struct Change {
  std::size_t first_line = 0;
  std::size_t removed = 0;   ///< Lines that were there before and have been read anew or are gone.
  std::size_t inserted = 0;  ///< Lines that stand in their place.
};

/// The tree of one line of a document, with all that the tree refers to but the text, which stays the document's: valid
/// until that is edited.
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
  const LineTree& operator*() const&& = delete;  // Its words would be gone.

 private:
  TreeStore store_;
  LineTree tree_;
};

/// A program as it is being edited: its text with line ends as they are (CR, LF, CRLF), and the tree of each line. A
/// document always has at least one line; a terminator at the end of the text is followed by an empty line, as in an
/// editor.
///
/// No trees are kept: they take four to ten times as much room as the text, and it takes longer to fetch them from
/// memory than to parse the lines again.
class Document {
 public:
  explicit Document(std::string_view text = {});
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

  /// Replaces what stands between the two places by `text`. Places beyond the end of a line or of the document count as
  /// its end; `end` before `begin` counts as `begin`.
  Change replace(Position begin, Position end, std::string_view text);

  std::size_t line_count() const;
  DocumentLine line(std::size_t index) const;
  /// Without its terminator.
  std::string_view text_of_line(std::size_t index) const;
  std::string text() const;
  /// CR, LF or CRLF; nothing behind the last line.
  std::string_view terminator(std::size_t line) const;

  /// Lines are kept in chunks; an edit leaves the others as they are.
  std::size_t chunk_count() const { return chunks_.size(); }
  std::size_t chunk_lines(std::size_t chunk) const;
  std::size_t first_line_of_chunk(std::size_t chunk) const { return chunks_[chunk].first_line; }
  /// The chunk's lines with their terminators.
  std::string_view chunk_text(std::size_t chunk) const;
  /// The chunk that holds a line of the document.
  std::size_t chunk_of_line(std::size_t line) const { return locate(line).chunk; }
  /// Another number whenever the lines of the chunk are others; never used twice.
  std::uint64_t chunk_version(std::size_t chunk) const { return chunks_[chunk].version; }

 private:
  struct Chunk;
  class ChunkMaker;
  /// What is asked of all chunks after each edit lies side by side.
  struct Slot {
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

  std::vector<Slot> chunks_;
  std::uint64_t next_version_ = 1;
};

/// The trees of a chunk's lines, for who goes through many lines: the room for them is used again for the next chunk.
/// Valid until then, or until the document is edited.
class ChunkTrees {
 public:
  void read(const Document& document, std::size_t chunk) { read(document, chunk, document.chunk_lines(chunk)); }
  /// The first lines only.
  void read(const Document& document, std::size_t chunk, std::size_t lines);

  std::size_t size() const { return texts_.size(); }
  const TreeStore& store() const { return store_; }
  LineTree operator[](std::size_t index) const { return store_.tree(index, texts_[index]); }

 private:
  TreeStore store_;
  std::vector<const char*> texts_;
};

}  // namespace isocnc::syntax
