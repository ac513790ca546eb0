#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/translation/source_control.h"
#include "analyzer/translation/translation_finding.h"
#include "analyzer/translation/translation_map.h"

namespace isocnc::translation {

/// What a translation depends on besides the program.
struct TranslationSetup {
  SourceControl control = SourceControl::Fanuc;
  TranslationMap map;
  geometry::Vec3 home = geometry::Vec3::Zero();  ///< Of the machine, for G28 without a reference point in the map; mm.
  double arc_tolerance = 0.01;                   ///< mm.
  std::set<int> named_functions;                 ///< M functions of the shop that keep their number.
  dialect::Language language = dialect::Language::English;  ///< Of the marks in comments.
};

struct Translation {
  std::string program;                        ///< In the dialect; empty if refused.
  std::vector<TranslationFinding> findings;   ///< In the order of the places.
  std::optional<TranslationFinding> refusal;  ///< Why nothing is translated.
};

/// Translates a program of another control. Blocks keep their words where these mean the same; what cannot be said here
/// stays as a comment, with a finding, and no motion is written that would start or end elsewhere than in the original.
Translation translate(std::string_view text, const TranslationSetup& setup);

}  // namespace isocnc::translation
