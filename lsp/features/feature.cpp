#include "lsp/features/feature.h"

namespace isocnc::lsp::features {

#define ISOCNC_FEATURE(name) extern const Feature name;
#include <features.inc>
#undef ISOCNC_FEATURE

static const Feature* const kFeatures[] = {
#define ISOCNC_FEATURE(name) &(name),
#include <features.inc>
#undef ISOCNC_FEATURE
};

std::span<const Feature* const> all_features() { return kFeatures; }

}  // namespace isocnc::lsp::features
