#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lsp/features/feature.h"

/// Inline values, shown beside the lines while a program is debugged: the registers and VGPL in each line, whose values
/// the debugger supplies.
namespace isocnc::features {
namespace {

struct InlineVariable {
  ClientRange range;
  std::string name;
};

void to_json(Json& json, const InlineVariable& variable) {
  json = {{"range", variable.range}, {"variableName", variable.name}, {"caseSensitiveLookup", false}};
}

struct InlineValueParams : protocol::RangeParams {
  std::size_t stopped_line = 0;
};

void from_json(const Json& json, InlineValueParams& params) {
  from_json(json, static_cast<protocol::RangeParams&>(params));
  params.stopped_line = json.at("context").at("stoppedLocation").get<ClientRange>().end.line;
}

std::vector<InlineVariable> answer_inline_values(const Snapshot& snapshot, const InlineValueParams& params) {
  std::vector<InlineVariable> variables;
  const std::size_t first = snapshot.from_client(params.range.start).line;
  const std::size_t last = std::min(snapshot.from_client(params.range.end).line, params.stopped_line);
  for (std::size_t number = first; number <= last; ++number) {
    if (number % 1024 == 0) snapshot.throw_if_unwanted();
    const syntax::DocumentLine read = snapshot.document().line(number);
    const syntax::LineTree& line = *read;
    std::set<std::string> seen;  // Each name is shown once per line.
    for (const syntax::Word& word : line.words) {
      const bool is_register = word.letter == 'V' && word.is_plain_integer();
      if (!is_register && word.letter != syntax::kVgpl) continue;
      const std::string name = is_register ? fmt::format("V{}", word.value) : "VGPL";
      if (seen.insert(name).second) variables.push_back({snapshot.to_client(number, word.span()), name});
    }
  }
  return variables;
}

Json inline_values_capabilities(const Client&) { return {{"inlineValueProvider", true}}; }

}  // namespace

extern const Feature inline_values = {.capabilities = inline_values_capabilities,
                                      .methods = {on<&answer_inline_values>("textDocument/inlineValue")}};

}  // namespace isocnc::features
