#pragma once

#include "interpreter/configuration/configuration.h"
#include "interpreter/sheet/drawing.h"
#include "interpreter/verification/scene.h"

namespace isocnc::sheet {

/// The outline of a tool as it hangs in the spindle: cutter, shank and holder, as far as they are known. `bodies` may
/// be null, and so may `tool`; the drawing is then a cylinder of length and radius, or empty. It fits the given size in
/// mm of paper.
Drawing picture_of_tool(const verification::ToolBodies* bodies, const configuration::Tool* tool, double max_width,
                        double max_height);

}  // namespace isocnc::sheet
