#include "debugger/dap/protocol.h"

#include <algorithm>

namespace isocnc::dap {

PageArguments::PageRange PageArguments::of(std::size_t size) const {
  const auto all = static_cast<std::int64_t>(size);
  const std::int64_t begin = std::clamp<std::int64_t>(start, 0, all);
  const std::int64_t end = count > 0 && count < all - begin ? begin + count : all;
  return {static_cast<std::size_t>(begin), static_cast<std::size_t>(end)};
}

void from_json(const Json& json, SourceArguments& arguments) {
  const Json* const source = find_member(json, "source");
  if (source != nullptr) arguments.path = member<std::string>(*source, "path").value_or("");
}

void from_json(const Json& json, FormatArguments& arguments) {
  const Json* const format = find_member(json, "format");
  if (format != nullptr) arguments.is_hexadecimal = member<bool>(*format, "hex").value_or(false);
}

void from_json(const Json& json, StepArguments& arguments) {
  arguments.step = member<std::string>(json, "granularity") == "instruction" ? Step::Instruction : Step::Block;
}

void from_json(const Json& json, RuleArguments& arguments) {
  arguments = {.condition = member<std::string>(json, "condition"),
               .hit_condition = member<std::string>(json, "hitCondition"),
               .log_message = member<std::string>(json, "logMessage")};
}

void to_json(Json& json, const BreakpointBody& breakpoint) {
  json = {{"verified", breakpoint.is_verified}};
  if (breakpoint.id) json["id"] = *breakpoint.id;
  if (!breakpoint.message.empty()) json["message"] = breakpoint.message;
  if (breakpoint.line) json["line"] = *breakpoint.line;
  if (breakpoint.source) json["source"] = *breakpoint.source;
}

void to_json(Json& json, const BreakpointsBody& body) { json = {{"breakpoints", body.breakpoints}}; }

void to_json(Json& json, const ValueBody& body) { json = {{"value", body.value}}; }

}  // namespace isocnc::dap
