#include "analyzer/translation/translator.h"

#include "analyzer/translation/translation_run.h"

namespace isocnc::translation {

Translation translate(std::string_view text, const TranslationSetup& setup) {
  return TranslationRun(text, setup).run();
}

}  // namespace isocnc::translation
