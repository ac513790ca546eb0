#pragma once

#include "interpreter/running/event.h"

namespace isocnc::timing {

/// State of the spindle. An S takes effect with the next M03 or M04 (I.4.2).
struct SpindleMotion {
  int function = 5;  ///< 3, 4 or 5.
  double speed = 0;  ///< Revolutions per minute; 0 while it stands, and before any S.

  friend bool operator==(const SpindleMotion&, const SpindleMotion&) = default;
};

/// The spindle after an M03, M04 or M05 with the last S before it; an S alone waits for the next M03 or M04 (I.4.2).
SpindleMotion spindle_after(int function, double speed);

/// The spindle after any event: a tool change stops it, and most events leave it as it is.
SpindleMotion spindle_after(const running::Event& event, const SpindleMotion& before, double speed);

}  // namespace isocnc::timing
