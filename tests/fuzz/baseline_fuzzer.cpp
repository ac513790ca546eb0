#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <variant>

#include <unistd.h>

#include "analyzer/selection/baseline.h"
#include "require.h"

namespace isocnc::fuzz {

using selection::Baseline;

/// A file of this process, removed at its end.
static const std::filesystem::path& file() {
  static const std::filesystem::path kFile =
      std::filesystem::temp_directory_path() / ("isocnc-baseline-" + std::to_string(::getpid()) + ".json");
  [[maybe_unused]] static const int kRemoved = std::atexit([] { std::filesystem::remove(kFile); });
  return kFile;
}

static std::variant<Baseline, std::string> read(std::string_view text) {
  std::ofstream(file(), std::ios::binary) << text;
  return Baseline::read(file(), dialect::Language::English);
}

static void check_baseline(std::string_view text) {
  const auto first = read(text);
  if (const auto* const problem = std::get_if<std::string>(&first))
    return require(problem->starts_with(file().string()), "what is wrong names the file");
  const auto& baseline = std::get<Baseline>(first);
  const auto again = read(baseline.to_json());
  require(std::holds_alternative<Baseline>(again), "what is written can be read");
  require(std::get<Baseline>(again).to_json() == baseline.to_json(), "and says the same");
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::check_baseline(isocnc::fuzz::as_text(data, size));
  return 0;
}
