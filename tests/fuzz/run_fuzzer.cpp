#include <algorithm>
#include <cstdint>
#include <string>

#include "interpreter/running/restart.h"
#include "interpreter/running/runner.h"
#include "require.h"

namespace isocnc::fuzz {

/// Lines end at CR, LF or CRLF; a run may end behind the last.
static std::uint64_t most_lines(std::string_view text) {
  return 1 + static_cast<std::uint64_t>(
                 std::count_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }));
}

static void run_program(std::string_view text, bool stop_at_errors) {
  running::RunOptions options;
  options.vgpl = 1;
  options.stop_at_errors = stop_at_errors;
  std::uint64_t line = 0;
  const auto result = running::run(text, options, [&](const running::Event& event) {
    require(event.line >= line, "a run goes forward");
    line = event.line;
    require(!running::to_json(event).empty(), "events can be written");
  });
  require(result.line <= most_lines(text), "a run ends within the text");
  require(result.blocks <= most_lines(text), "no block runs twice");
  require(stop_at_errors || result.ending != running::Ending::Until, "nothing but `until` ends a run there");
}

static void restart_program(std::string_view text) {
  running::RestartOptions options;
  options.line = text.size() % most_lines(text);
  const auto made = running::restart_program(text, options);
  if (const auto* const program = std::get_if<std::string>(&made)) {
    const auto result = running::run(*program, options.run, [](const running::Event&) {});
    require(result.ending == running::Ending::ProgramEnd, "a restart program ends");
    require(text.empty() || program->back() == text.back(), "and as the text does");
    return;
  }
  const auto& refusal = std::get<running::RestartRefusal>(made);
  require(!running::message(refusal, dialect::Language::Italian).empty(), "a refusal has its reason");
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = isocnc::fuzz::as_text(data, size);
  isocnc::fuzz::run_program(text, true);
  isocnc::fuzz::run_program(text, false);
  isocnc::fuzz::restart_program(text);
  return 0;
}
