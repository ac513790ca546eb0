#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "debugger/requests/request.h"
#include "interpreter/dialect/any_case.h"

namespace isocnc::debugger::requests {

static bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Names of quantities, and codes, for the word before the cursor.
static Json answer_completions(Session& session, const Json& arguments) {
  const std::string typed = text(arguments, "text");
  const std::int64_t column = integer(arguments, "column") - (session.client().columns_start_at_1 ? 1 : 0);
  const std::size_t end =
      std::min<std::size_t>(static_cast<std::size_t>(std::max<std::int64_t>(column, 0)), typed.size());
  std::size_t begin = end;
  while (begin > 0 && is_name_character(typed[begin - 1])) --begin;
  const std::string_view prefix = std::string_view(typed).substr(begin, end - begin);
  Json targets = Json::array();
  const auto offer = [&](const std::string& label, std::string_view detail, const char* type) {
    if (!dialect::begins_with(label, prefix)) return;
    targets.push_back({{"label", label},
                       {"detail", detail},
                       {"type", type},
                       {"start", session.client().to_client_column(begin)},
                       {"length", end - begin}});
  };
  for (const session::Quantity& each : session::all_quantities())
    offer(std::string(each.name), session.in_language(each.meaning), "variable");
  for (const dialect::GCode& code : dialect::kGCodes)
    offer(fmt::format("G{:02}", code.number), session.in_language(code.name), "function");
  for (const dialect::MCode& code : dialect::kMCodes)
    offer(fmt::format("M{:02}", code.number), session.in_language(code.name), "function");
  return {{"targets", targets}};
}

static Json completions_capabilities() { return {{"supportsCompletionsRequest", true}}; }

extern const Request completions = {
    .command = "completions", .answer = answer_completions, .capabilities = completions_capabilities};

}  // namespace isocnc::debugger::requests
