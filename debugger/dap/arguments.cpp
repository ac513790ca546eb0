#include "debugger/dap/arguments.h"

namespace isocnc::dap {

static constexpr dialect::Text kMissing{"{} is missing", "manca {}"};
static constexpr dialect::Text kWrongType{"{} is not what it should be", "{} non è del tipo giusto"};

const Json* find_member(const Json& arguments, const char* key) {
  if (!arguments.is_object()) return nullptr;
  const auto found = arguments.find(key);
  return found == arguments.end() || found->is_null() ? nullptr : &*found;
}

void refuse_missing(const char* key) { throw ArgumentError(kMissing, key); }
void refuse_type(const char* key) { throw ArgumentError(kWrongType, key); }

}  // namespace isocnc::dap
