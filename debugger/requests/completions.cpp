#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "debugger/requests/request.h"
#include "interpreter/dialect/any_case.h"

namespace isocnc::requests {

namespace {

struct CompletionArguments {
  std::string text;
  std::int64_t column = 0;  ///< Of the cursor, as the client counts.
};

struct CompletionItem {
  std::string label;
  std::string_view detail;
  const char* type = "";
};

struct CompletionsBody {
  std::vector<CompletionItem> items;
  std::int64_t start = 0;  ///< Of the word that they replace, as the client counts.
  std::size_t length = 0;
};

void from_json(const Json& json, CompletionArguments& arguments) {
  arguments.text = required<std::string>(json, "text");
  arguments.column = required<std::int64_t>(json, "column");
}

void to_json(Json& json, const CompletionsBody& body) {
  json = {{"targets", Json::array()}};
  for (const CompletionItem& each : body.items)
    json["targets"].push_back({{"label", each.label},
                               {"detail", each.detail},
                               {"type", each.type},
                               {"start", body.start},
                               {"length", body.length}});
}

}  // namespace

static bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

static std::vector<CompletionItem> all_completions(const Session& session) {
  std::vector<CompletionItem> all;
  for (const expressions::Quantity& each : expressions::all_quantities())
    all.push_back({std::string(each.name), session.in_language(each.meaning), "variable"});
  for (const dialect::GCode& code : dialect::kGCodes)
    all.push_back({fmt::format("G{:02}", code.number), session.in_language(code.name), "function"});
  for (const dialect::MCode& code : dialect::kMCodes)
    all.push_back({fmt::format("M{:02}", code.number), session.in_language(code.name), "function"});
  return all;
}

/// Names of quantities, and codes, for the word before the cursor.
static CompletionsBody answer_completions(Session& session, const CompletionArguments& arguments) {
  const std::string& typed = arguments.text;
  const std::int64_t column = arguments.column - (session.client().columns_start_at_1 ? 1 : 0);
  const std::size_t end =
      std::min<std::size_t>(static_cast<std::size_t>(std::max<std::int64_t>(column, 0)), typed.size());
  std::size_t begin = end;
  while (begin > 0 && is_name_character(typed[begin - 1])) --begin;
  const std::string_view prefix = std::string_view(typed).substr(begin, end - begin);
  std::vector<CompletionItem> items = all_completions(session);
  std::erase_if(items, [&](const CompletionItem& item) { return !dialect::begins_with(item.label, prefix); });
  return {.items = std::move(items), .start = session.client().to_client_column(begin), .length = end - begin};
}

static Json completions_capabilities() { return {{"supportsCompletionsRequest", true}}; }

extern const DebugRequest completions = on<&answer_completions>("completions", completions_capabilities);

}  // namespace isocnc::requests
