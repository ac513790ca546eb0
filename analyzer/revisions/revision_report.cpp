#include "analyzer/revisions/revision_report.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analyzer/selection/vgpl_values.h"
#include "interpreter/dialect/format.h"
#include "interpreter/running/event.h"
#include "interpreter/summary/summary.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/text/unicode.h"

namespace isocnc::revisions {

using comparison::ActionTool;
using comparison::TextStyle;
using dialect::Language;
using dialect::Text;
using OrderedJson = nlohmann::ordered_json;

namespace {

constexpr Text kToolTime{"{}: {}, was {} ({:+.1f} s)\n", "{}: {}, era {} ({:+.1f} s)\n"};
constexpr Text kToolVolume{"{}: removes {} cm3, was {} cm3\n", "{}: asporta {} cm3, erano {} cm3\n"};
constexpr Text kVolume{"removed volume: {} cm3, was {} cm3\n", "volume asportato: {} cm3, era {} cm3\n"};
constexpr Text kFindings{"findings", "segnalazioni"};
constexpr Text kNew{"new: line {}", "nuova: riga {}"};
constexpr Text kGone{"gone: old line {}", "non più: prima riga {}"};
constexpr Text kChanged{"changed: line {}", "cambiata: riga {}"};
constexpr Text kChangedFrom{"changed: line {}, was line {}", "cambiata: riga {}, era riga {}"};
constexpr Text kWas{"was: {}", "era: {}"};

constexpr std::string_view kKinds[] = {"new", "gone", "changed"};
constexpr std::string_view kSeverityColors[] = {"\x1b[31m", "\x1b[33m", "\x1b[36m"};

/// What both runs do with a tool.
struct ToolTotals {
  execution::ToolCode tool;
  double old_seconds = 0;
  double new_seconds = 0;
  double old_volume = 0;
  double new_volume = 0;
};

double volume_of(const RevisionRun& run, const execution::ToolCode& tool) {
  if (!run.material) return 0;
  for (const removal::RemovedByTool& each : run.material->by_tool)
    if (each.tool == tool) return each.removed.volume;
  return 0;
}

double removed_volume(const RevisionRun& run) { return run.material->blank_volume - run.material->stock.volume(); }

/// Volumes that differ by less are the same to the eye, mm^3.
bool shows_volume(double difference) { return std::abs(difference) >= 0.5; }

/// By tool, in the order of the new program, and then those that only the old one has.
std::vector<ToolTotals> tool_totals(const RevisionComparison& compared) {
  std::vector<ToolTotals> totals;
  const auto of = [&](const ActionTool& tool) -> ToolTotals& {
    const auto known =
        std::find_if(totals.begin(), totals.end(), [&](const ToolTotals& each) { return each.tool == tool.code; });
    return known == totals.end() ? totals.emplace_back(ToolTotals{.tool = tool.code}) : *known;
  };
  for (const ActionTool& each : compared.new_run.recorded.tools) of(each).new_seconds = each.seconds;
  for (const ActionTool& each : compared.old_run.recorded.tools) of(each).old_seconds = each.seconds;
  for (ToolTotals& each : totals) {
    each.old_volume = volume_of(compared.old_run, each.tool);
    each.new_volume = volume_of(compared.new_run, each.tool);
  }
  return totals;
}

/// Of one tool, the cycle time and the volume of all say it.
std::string tools_text(const RevisionComparison& compared, Language language) {
  std::string text;
  if (compared.old_run.material && compared.new_run.material) {
    const double before = removed_volume(compared.old_run);
    const double now = removed_volume(compared.new_run);
    if (shows_volume(now - before))
      text +=
          dialect::format(kVolume, language, fmt::format("{:.2f}", now / 1000), fmt::format("{:.2f}", before / 1000));
  }
  const std::vector<ToolTotals> totals = tool_totals(compared);
  if (totals.size() < 2) return text;
  for (const ToolTotals& each : totals) {
    const std::string name = running::tool_name(each.tool);
    if (comparison::shows_seconds(each.new_seconds - each.old_seconds))
      text += dialect::format(kToolTime, language, name, summary::shown_time(each.new_seconds),
                              summary::shown_time(each.old_seconds), each.new_seconds - each.old_seconds);
    if (shows_volume(each.new_volume - each.old_volume))
      text += dialect::format(kToolVolume, language, name, fmt::format("{:.2f}", each.new_volume / 1000),
                              fmt::format("{:.2f}", each.old_volume / 1000));
  }
  return text;
}

/// The messages of a run's findings.
class FindingMessages {
 public:
  FindingMessages(const RevisionRun& run, Language language) : run_(run), language_(language) {
    syntax::LineFinder lines(run.text);
    for (const check::LocatedFinding& each : run.findings.findings) lines_.push_back(lines.line(each.line));
  }

  const check::LocatedFinding& located(std::size_t index) const { return run_.findings.findings[index]; }
  std::string of(std::size_t index) const {
    return text::printable(syntax::message(located(index).finding, lines_[index], language_));
  }

 private:
  const RevisionRun& run_;
  std::vector<std::string_view> lines_;  ///< That of each finding.
  Language language_;
};

/// `changed: line 12, was line 10`.
std::string place_in_words(const FindingChange& change, const FindingMessages& old_messages,
                           const FindingMessages& new_messages, Language language) {
  if (change.kind == FindingChangeKind::New)
    return dialect::format(kNew, language, new_messages.located(*change.new_finding).line + 1);
  const std::size_t old_line = old_messages.located(*change.old_finding).line + 1;
  if (change.kind == FindingChangeKind::Gone) return dialect::format(kGone, language, old_line);
  const std::size_t new_line = new_messages.located(*change.new_finding).line + 1;
  return old_line == new_line ? dialect::format(kChanged, language, new_line)
                              : dialect::format(kChangedFrom, language, new_line, old_line);
}

std::string findings_text(const RevisionComparison& compared, const TextStyle& style) {
  if (compared.findings.empty()) return "";
  const Language language = style.language;
  FindingMessages old_messages(compared.old_run, language);
  FindingMessages new_messages(compared.new_run, language);
  std::string text =
      fmt::format("{}{}{}\n", style.paint(comparison::kBold), kFindings.in(language), style.paint(comparison::kReset));
  for (const FindingChange& change : compared.findings) {
    FindingMessages& messages = change.new_finding ? new_messages : old_messages;
    const std::size_t index = change.new_finding ? *change.new_finding : *change.old_finding;
    const check::LocatedFinding& located = messages.located(index);
    const std::string message = messages.of(index);
    const std::string place = place_in_words(change, old_messages, new_messages, language);
    text += fmt::format("  {}: {}{}[{}]{}: {}\n", place,
                        style.paint(kSeverityColors[static_cast<std::size_t>(located.severity())]),
                        dialect::severity_name(located.severity(), language),
                        dialect::definition(located.finding.id).code, style.paint(comparison::kReset), message);
    if (change.kind != FindingChangeKind::Changed) continue;
    const std::string before = old_messages.of(*change.old_finding);
    if (before != message) text += fmt::format("    {}\n", dialect::format(kWas, language, before));
  }
  return text;
}

OrderedJson findings_json(const RevisionComparison& compared, Language language) {
  FindingMessages old_messages(compared.old_run, language);
  FindingMessages new_messages(compared.new_run, language);
  OrderedJson findings = OrderedJson::array();
  for (const FindingChange& change : compared.findings) {
    FindingMessages& messages = change.new_finding ? new_messages : old_messages;
    const std::size_t index = change.new_finding ? *change.new_finding : *change.old_finding;
    const check::LocatedFinding& located = messages.located(index);
    const auto line = [](FindingMessages& of, const std::optional<std::size_t>& finding) {
      return finding ? OrderedJson(of.located(*finding).line + 1) : OrderedJson();
    };
    OrderedJson each = {{"kind", kKinds[static_cast<std::size_t>(change.kind)]},
                        {"code", dialect::definition(located.finding.id).code},
                        {"severity", dialect::severity_name(located.severity(), Language::English)},
                        {"old", line(old_messages, change.old_finding)},
                        {"new", line(new_messages, change.new_finding)},
                        {"text", messages.of(index)}};
    if (change.kind == FindingChangeKind::Changed) each["oldText"] = old_messages.of(*change.old_finding);
    findings.push_back(std::move(each));
  }
  return findings;
}

OrderedJson run_json(const RevisionRun& run) {
  OrderedJson json = comparison::run_json(run.recorded);
  if (!run.material) return json;
  json["removedVolume"] = removed_volume(run);
  for (std::size_t i = 0; i < run.recorded.tools.size(); ++i)
    json["tools"][i]["removedVolume"] = volume_of(run, run.recorded.tools[i].code);
  return json;
}

}  // namespace

std::string text_of(const RevisionComparison& compared, const TextStyle& style) {
  const comparison::ComparedRuns runs = compared.runs();
  const std::string findings = findings_text(compared, style);
  const std::string stop = stop_text(runs, style.language);
  if (compared.is_same()) return count_text(runs, style) + stop + findings;
  return changes_text(runs, style) + totals_text(runs, style.language) + tools_text(compared, style.language) +
         findings + stop + count_text(runs, style);
}

/// A jump that other values than those of the command lead along another path.
struct OtherPath {
  bool is_new = false;  ///< Of the new program.
  std::string name;     ///< VGPL, or the register.
  std::size_t line = 0;
};

/// Of the new program, and where it has none, of the old one.
static std::vector<OtherPath> other_paths(const RevisionComparison& compared, Language language) {
  std::vector<OtherPath> paths;
  const auto add = [&](const RevisionRun& run, bool is_new) {
    selection::VgplValues values(run.text);
    values.take(run.path);
    for (const verification::Unverified& gap : values.gaps()) {
      const bool is_of_vgpl = gap.gap == verification::Gap::OtherPaths;
      paths.push_back({is_new, is_of_vgpl ? "VGPL" : std::string(gap.name.in(language)), gap.line});
    }
  };
  add(compared.new_run, true);
  if (paths.empty()) add(compared.old_run, false);
  return paths;
}

std::string other_paths_text(const RevisionComparison& compared, Language language) {
  static constexpr Text kOld{"not compared: other values of {} at the jump of old line {} (--all-paths)\n",
                             "non confrontato: altri valori di {} al salto della prima riga {} (--all-paths)\n"};
  static constexpr Text kNew{"not compared: other values of {} at the jump of line {} (--all-paths)\n",
                             "non confrontato: altri valori di {} al salto della riga {} (--all-paths)\n"};
  std::string text;
  for (const OtherPath& each : other_paths(compared, language))
    text += dialect::format(each.is_new ? kNew : kOld, language, each.name, each.line + 1);
  return text;
}

OrderedJson to_json(const RevisionComparison& compared, Language language) {
  return {{"same", compared.is_same()},
          {"old", run_json(compared.old_run)},
          {"new", run_json(compared.new_run)},
          {"changes", comparison::changes_json(compared.runs(), language)},
          {"findings", findings_json(compared, language)}};
}

std::string json_of(const RevisionComparison& compared, Language language) {
  OrderedJson json = to_json(compared, language);
  for (const OtherPath& each : other_paths(compared, language))
    json["otherPaths"].push_back(
        {{"revision", each.is_new ? "new" : "old"}, {"name", each.name}, {"line", each.line + 1}});
  return json.dump() + '\n';
}

}  // namespace isocnc::revisions
