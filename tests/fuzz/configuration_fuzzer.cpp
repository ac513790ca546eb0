#include <cstdint>
#include <string>

#include "interpreter/configuration/read.h"
#include "interpreter/configuration/show.h"
#include "require.h"

namespace isocnc::fuzz {

/// What is read can be shown, and read again it is the same.
static void read_twice(std::string_view text) {
  const configuration::ReadConfiguration read = configuration::read_configuration(text, "/shop");
  if (!read.mistakes.empty()) return;
  const std::string shown = configuration::to_json(read.configuration);
  const configuration::ReadConfiguration again = configuration::read_configuration(shown, "/shop");
  require(again.mistakes.empty(), "what is shown is right");
  require(configuration::to_json(again.configuration) == shown, "what is shown says all of it");
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::read_twice(isocnc::fuzz::as_text(data, size));
  return 0;
}
