#include "lsp/feature_list.h"

namespace isocnc {

#define ISOCNC_FEATURE(name) extern const features::Feature name;
#define ISOCNC_EXTENSION(name) ISOCNC_FEATURE(name)
namespace features {
#include <features.inc>
}
namespace extensions {
#include <extensions.inc>
}
#undef ISOCNC_FEATURE

namespace lsp {

extern const features::Feature code_actions;

static const features::Feature* const kFeatures[] = {
#define ISOCNC_FEATURE(name) &features::name,
#include <features.inc>
#undef ISOCNC_FEATURE
#undef ISOCNC_EXTENSION
#define ISOCNC_EXTENSION(name) &extensions::name,
#include <extensions.inc>
#undef ISOCNC_EXTENSION
    &code_actions,
};

std::span<const features::Feature* const> all_features() { return kFeatures; }

}  // namespace lsp

}  // namespace isocnc
