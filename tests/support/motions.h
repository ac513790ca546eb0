#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "interpreter/running/runner.h"

namespace isocnc::support {

/// The effects of a program on the machine, without line numbers; empty if it does not run to its M02.
inline std::string motions_of(std::string_view text, double vgpl) {
  std::string motions;
  const running::RunResult result = running::run(text, {.vgpl = vgpl}, [&](running::Event event) {
    const bool is_about_text = std::holds_alternative<running::JumpEvent>(event.what) ||
                               std::holds_alternative<running::FrameEvent>(event.what);
    event.line = 0;
    if (!is_about_text) motions += running::to_json(event) + "\n";
  });
  return result.ending == running::Ending::ProgramEnd ? motions : std::string();
}

}  // namespace isocnc::support
