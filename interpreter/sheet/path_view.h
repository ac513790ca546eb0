#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "interpreter/geometry/range.h"
#include "interpreter/plot/toolpath.h"
#include "interpreter/sheet/drawing.h"

namespace isocnc::sheet {

/// How feed moves of a tool are drawn, by its place in the order of first use, from 0: no two tools alike. Twelve have
/// whole lines of a color each, the next ones dashed lines of these colors.
PenStroke stroke_of_tool(std::size_t place);

/// Of what is dashed without telling tools apart.
std::vector<double> fine_dashes();

/// A view of a path along an axis of the machine, drawn to scale within a width and a height. What falls on the same
/// tenths of a millimeter of paper is drawn once, and a drawing that is still too full becomes coarser, so that it is
/// small and whole however long the program is.
class PathView {
 public:
  struct Axes {
    int right = 0;  ///< X
    int up = 1;
  };

  /// `room`: what is to be seen, machine frame, mm.
  PathView(const Axes& axes, const std::array<geometry::Range, 3>& room, double max_width, double max_height);

  /// A body as a rectangle.
  void add_box(const std::array<geometry::Range, 3>& room, const PenStroke& stroke);
  void add(const plot::ToolpathStep& step);
  /// The axes of a frame, and its name.
  void add_origin(const geometry::Vec3& origin, std::string name);

  Drawing finish();

 private:
  using PaperCell = std::pair<std::int32_t, std::int32_t>;  ///< Column and row.
  /// A line from cell to cell.
  struct PaperSegment {
    std::size_t style = 0;  ///< 0: rapids; else one more than the place of the tool in Toolpath::tools().
    PaperCell from;
    PaperCell to;
  };

  PaperPoint on_paper(const geometry::Vec3& place) const;
  PaperCell cell_of(const PaperPoint& point) const;
  PaperPoint point_of(const PaperCell& cell) const;
  /// The part of a line that lies in the drawing; none if it lies outside.
  std::optional<std::pair<PaperPoint, PaperPoint>> clipped(const PaperPoint& from, const PaperPoint& to) const;
  void add_segment(const PaperSegment& segment);
  void coarsen();

  Axes axes_;
  std::array<geometry::Range, 3> room_;
  double scale_ = 1;  ///< mm of paper for a mm.
  Drawing drawing_;
  Drawing origins_;
  double cell_;                         ///< mm of paper.
  std::vector<PaperSegment> segments_;  ///< Each once.
  std::unordered_set<std::uint64_t> drawn_;
  std::set<std::pair<std::size_t, PaperCell>> dots_;  ///< By style.
};

}  // namespace isocnc::sheet
