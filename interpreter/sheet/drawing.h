#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isocnc::sheet {

/// A place on paper: mm from the top left corner of the drawing, to the right and down.
struct PaperPoint {
  double x = 0;
  double y = 0;

  friend bool operator==(const PaperPoint&, const PaperPoint&) = default;
};

struct PenStroke {
  std::uint32_t color = 0;                 ///< 0xRRGGBB
  double width = 0.2;                      ///< mm; 0: no line around what is filled.
  std::optional<std::uint32_t> fill = {};  ///< Of a closed row of points.
  std::vector<double> dashes = {};  ///< Their lengths, and those of the gaps after them, mm; empty: a whole line.
};

struct DrawnLine {
  PenStroke stroke;
  std::vector<PaperPoint> points;  ///< One alone is a dot.
};

struct DrawnText {
  PaperPoint at;  ///< The left end of its base line.
  std::string text;
};

/// A drawing on paper, in the order in which it is drawn.
struct Drawing {
  double width = 0;  ///< mm
  double height = 0;
  std::vector<DrawnLine> lines;
  std::vector<DrawnText> texts;
};

}  // namespace isocnc::sheet
