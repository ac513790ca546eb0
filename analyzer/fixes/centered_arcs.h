#pragma once

#include <optional>
#include <string>

#include "analyzer/fixes/fix.h"
#include "interpreter/execution/plane.h"
#include "interpreter/geometry/arc.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::fixes {

/// An arc of the program whose circle is given by its center, as written and as interpreted. mm, degrees; points in the
/// plane are in the frame in force, unless described as relative to the start.
struct ArcOfProgram {
  const execution::Plane* plane = nullptr;
  geometry::ArcGiven given;
  geometry::PlanePoint start;
  bool incremental = false;
  double mm_per_unit = 1;
  geometry::CenterReadings readings;
  const syntax::Word* center_u = nullptr;  ///< A word of the line; null if not written.
  const syntax::Word* center_v = nullptr;

  /// Converts a center relative to the start into the coordinates that the program must write.
  geometry::PlanePoint in_program(geometry::PlanePoint center) const {
    const geometry::PlanePoint origin = incremental ? geometry::PlanePoint{} : start;
    return {(center.u + origin.u) / mm_per_unit, (center.v + origin.v) / mm_per_unit};
  }
  /// Converts a center as the program writes it into one relative to the start.
  geometry::PlanePoint from_start(geometry::PlanePoint in_program) const {
    const geometry::PlanePoint origin = incremental ? geometry::PlanePoint{} : start;
    return {in_program.u * mm_per_unit - origin.u, in_program.v * mm_per_unit - origin.v};
  }
};

/// The line's only arc whose circle is given by a center, executed from this state. Nothing if there is none or
/// several, if its start is unknown, if one of its words has a finding, or if rewriting would lose a comment between
/// them.
std::optional<ArcOfProgram> arc_on(const syntax::LineTree& line, const execution::State& before,
                                   const execution::Setup& setup);

/// Whether a line with I, J or K, executed from this state, leaves an arc in force, or a motion that is not known.
bool may_be_arc(const syntax::LineTree& line, const execution::State& before, const execution::Setup& setup);

/// The rewriting of a center: the edits of its line, and the new words.
struct WrittenCenter {
  std::vector<Edit> edits;
  std::string words;
};

/// Writes both coordinates of a center, given relative to the start, with this many decimals.
WrittenCenter center_written(const ArcOfProgram& arc, std::size_t line, geometry::PlanePoint center, int decimals);

/// The number of decimals of the written center, at least three.
int decimals_of_center(const syntax::LineTree& line, const ArcOfProgram& arc);

/// The center, given relative to the start, after rounding its coordinates in the program to `decimals` decimals.
geometry::PlanePoint rounded_center(const ArcOfProgram& arc, geometry::PlanePoint center, int decimals);

}  // namespace isocnc::fixes
