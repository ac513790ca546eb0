#pragma once

#include <optional>
#include <string>

#include "analyzer/fixes/fix.h"
#include "interpreter/execution/executor.h"
#include "interpreter/geometry/arc.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::fixes {

/// An arc of the program whose circle is given by its center, as it is written and as it reads. mm, degrees; places in
/// the plane are in the frame in force, or from the start where they say so.
struct ArcOfProgram {
  const execution::Plane* plane = nullptr;
  geometry::ArcGiven given;
  geometry::PlanePoint start;
  bool incremental = false;
  double mm_per_unit = 1;
  geometry::CenterReadings readings;
  const syntax::Word* center_u = nullptr;  ///< Null: not written. Refers to the line.
  const syntax::Word* center_v = nullptr;

  /// A center, given from the start, as the program has to write its coordinates.
  geometry::PlanePoint in_program(geometry::PlanePoint center) const {
    const geometry::PlanePoint origin = incremental ? geometry::PlanePoint{} : start;
    return {(center.u + origin.u) / mm_per_unit, (center.v + origin.v) / mm_per_unit};
  }
  /// From the start, a center that the program writes so.
  geometry::PlanePoint from_start(geometry::PlanePoint in_program) const {
    const geometry::PlanePoint origin = incremental ? geometry::PlanePoint{} : start;
    return {in_program.u * mm_per_unit - origin.u, in_program.v * mm_per_unit - origin.v};
  }
};

/// Most decimals that a center is written with.
inline constexpr int kMaxDecimals = 9;

/// The line's only arc that gives its circle by a center, run from this state. Nothing where there is none, or several,
/// where its start is not known, where its words have a finding of their own, or where a comment within them would be
/// lost by rewriting them.
std::optional<ArcOfProgram> arc_on(const syntax::LineTree& line, const execution::State& before,
                                   const execution::Setup& setup);

/// Whether a line with I, J or K, run from this state, ends in an arc, or in a motion that nobody can read.
bool may_be_arc(const syntax::LineTree& line, const execution::State& before, const execution::Setup& setup);

/// How a center is rewritten: the edits of its line, and the words that will stand there.
struct WrittenCenter {
  std::vector<Edit> edits;
  std::string words;
};

/// Writes both coordinates of a center, given from the start, with this many decimals.
WrittenCenter center_written(const ArcOfProgram& arc, std::uint64_t line, geometry::PlanePoint center, int decimals);

/// Decimals with which the center is written, three at least.
int decimals_of_center(const syntax::LineTree& line, const ArcOfProgram& arc);

/// The center, given from the start, as it is with its coordinates in the program rounded to so many decimals.
geometry::PlanePoint rounded_center(const ArcOfProgram& arc, geometry::PlanePoint center, int decimals);

}  // namespace isocnc::fixes
