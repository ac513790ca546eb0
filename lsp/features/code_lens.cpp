#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "interpreter/dialect/format.h"
#include "lsp/features/feature.h"
#include "lsp/queries/section_times.h"

/// Code lenses above each tool section: its duration and path length, the volume that it removes from the blank, and,
/// in editors that support it, commands to run or debug the program from there.
namespace isocnc::features {

using dialect::Text;
using documents::LandmarkKind;

namespace {

/// `removed`: by the last verification, mm^3.
std::string describe(const queries::TimedSection& section, const std::optional<double>& removed,
                     dialect::Language language) {
  static constexpr Text kTimeAndPath = {"{}, path {:.1f} m", "{}, percorso {:.1f} m"};
  static constexpr Text kRemoves = {", removes {:.1f} cm3", ", asporta {:.1f} cm3"};
  std::string title = dialect::format(kTimeAndPath, language, queries::clock_text(section.seconds), section.mm / 1000);
  if (removed) title += dialect::format(kRemoves, language, *removed / 1000);
  return title;
}

/// The volume that the lines from a tool change to the next one remove, if a verification of the present text knows it.
std::optional<double> removed_from(const Snapshot& snapshot, std::size_t line) {
  std::size_t end = std::numeric_limits<std::size_t>::max();
  for (const documents::Landmark& change : snapshot.index().landmarks(LandmarkKind::ToolChange))
    if (change.line > line) end = std::min<std::size_t>(end, change.line);
  return snapshot.removed_between(line, end);
}

/// Whether the editor knows a command of this name: it lists its commands in `experimental.commands.commands`.
bool knows(const Client& client, const char* command) {
  const Json known = client.capabilities.value(Json::json_pointer("/experimental/commands/commands"), Json::array());
  return std::find(known.begin(), known.end(), Json(command)) != known.end();
}

struct LensResolveParams {
  Json lens;
};

void from_json(const Json& json, LensResolveParams& params) { params.lens = json; }

struct Offered {
  const char* command;
  Text title;
};

constexpr Offered kCommands[] = {{"isocnc.run", {"run", "eseguire"}},
                                 {"isocnc.debug", {"debug from here", "debug da qui"}}};

Json answer_code_lens(const Snapshot& snapshot, const protocol::DocumentParams&) {
  Json lenses = Json::array();
  for (const documents::Landmark& change : snapshot.index().landmarks(LandmarkKind::ToolChange)) {
    const ClientRange range = snapshot.to_client(change.line, change.span);
    lenses.push_back({{"range", range},
                      {"data", {{"uri", snapshot.uri()}, {"version", snapshot.version()}, {"line", change.line}}}});
    for (const Offered& each : kCommands) {
      if (!knows(snapshot.client(), each.command)) continue;
      const Json place = {{"uri", snapshot.uri()}, {"line", change.line}};
      lenses.push_back({{"range", range},
                        {"command",
                         {{"title", each.title.in(snapshot.language())},
                          {"command", each.command},
                          {"arguments", Json::array({place})}}}});
    }
  }
  return lenses;
}

BackgroundRequest resolve_lens(const Snapshot& snapshot, const LensResolveParams& params) {
  const Json& data = params.lens.at("data");
  if (data.at("version") != snapshot.version()) throw documents::edited();
  const auto times = queries::SectionTimes::of(snapshot);
  const auto known = times->known(snapshot);
  const auto program = known ? nullptr : std::make_shared<queries::TimedProgram>(snapshot, 0);
  const auto line = data.at("line").get<std::size_t>();
  return [times, known, program, lens = params.lens, line, removed = removed_from(snapshot, line),
          language = snapshot.language()](const std::function<bool()>& stop) mutable {
    static constexpr Text kNotRun = {"not run", "non eseguita"};
    const auto sections = known ? known : times->time(*program, stop);
    const auto section = sections->find(line);
    const std::string title =
        section == sections->end() ? std::string(kNotRun.in(language)) : describe(section->second, removed, language);
    lens["command"] = {{"title", title}, {"command", ""}};
    return rpc::write(lens);
  };
}

/// Whether lenses that have been shown may lack a volume.
bool knows_volumes(const Snapshot& snapshot, const Notify&) {
  return !snapshot.index().landmarks(LandmarkKind::ToolChange).empty() && snapshot.removed_between(0, 1).has_value();
}

Json code_lens_capabilities(const Client&) { return {{"codeLensProvider", {{"resolveProvider", true}}}}; }

}  // namespace

extern const Feature code_lens = {
    .capabilities = code_lens_capabilities,
    .methods = {on<&answer_code_lens>("textDocument/codeLens"), in_background<&resolve_lens>("codeLens/resolve")},
    .verified = knows_volumes,
    .refresh = Refresh{"workspace/codeLens/refresh", "/workspace/codeLens/refreshSupport"}};

}  // namespace isocnc::features
