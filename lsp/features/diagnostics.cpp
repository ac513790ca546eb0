#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "analyzer/formats/related.h"
#include "analyzer/formats/rendering.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/format.h"
#include "interpreter/simulation/run_findings.h"
#include "lsp/documents/rule_page.h"
#include "lsp/features/feature.h"
#include "lsp/protocol/uri.h"

/// The findings of isolint for the editor's Problems list: pushed after each edit, or pulled by clients that can pull.
/// Those that only a run on the machine shows follow the others in the same list, with a source of their own. They are
/// the findings of the last verification, faded while the text has changed since.
namespace isocnc::features {

using namespace dialect::literals;
using check::LocatedFinding;

/// The maximum number of findings sent for one program; a last diagnostic gives the number of the others.
static constexpr std::size_t kMaxFindings = 1000;
/// The maximum number of lines with a hint that they repeat a finding above (D66), and of those that it names.
static constexpr std::size_t kMaxHints = 1000;
static constexpr std::size_t kMaxNamedLines = 10;

/// The answer for a configuration, whose diagnostics are always pushed.
static constexpr std::string_view kNothing = R"({"kind":"full","items":[]})";

static constexpr const char* kPull = "/textDocument/diagnostic";

namespace {

struct PullParams : protocol::DocumentParams {
  std::optional<std::string> previous_result_id;
};

void from_json(const Json& json, PullParams& params) {
  from_json(json, static_cast<protocol::DocumentParams&>(params));
  params.previous_result_id = protocol::member<std::string>(json, "previousResultId");
}

/// Where findings come from, as the client shows it.
struct DiagnosticSource {
  std::string_view name;
  bool is_outdated = false;  ///< They are about an earlier text.
};

/// Writes the findings of one snapshot and source for the client.
class DiagnosticWriter {
 public:
  DiagnosticWriter(const Snapshot& snapshot, check::FirstFindings findings, const DiagnosticSource& source)
      : snapshot_(snapshot),
        language_(snapshot.language()),
        first_(std::move(findings)),
        source_(source),
        sends_related_(snapshot.client().can("/textDocument/publishDiagnostics/relatedInformation")) {}

  /// Appends the diagnostics as JSON text, each after a comma. They are written directly for speed: there may be many,
  /// and they are sent after each edit.
  void append_all(std::string& list) const {
    static constexpr std::size_t kUsualLength = 400;
    const std::vector<LocatedFinding>& findings = first_.report.findings;
    list.reserve(list.size() + kUsualLength * std::min(findings.size(), kMaxFindings));
    for (std::size_t i = 0; i < std::min(findings.size(), kMaxFindings); ++i) append(findings[i], list);
    if (findings.size() > kMaxFindings) append_rest(findings[kMaxFindings], list);
    append_hints(list);
  }

 private:
  void append(const LocatedFinding& located, std::string& list) const {
    append_head(located.line, located.finding.span, 1 + static_cast<int>(located.severity()), message_of(located),
                list);
    list += constant_part(located.finding.id);
    if (source_.is_outdated) append_unnecessary(list);
    if (sends_related_ && has_related(located)) {
      Json related = Json::array();
      if (located.path >= 0) related = path_of(located);
      add_run_places(located, related);
      add_repetitions(located, related);
      list += R"(,"relatedInformation":)" + rpc::write(related);
    }
    list += '}';
  }

  static bool has_related(const LocatedFinding& located) {
    return located.path >= 0 || located.repetitions >= 0 || located.last_line || located.worst_line ||
           located.shaped_by || located.finding.described;
  }

  std::string message_of(const LocatedFinding& located) const {
    return formats::message_of(located, first_.report, snapshot_.document().text_of_line(located.line), language_);
  }

  void append_head(std::size_t line, syntax::Span span, int severity, const std::string& message,
                   std::string& list) const {
    const ClientRange range = snapshot_.to_client(line, span);
    fmt::format_to(
        std::back_inserter(list),
        FMT_COMPILE(R"(,{{"range":{{"start":{{"line":{},"character":{}}},"end":{{"line":{},"character":{}}}}},)"
                    R"("severity":{},"source":"{}","message":)"),
        range.start.line, range.start.character, range.end.line, range.end.character, severity, source_.name);
    append_text(message, list);
  }

  /// Most messages need no escapes in JSON.
  static void append_text(const std::string& text, std::string& list) {
    const auto is_plain = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; };
    if (!std::all_of(text.begin(), text.end(), is_plain)) {
      list += rpc::write(Json(text));
      return;
    }
    list += '"';
    list += text;
    list += '"';
  }

  /// The JSON after the message, which is the same for all findings of one kind.
  static const std::string& constant_part(dialect::DiagnosticId id) {
    static const auto kConstantParts = [] {
      std::vector<std::string> parts;
      for (std::size_t i = 0; i < dialect::kDiagnosticCount; ++i) {
        const auto each = static_cast<dialect::DiagnosticId>(i);
        const dialect::DiagnosticDef& def = dialect::definition(each);
        parts.push_back(fmt::format(R"(,"code":"{}","codeDescription":{{"href":"{}"}},"data":{{"name":"{}"}})",
                                    def.code, documents::rule_page(each), def.name));
        if (each == "never-runs"_diag) parts.back() += R"(,"tags":[1])";
      }
      return parts;
    }();
    return kConstantParts[static_cast<std::size_t>(id)];
  }

  /// The jumps through which a finding is reached.
  Json path_of(const LocatedFinding& located) const {
    Json steps = Json::array();
    for (const check::PathStep& step : first_.report.paths[static_cast<std::size_t>(located.path)]) {
      const syntax::DocumentLine read = snapshot_.document().line(step.line);
      const syntax::LineTree& line = *read;
      const syntax::Span span =
          line.jump ? syntax::Span{line.jump->if_span.begin, line.jump->target_span.end} : syntax::Span{};
      steps.push_back({{"location", protocol::Location{snapshot_.uri(), snapshot_.to_client(step.line, span)}},
                       {"message", formats::describe_step(step, line.text, language_)}});
    }
    return steps;
  }

  /// Where a contact ends, and where a file describes what is hit.
  void add_run_places(const LocatedFinding& located, Json& related) const {
    for (const formats::RunPlace& place : formats::run_places(located, language_)) {
      const bool is_here = place.file.empty();
      related.push_back(
          {{"location", is_here ? line_location(place.line - 1) : file_location(place)}, {"message", place.note}});
    }
  }

  protocol::Location line_location(std::size_t line) const {
    const syntax::DocumentLine read = snapshot_.document().line(line);
    return {snapshot_.uri(), snapshot_.to_client(line, simulation::motion_span(*read))};
  }

  /// The file is not read: columns after characters of several bytes are a little too large.
  static protocol::Location file_location(const formats::RunPlace& place) {
    const protocol::ClientPosition start{static_cast<std::uint32_t>(place.line - 1),
                                         static_cast<std::uint32_t>(place.column - 1)};
    return {protocol::uri_of(configuration::real_path(std::filesystem::path(place.file))), {start, start}};
  }

  /// The first lines that repeat a finding, and the last one.
  void add_repetitions(const LocatedFinding& located, Json& related) const {
    static constexpr dialect::Text kAgain = {"here again", "anche qui"};
    const std::span<const check::Repetition> all = first_.report.repetitions_of(located);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i == kMaxNamedLines - 1) i = all.size() - 1;
      related.push_back(
          {{"location", protocol::Location{snapshot_.uri(), snapshot_.to_client(all[i].line, all[i].span)}},
           {"message", kAgain.in(language_)}});
    }
  }

  /// Fades what repeats a finding above, in the order of the findings.
  void append_hints(std::string& list) const {
    const std::vector<LocatedFinding>& findings = first_.report.findings;
    std::size_t left = kMaxHints;
    for (std::size_t i = 0; i < std::min(findings.size(), kMaxFindings) && left > 0; ++i) {
      if (findings[i].repetitions < 0) continue;
      const std::span<const check::Repetition> all = first_.report.repetitions_of(findings[i]);
      const std::string message = dialect::format(kAsAbove, language_, findings[i].line + 1, message_of(findings[i]));
      for (const check::Repetition& again : all.first(std::min(all.size(), left)))
        append_hint(findings[i], again, message, list);
      left -= std::min(all.size(), left);
    }
  }

  void append_hint(const LocatedFinding& first, const check::Repetition& again, const std::string& message,
                   std::string& list) const {
    static constexpr int kHint = 4;
    append_head(again.line, again.span, kHint, message, list);
    list += constant_part(again.id);
    append_unnecessary(list);
    if (sends_related_) {
      const Json place = {
          {"location", protocol::Location{snapshot_.uri(), snapshot_.to_client(first.line, first.finding.span)}},
          {"message", kFirst.in(language_)}};
      list += R"(,"relatedInformation":)" + rpc::write(Json::array({place}));
    }
    list += '}';
  }

  static void append_unnecessary(std::string& list) {
    static constexpr int kUnnecessary = 1;  // Editors fade such text.
    fmt::format_to(std::back_inserter(list), R"(,"tags":[{}])", kUnnecessary);
  }

  static constexpr dialect::Text kAsAbove = {"as on line {}: {}", "come alla linea {}: {}"};
  static constexpr dialect::Text kFirst = {"here first", "qui la prima volta"};

  /// Appends one diagnostic for all further findings, at the place of the first of them.
  void append_rest(const LocatedFinding& next, std::string& list) const {
    static constexpr dialect::Text kRest = {"findings that are not shown: {}; isolint reports them all",
                                            "segnalazioni non mostrate: {}; isolint le riporta tutte"};
    const std::size_t count = first_.report.findings.size() + first_.left_out - kMaxFindings;
    append_head(next.line, next.finding.span, 3, dialect::format(kRest, language_, count), list);
    list += '}';
  }

  const Snapshot& snapshot_;
  const dialect::Language language_;
  const check::FirstFindings first_;
  const DiagnosticSource source_;
  const bool sends_related_;
};

/// The diagnostics of a snapshot as a list in JSON.
std::string all_diagnostics(const Snapshot& snapshot) {
  std::string list;
  DiagnosticWriter(snapshot, snapshot.excerpt(kMaxFindings + 1), {.name = "isolint"}).append_all(list);
  DiagnosticWriter(snapshot, snapshot.run_excerpt(), {"isocnc verify", !snapshot.is_verified()}).append_all(list);
  if (list.empty()) return "[]";
  list.front() = '[';  // Instead of the first comma.
  list += ']';
  return list;
}

/// Equal findings have equal ids, so that a client that has them does not get them again.
std::string id_of(const std::string& items) { return fmt::format("{:x}", std::hash<std::string>()(items)); }

/// The id of the diagnostics that the client has got for this document; empty if none.
struct SentDiagnostics {
  std::string id;
};

protocol::RawJson pull(const Snapshot& snapshot, const PullParams& params) {
  const std::string items = all_diagnostics(snapshot);
  const std::string id = id_of(items);
  snapshot.memory<SentDiagnostics>().id = id;
  if (params.previous_result_id == id) return {fmt::format(R"({{"kind":"unchanged","resultId":"{}"}})", id)};
  return {fmt::format(R"({{"kind":"full","resultId":"{}","items":{}}})", id, items)};
}

/// The pulled diagnostics of each program in the workspace, open or not.
protocol::RawJson pull_each(const Snapshot& snapshot, const Json& /*params*/) {
  const std::string report = pull(snapshot, {}).text;
  const std::string version = snapshot.version() < 0 ? "null" : std::to_string(snapshot.version());
  return {fmt::format(R"([{{"uri":{},"version":{},{}])", rpc::write(Json(snapshot.uri())), version,
                      std::string_view(report).substr(1))};
}

/// Leaves out what the client already has, and clears the diagnostics of removed programs.
std::string conclude_pull(const std::string& results, const Json& params, AggregateScope scope) {
  std::map<std::string, std::string> before;
  for (const Json& each : params.value("previousResultIds", Json::array())) before[each.at("uri")] = each.at("value");
  if (before.empty()) return fmt::format(R"({{"items":{}}})", scope == AggregateScope::Rest ? "[]" : results);
  Json reports = Json::parse(results);
  for (Json& report : reports) {
    const auto known = before.find(report["uri"].get_ref<const std::string&>());
    if (known == before.end()) continue;
    if (known->second == report["resultId"]) {
      report["kind"] = "unchanged";
      report.erase("items");
    }
    before.erase(known);
  }
  if (scope == AggregateScope::Some) return rpc::write({{"items", reports}});
  if (scope == AggregateScope::Rest) reports = Json::array();
  for (const auto& [uri, id] : before)
    if (id != id_of("[]"))
      reports.push_back(
          {{"kind", "full"}, {"uri", uri}, {"version", nullptr}, {"resultId", id_of("[]")}, {"items", Json::array()}});
  return rpc::write({{"items", reports}});
}

/// A client that pulls would show pushed diagnostics a second time.
bool is_pushed(const Client& client) { return !client.can(kPull); }

void push_items(const Snapshot& snapshot, const std::string& items, const Notify& notify) {
  notify("textDocument/publishDiagnostics", fmt::format(R"({{"uri":{},"version":{},"diagnostics":{}}})",
                                                        rpc::write(Json(snapshot.uri())), snapshot.version(), items));
  snapshot.memory<SentDiagnostics>().id = id_of(items);
}

void push(const Snapshot& snapshot, const Notify& notify) {
  if (is_pushed(snapshot.client())) push_items(snapshot, all_diagnostics(snapshot), notify);
}

/// Shows what a verification has changed. A client that has not pulled yet will do so.
bool show_verified(const Snapshot& snapshot, const Notify& notify) {
  const std::string& sent = snapshot.memory<SentDiagnostics>().id;
  if (!is_pushed(snapshot.client()) && sent.empty()) return false;
  const std::string items = all_diagnostics(snapshot);
  if (sent == id_of(items)) return false;
  if (!is_pushed(snapshot.client())) return true;
  push_items(snapshot, items, notify);
  return false;
}

void clear(const std::string& uri, const Client& client, const Notify& notify) {
  if (is_pushed(client))
    notify("textDocument/publishDiagnostics", rpc::write({{"uri", uri}, {"diagnostics", Json::array()}}));
}

Json diagnostics_capabilities(const Client& client) {
  return {{"diagnosticProvider",
           {{"identifier", "isolint"},
            {"interFileDependencies", false},
            {"workspaceDiagnostics", client.settings.checks_workspace}}}};
}

}  // namespace

extern const Feature diagnostics = {
    .capabilities = diagnostics_capabilities,
    .methods = {on_any<&pull>("textDocument/diagnostic", kNothing)},
    .workspace_requests = {workspace_request<&pull_each>("workspace/diagnostic", conclude_pull)},
    .changed = push,
    .changed_so_far = push,
    .verified = show_verified,
    .refresh = Refresh{.method = "workspace/diagnostic/refresh",
                       .capability = "/workspace/diagnostics/refreshSupport",
                       .covers_closed = true},
    .closed = clear};

}  // namespace isocnc::features
