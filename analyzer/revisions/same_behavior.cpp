#include "analyzer/revisions/same_behavior.h"

#include <algorithm>

#include <fmt/format.h>

#include "analyzer/revisions/path_comparison.h"
#include "interpreter/dialect/format.h"

namespace isocnc::revisions {

using dialect::Text;

static constexpr Text kDiffers{"the machine would do otherwise: {}", "la macchina farebbe altro: {}"};
static constexpr Text kStops{"{} stops the program on line {}, and what comes after it is not run",
                             "{} ferma il programma alla riga {}, e ciò che viene dopo non è eseguito"};
static constexpr Text kOtherValues{"its paths under {} have not been compared",
                                   "le sue vie con {} non sono state confrontate"};
static constexpr Text kOtherRegister{"an IF compares V{}, which the program does not set",
                                     "un IF confronta V{}, che il programma non imposta"};

std::optional<std::string> why_not_same(const RevisionPair& pair, const CompareOptions& options,
                                        dialect::Language language) {
  const PathComparison compared = compare_on_paths(pair, options, 0, {.language = language});
  for (const PathComparison::ComparedPaths& paths : compared.paths)
    if (!paths.is_same)
      return dialect::format(kDiffers, language, paths.json["changes"].front()["text"].get<std::string>());
  for (const PathComparison::ComparedPaths& paths : compared.paths)
    if (paths.stop) return dialect::format(kStops, language, paths.stop->code, paths.stop->line + 1);
  if (!compared.not_compared.empty()) return dialect::format(kOtherValues, language, compared.not_compared);
  if (!compared.registers.empty()) return dialect::format(kOtherRegister, language, compared.registers.front());
  return std::nullopt;
}

}  // namespace isocnc::revisions
