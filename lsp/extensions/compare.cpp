#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/comparison/comparison_text.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/overlay/comparison_page.h"
#include "interpreter/plot/path_recording.h"
#include "interpreter/plot/plot_tools.h"
#include "lsp/extensions/extension.h"
#include "lsp/protocol/uri.h"

/// Our own request `isocnc/compare`: what the program does otherwise than another text, as isodiff finds it.
namespace isocnc::extensions {

using comparison::BehaviorChange;
using comparison::ChangedLines;
using comparison::RecordedRun;

namespace {

/// As for isodiff where nothing else is said.
constexpr double kTolerance = comparison::ComparisonOptions{}.tolerance;

struct CompareParams : protocol::DocumentParams {
  std::string text;                ///< Of the old program.
  std::optional<std::string> uri;  ///< Where the old program is; without one it runs on the machine of the document.
  double vgpl = 0;
  bool wants_overlay = false;  ///< What a view takes to show both paths.
};

void from_json(const Json& json, CompareParams& params) {
  from_json(json, static_cast<protocol::DocumentParams&>(params));
  const Json& with = json.at("with");
  params.text = with.at("text");
  params.uri = protocol::member<std::string>(with, "uri");
  params.vgpl = protocol::member<double>(json, "vgpl").value_or(0);
  params.wants_overlay = protocol::member<bool>(json, "overlay").value_or(false);
}

/// A program with the machine that it runs on.
struct ComparedText {
  std::string text;
  running::RunOptions options;
  timing::TimedMachine machine;

  /// Throws rpc::Error, RequestCancelled, once `stop` returns true.
  RecordedRun record(const std::function<bool()>& stop) const {
    running::RunOptions stoppable = options;
    stoppable.stop = stop;
    RecordedRun run = comparison::record(text, stoppable, machine);
    throw_if(stop());
    return run;
  }

  /// The path for a view, in the form of isocnc/toolpath.
  std::string path_json(const plot::PlotSubject& subject, const std::function<bool()>& stop) const;

  static void throw_if(bool is_stopped) {
    if (is_stopped) throw rpc::Error(rpc::ErrorCode::RequestCancelled, "the answer is no longer needed");
  }
};

std::string ComparedText::path_json(const plot::PlotSubject& subject, const std::function<bool()>& stop) const {
  running::RunOptions stoppable = options;
  stoppable.stop = stop;
  const plot::RecordedPath path = plot::record_path(text, subject, stoppable, machine);
  throw_if(stop());
  const auto stream = [](std::string_view bytes) { return fmt::format(R"({{"data":"{}"}})", plot::base64(bytes)); };
  return fmt::format(R"({{"facts":{},"steps":{},"points":{},"turns":{}}})", path.facts, stream(path.steps),
                     stream(path.points), stream(path.turns));
}

/// The data that the background request copies.
struct CompareTask {
  ComparedText old_program;
  ComparedText new_program;
  std::optional<std::filesystem::path> old_file;
  std::int64_t version = 0;
  dialect::Language language = dialect::Language::English;
  bool wants_overlay = false;
  plot::PlotSubject old_subject;

  std::string compute(const std::function<bool()>& stop);
};

/// Whole lines; nothing before the line `start` where the program has no part in the change.
Json range_json(const std::optional<ChangedLines>& lines, std::size_t start) {
  const auto at = [](std::size_t line) { return Json{{"line", line}, {"character", 0}}; };
  return {{"start", at(lines ? lines->first : start)}, {"end", at(lines ? lines->last + 1 : start)}};
}

/// The error at which a run stops; null for none.
Json error_json(const RecordedRun& run) {
  const std::string_view code = comparison::error_of(run);
  return code.empty() ? Json(nullptr) : Json{{"code", code}, {"line", run.actions.back().line}};
}

std::string CompareTask::compute(const std::function<bool()>& stop) {
  if (old_file) {
    configuration::Configurations found({}, language);
    const configuration::MachineConfiguration& machine = found.of(*old_file).machine;
    old_program.options.setup = machine.setup;
    old_program.machine = machine.timed;
    old_subject.home = machine.setup.home;
    old_subject.tools = plot::plot_tools(machine);
  }
  const RecordedRun old_run = old_program.record(stop);
  const RecordedRun new_run = new_program.record(stop);
  const std::vector<BehaviorChange> changes = comparison::compare(old_run, new_run, {.tolerance = kTolerance});
  Json result = Json::parse(comparison::json_of({old_run, new_run, changes}, language));
  for (std::size_t i = 0; i < changes.size(); ++i) {
    result["changes"][i]["oldRange"] = range_json(changes[i].old_lines, changes[i].old_start);
    result["changes"][i]["newRange"] = range_json(changes[i].new_lines, changes[i].new_start);
  }
  result["old"]["error"] = error_json(old_run);
  result["new"]["error"] = error_json(new_run);
  result["version"] = version;
  if (!wants_overlay) return rpc::write(result);
  const std::string old_path = old_program.path_json(old_subject, stop);
  const std::vector<overlay::AlignedLines> lines =
      overlay::aligned_lines({old_program.text, old_run}, {new_program.text, new_run}, kTolerance);
  std::string written = rpc::write(result);
  written.pop_back();
  return fmt::format(R"({},"overlay":{{"old":{},"facts":{},"alignment":"{}"}}}})", written, old_path,
                     overlay::comparison_facts({old_run, new_run, changes}),
                     plot::base64(overlay::alignment_bytes(lines)));
}

BackgroundRequest start_comparison(const Snapshot& snapshot, const CompareParams& params) {
  const running::RunOptions options{.setup = snapshot.setup(), .vgpl = params.vgpl};
  const timing::TimedMachine& machine = snapshot.configuration().machine.timed;
  const auto task = std::make_shared<CompareTask>(
      CompareTask{.old_program = {params.text, options, machine},
                  .new_program = {snapshot.document().text(), options, machine},
                  .old_file = params.uri ? protocol::path_of(*params.uri) : std::nullopt,
                  .version = snapshot.version(),
                  .language = snapshot.language(),
                  .wants_overlay = params.wants_overlay,
                  .old_subject = {.name = {},
                                  .program = {},
                                  .home = snapshot.setup().home,
                                  .tools = plot::plot_tools(snapshot.configuration().machine),
                                  .page = {},
                                  .language = snapshot.language()}});
  return [task](const std::function<bool()>& stop) { return task->compute(stop); };
}

Json compare_capabilities(const Client&) { return {{"experimental", {{"compare", true}}}}; }

}  // namespace

extern const features::Feature compare = {.capabilities = compare_capabilities,
                                          .methods = {in_background<&start_comparison>("isocnc/compare")}};

}  // namespace isocnc::extensions
