#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "interpreter/syntax/per_chunk.h"

namespace isocnc::lsp::documents {

/// What one would look for in a program.
enum class LandmarkKind : std::uint8_t {
  Jump,            ///< The label behind a GOTO; `number` is the label.
  Assignment,      ///< The V of V1=2; `number` is the register, 1 to 30.
  Comparison,      ///< The register in an IF; `number` is the register.
  ToolChange,      ///< M06; `number` is that of its T, 0 without one.
  FaceFrame,       ///< G24, G28 or G29; `number` is the G's.
  FaceDismounted,  ///< G27.
  WorkpieceFrame,  ///< G92.
  ProgramEnd,      ///< M02.
  Comment,         ///< A comment on a line without instructions; the span holds its signs.
};

using LandmarkKinds = std::uint16_t;
constexpr LandmarkKinds kinds(LandmarkKind kind) {
  return static_cast<LandmarkKinds>(1u << static_cast<unsigned>(kind));
}
constexpr LandmarkKinds operator|(LandmarkKind a, LandmarkKind b) {
  return static_cast<LandmarkKinds>(kinds(a) | kinds(b));
}
constexpr LandmarkKinds operator|(LandmarkKinds a, LandmarkKind b) { return static_cast<LandmarkKinds>(a | kinds(b)); }

struct Landmark {
  std::uint32_t line = 0;  ///< From 0.
  LandmarkKind kind = LandmarkKind::Jump;
  syntax::Span span;
  std::uint64_t number = 0;

  friend bool operator==(const Landmark&, const Landmark&) = default;
};

/// Where a program's landmarks and labels stand, whether the lines run or not. After an edit only the chunks that it
/// touched are read again.
class ProgramIndex {
 public:
  /// Brings the index up to date. It must be the same document each time, which outlives the index.
  void update(const syntax::Document& document);

  /// Landmarks of these kinds in the order of the program. A walk over all chunks: a fraction of a millisecond for a
  /// million lines where landmarks are rare.
  std::vector<Landmark> landmarks(LandmarkKinds wanted) const;
  std::vector<Landmark> landmarks(LandmarkKind wanted) const { return landmarks(kinds(wanted)); }
  /// Landmarks of one number: the jumps to a label, the assignments of a register.
  std::vector<Landmark> landmarks(LandmarkKinds wanted, std::uint64_t number) const;
  /// The lines that have this line number, ascending.
  std::vector<std::size_t> lines_of_label(std::uint64_t label) const;
  /// The highest line number, 0 without any.
  std::uint64_t highest_label() const;

 private:
  struct Chunk {
    std::uint64_t min_label = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t max_label = 0;
    std::vector<Landmark> landmarks;  // Lines counted from the chunk's start.
  };

  static Chunk read_chunk(const syntax::ChunkTrees& trees);

  template <class IsWanted>
  std::vector<Landmark> select(IsWanted is_wanted) const;

  const syntax::Document* document_ = nullptr;
  syntax::PerChunk<Chunk> chunks_;
};

}  // namespace isocnc::lsp::documents
