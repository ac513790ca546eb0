#include "debugger/dap/client.h"

#include "debugger/dap/arguments.h"
#include "interpreter/dialect/locale.h"

namespace isocnc::dap {

void from_json(const Json& json, ClientProfile& client) {
  client.lines_start_at_1 = member<bool>(json, "linesStartAt1").value_or(true);
  client.columns_start_at_1 = member<bool>(json, "columnsStartAt1").value_or(true);
  client.supports_invalidated = member<bool>(json, "supportsInvalidatedEvent").value_or(false);
  client.supports_progress = member<bool>(json, "supportsProgressReporting").value_or(false);
  if (const auto locale = member<std::string>(json, "locale")) client.locale = dialect::language_of_locale(*locale);
}

}  // namespace isocnc::dap
