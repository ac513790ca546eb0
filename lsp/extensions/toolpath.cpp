#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "interpreter/plot/path_recording.h"
#include "interpreter/plot/plot_tools.h"
#include "lsp/extensions/extension.h"
#include "lsp/protocol/uri.h"
#include "lsp/queries/timed_program.h"

/// Our own request `isocnc/toolpath`: the path of the tool tip through the whole program, and after an edit its
/// changes. Steps and points are encoded as differences from the ones before, so that an edit changes few bytes.
namespace isocnc::extensions {
namespace {

/// A recording that has been sent to the client.
struct SentPath {
  std::int64_t id = 0;
  std::string steps;
  std::string points;
  std::string turns;
  std::string cuts;  ///< Empty where no stock is cut.
};

/// A picture that follows each edit shows a blank by so many dexels.
constexpr double kMaxDexels = 250'000;

/// The last recording sent, shared by the background requests.
struct LastSent {
  std::mutex mutex;
  std::int64_t last_id = 0;
  std::shared_ptr<const SentPath> path;
};

struct ToolpathParams : protocol::DocumentParams {
  std::string previous;  ///< The resultId of the recording that the client has; empty if none.
  double vgpl = 0;
};

void from_json(const Json& json, ToolpathParams& params) {
  from_json(json, static_cast<protocol::DocumentParams&>(params));
  params.previous = protocol::member<std::string>(json, "previousResultId").value_or("");
  params.vgpl = protocol::member<double>(json, "vgpl").value_or(0);
}

/// A stream as JSON: the data, or its difference from the stream that the client has.
std::string stream(std::string_view now, const std::string* before) {
  if (!before) return fmt::format(R"({{"data":"{}"}})", plot::base64(now));
  const auto head = static_cast<std::size_t>(
      std::mismatch(now.begin(), now.end(), before->begin(), before->end()).first - now.begin());
  const std::size_t max_tail = std::min(now.size(), before->size()) - head;
  const auto tail = static_cast<std::size_t>(
      std::mismatch(now.rbegin(), now.rbegin() + static_cast<std::ptrdiff_t>(max_tail), before->rbegin()).first -
      now.rbegin());
  return fmt::format(R"({{"start":{},"removed":{},"data":"{}"}})", head, before->size() - head - tail,
                     plot::base64(now.substr(head, now.size() - head - tail)));
}

/// The data that the background request copies.
struct ToolpathTask {
  queries::TimedProgram program;
  plot::PlotSubject subject;
  std::string previous;
  std::shared_ptr<LastSent> last;

  std::string compute(const std::function<bool()>& stop);
};

std::string ToolpathTask::compute(const std::function<bool()>& stop) {
  const timing::TimedMachine& machine = program.machine().timed;
  std::optional<verification::Verifier> verifier;
  std::optional<plot::StockRecording> cuts;
  subject.scene = program.scene();
  if (subject.scene) {
    subject.origin = program.workpiece_origin();
    verifier.emplace(*subject.scene, machine, subject.origin, verification::WorkTogether(),
                     verification::MaterialOptions{.max_dexels = kMaxDexels});
    if (verifier->material()) plot::record(*verifier->material(), cuts);
  }
  plot::PathRecording recording(subject, machine);
  plot::Toolpath path(machine, subject.home, [&](const plot::ToolpathStep& step) { recording.add(step); });
  const running::RunResult result =
      program.run(stop, {.event =
                             [&](const timing::TimedEvent& timed) {
                               path.add(timed);
                               if (verifier) verifier->take(timed);
                             },
                         .stretch =
                             [&](const motion::Stretch& stretch, const timing::TimedEvent& timed) {
                               path.add(stretch);
                               if (verifier) verifier->take(stretch, removal::MotionFacts(timed));
                             }});
  verification::VerifiedRun verified;
  if (verifier) verified = verification::verified_outcome({}, *verifier, program.text(), result);
  const auto now = std::make_shared<SentPath>(SentPath{.id = 0,
                                                       .steps = std::string(recording.steps()),
                                                       .points = std::string(recording.points()),
                                                       .turns = std::string(recording.turns()),
                                                       .cuts = std::string(cuts ? cuts->bytes() : "")});
  std::shared_ptr<const SentPath> before;
  {
    const std::lock_guard lock(last->mutex);
    now->id = ++last->last_id;
    if (last->path && fmt::to_string(last->path->id) == previous) before = last->path;
    last->path = now;
  }
  const auto stream_of = [&](std::string SentPath::*member) {
    return stream((*now).*member, before ? &((*before).*member) : nullptr);
  };
  return fmt::format(R"({{"resultId":"{}","version":{},"facts":{},"steps":{},"points":{},"turns":{},"cuts":{}}})",
                     now->id, program.version(), recording.facts(path, {result, verified, cuts ? &*cuts : nullptr}),
                     stream_of(&SentPath::steps), stream_of(&SentPath::points), stream_of(&SentPath::turns),
                     stream_of(&SentPath::cuts));
}

features::BackgroundRequest begin(const Snapshot& snapshot, const ToolpathParams& params) {
  auto& last = snapshot.memory<std::shared_ptr<LastSent>>();
  if (!last) last = std::make_shared<LastSent>();
  const auto path = protocol::path_of(snapshot.uri());
  const configuration::MachineConfiguration& machine = snapshot.configuration().machine;
  const auto task = std::make_shared<ToolpathTask>(
      ToolpathTask{.program = queries::TimedProgram(snapshot, params.vgpl),
                   .subject = {.name = path ? path->filename().generic_string() : snapshot.uri(),
                               .program = {},
                               .home = machine.setup.home,
                               .tools = plot::plot_tools(machine),
                               .page = {},
                               .language = snapshot.language()},
                   .previous = params.previous,
                   .last = last});
  return [task](const std::function<bool()>& stop) { return task->compute(stop); };
}

Json toolpath_capabilities(const Client&) { return {{"experimental", {{"toolpath", true}}}}; }

}  // namespace

extern const features::Feature toolpath = {.capabilities = toolpath_capabilities,
                                           .methods = {in_background<&begin>("isocnc/toolpath")}};

}  // namespace isocnc::extensions
