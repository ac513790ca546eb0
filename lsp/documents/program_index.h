#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "interpreter/syntax/per_chunk.h"

namespace isocnc::documents {

/// The kinds of places that are looked up in a program.
enum class LandmarkKind : std::uint8_t {
  Jump,            ///< The label after a GOTO; `number` is the label.
  Assignment,      ///< The V of V1=2; `number` is the register, 1 to 30.
  Comparison,      ///< The register in an IF; `number` is the register.
  ToolChange,      ///< M06; `number` is that of its T, or 0 without a T.
  FaceFrame,       ///< G24, G28 or G29; `number` is the number of the G.
  FaceDismounted,  ///< G27.
  WorkpieceFrame,  ///< G92.
  ProgramEnd,      ///< M02.
  Comment,         ///< A comment on a line without instructions; the span includes the comment signs.
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
  std::uint32_t line = 0;  ///< Counted from 0.
  LandmarkKind kind = LandmarkKind::Jump;
  syntax::Span span;
  std::uint64_t number = 0;

  friend bool operator==(const Landmark&, const Landmark&) = default;
};

/// The places of a program's landmarks and labels, also on lines that never run. After an edit only the chunks that it
/// touched are read again.
class ProgramIndex {
 public:
  /// Brings the index up to date. The document must be the same each time, and must outlive the index.
  void update(const syntax::Document& document);

  /// Landmarks of these kinds in the order of the program. Visits all chunks: for a million lines with few landmarks
  /// that takes a fraction of a millisecond.
  std::vector<Landmark> landmarks(LandmarkKinds wanted) const;
  std::vector<Landmark> landmarks(LandmarkKind wanted) const { return landmarks(kinds(wanted)); }
  /// Landmarks with one number: the jumps to a label, or the assignments of a register.
  std::vector<Landmark> landmarks(LandmarkKinds wanted, std::uint64_t number) const;
  /// The lines that have this line number, ascending.
  std::vector<std::size_t> lines_of_label(std::uint64_t label) const;
  /// The highest line number; 0 if there is none.
  std::uint64_t highest_label() const;

 private:
  struct IndexChunk {
    std::uint64_t min_label = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t max_label = 0;
    std::vector<Landmark> landmarks;  // Landmarks, with lines counted from the start of the chunk.
  };

  static IndexChunk read_chunk(const syntax::ChunkTrees& trees);

  template <class IsWanted>
  std::vector<Landmark> select(IsWanted is_wanted) const;

  const syntax::Document* document_ = nullptr;
  syntax::PerChunk<IndexChunk> chunks_;
};

}  // namespace isocnc::documents
