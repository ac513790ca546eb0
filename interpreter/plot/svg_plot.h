#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>

#include "interpreter/plot/picture.h"

namespace isocnc::plot {

/// The path from above and in isometric view, machine coordinates, mm, as an SVG document. Rapids are dashed, arcs
/// drawn thicker than lines, strokes along the view are dots, and each tool has a color that people see who tell red
/// from green badly.
class SvgPlot final : public Picture {
 public:
  /// `subject` must outlive it.
  explicit SvgPlot(const PlotSubject& subject);

  void add(const ToolpathStep& step) override;
  void write(system::OutputFile& output, const Toolpath& path, const running::RunResult& result) override;

 private:
  struct Point {
    double x = 0;
    double y = 0;
  };
  /// What is drawn alike; in the order of drawing.
  using Style = std::pair<StepKind, std::size_t>;  ///< With its tool.

  /// What one view shows; y grows downwards.
  struct View {
    Point (*project)(const geometry::Vec3& point);
    Point minimum;
    Point maximum;
    bool is_empty = true;
    std::map<Style, std::string> paths;       ///< `d` of the paths.
    std::map<std::size_t, std::string> dots;  ///< By tool: feed moves that are seen as a point.
    Style last{};                             ///< Whose path the pen is on.
    Point pen;

    void include(const Point& point);
    void draw(const Style& style, const geometry::Vec3& from, const geometry::Vec3& to);
    double scale() const;
  };

  static std::string drawn(const View& view, const Toolpath& path, double left);
  static std::string frames_drawn(const View& view, const Toolpath& path);
  std::string legend(const Toolpath& path) const;

  const PlotSubject& subject_;
  std::array<View, 2> views_;
};

}  // namespace isocnc::plot
