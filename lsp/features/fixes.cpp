#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "analyzer/check/folding.h"
#include "analyzer/fixes/fix.h"
#include "analyzer/fixing/finding_fixes.h"
#include "analyzer/fixing/fixer.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/format.h"
#include "lsp/features/feature.h"
#include "lsp/queries/snapshot_program.h"
#include "lsp/queries/text_edits.h"

/// Code actions that fix findings, one by one or all safe ones together, and that silence them.
namespace isocnc::features {

using check::LocatedFinding;
using dialect::Text;
using fixes::Edit;
using fixes::Fix;
using queries::SnapshotProgram;

static constexpr std::string_view kQuickFix = "quickfix";
static constexpr std::string_view kFixAll = "source.fixAll.isocnc";

/// The maximum number of findings for which actions are offered at once.
static constexpr std::size_t kMaxFixed = 50;

/// The maximum number of edits sent with an action. Larger edits, which only fixes of a program's habit have, are made
/// on request.
static constexpr std::size_t kMaxEdits = 1'000;

namespace {

/// A finding, and the line among those asked for on which it shows: its own, or one that repeats it (D66).
struct FindingOnLine {
  const LocatedFinding& located;
  check::Repetition place;
};

/// The findings on the lines, up to kMaxFixed.
std::vector<FindingOnLine> findings_of(const Snapshot& snapshot, const ActionParams& params) {
  std::vector<FindingOnLine> found;
  const check::Report& report = snapshot.report();
  for (const LocatedFinding& located : report.findings) {
    if (located.line > params.last_line() || found.size() == kMaxFixed) break;
    if (located.line >= params.first_line()) {
      found.push_back({located, {located.line, located.finding.id, located.finding.span}});
    } else if (const auto* const again = check::repetition_from(params.first_line(), located, report)) {
      if (again->line <= params.last_line()) found.push_back({located, *again});
    }
  }
  return found;
}

/// The client's diagnostic for a finding, in an array; null if the client has none.
Json diagnostics_of(const Snapshot& snapshot, const check::Repetition& place, const ActionParams& params) {
  const Json start = snapshot.to_client(place.line, place.span).start;
  const Json code = dialect::definition(place.id).code;
  for (const Json& diagnostic : params.diagnostics)
    if (diagnostic.is_object() && diagnostic.value("code", Json()) == code &&
        diagnostic.value(Json::json_pointer("/range/start"), Json()) == start)
      return Json::array({diagnostic});
  return nullptr;
}

void offer_fixes(const Snapshot& snapshot, const ActionParams& params, std::vector<Action>& actions) {
  SnapshotProgram program(snapshot);
  for (const auto& [located, place] : findings_of(snapshot, params)) {
    const bool on_every_path = located.path < 0 && !snapshot.frontier_before(located.line).reduced;
    const std::optional<Fix> fix =
        fixing::fix_of_all_lines(located, snapshot.report(), on_every_path, program, kMaxEdits);
    if (!fix) continue;
    const std::vector<Edit> edits = all_edits(*fix, program);
    Action& action = actions.emplace_back(Action{.title = fix->title_in(snapshot.language()),
                                                 .kind = kQuickFix,
                                                 .is_preferred = fix->safety == fixes::Safety::Safe,
                                                 .diagnostics = diagnostics_of(snapshot, place, params),
                                                 .data = {{"habit", fix->habit}}});
    if (edits.size() <= kMaxEdits) action.edit = queries::workspace_edit(snapshot, queries::to_client(snapshot, edits));
  }
}

/// The edit that changes a habit everywhere, which may affect much of the program.
Json rewrite_habit(const Snapshot& snapshot, const Json& data) {
  const auto habit = data.value("habit", std::size_t{0});
  if (habit >= fixes::kHabitCount) throw rpc::Error(rpc::ErrorCode::RequestFailed, "no such habit");
  SnapshotProgram program(snapshot);
  const std::vector<Edit> edits = all_edits({.habit = fixes::Habit{static_cast<std::uint8_t>(habit)}}, program);
  if (edits.empty()) throw rpc::Error(rpc::ErrorCode::RequestFailed, "the program has changed: nothing to rewrite");
  return queries::workspace_edit(snapshot, queries::to_client(snapshot, edits));
}

// --- Silencing

constexpr Text kSilenceLine = {"silence {} on this line", "tacere {} su questa riga"};
constexpr Text kSilenceFile = {"silence {} in the whole program", "tacere {} in tutto il programma"};

/// Appends the suppression to the line: within its comment, if the line ends in one that runs to the end of the line.
Edit silencing_line(const syntax::LineTree& line, std::size_t number, std::string_view code) {
  const auto is_open = [&](syntax::Span comment) {
    return comment.end == line.text.size() &&
           (line.text[comment.begin] == ';' || line.has(syntax::LineTree::kUnclosed));
  };
  const bool continues = std::any_of(line.comments.begin(), line.comments.end(), is_open);
  const syntax::Position end{number, line.text.size()};
  return {end, end, fmt::format(" {}isolint: ignore {}", continues ? "" : ";", code)};
}

void offer_silence(const Snapshot& snapshot, const ActionParams& params, std::vector<Action>& actions) {
  const auto offer = [&](const Text& title, const check::Repetition& place, const Edit& edit) {
    const std::string_view code = dialect::definition(place.id).code;
    Action action{.title = dialect::format(title, snapshot.language(), code),
                  .kind = kQuickFix,
                  .diagnostics = diagnostics_of(snapshot, place, params),
                  .edit = queries::workspace_edit(snapshot, queries::to_client(snapshot, {edit})),
                  .data = nullptr};
    const auto is_there = [&](const Action& each) { return each.title == action.title && each.edit == action.edit; };
    if (std::none_of(actions.begin(), actions.end(), is_there)) actions.push_back(std::move(action));
  };
  for (const auto& [located, place] : findings_of(snapshot, params)) {
    const std::string_view code = dialect::definition(place.id).code;
    const syntax::DocumentLine line = snapshot.document().line(place.line);
    offer(kSilenceLine, place, silencing_line(*line, place.line, code));
    offer(kSilenceFile, place, {{0, 0}, {0, 0}, fmt::format(";isolint: ignore-file {}\n", code)});
  }
}

// --- All at once

std::vector<protocol::TextEdit> edits_of_all(const Snapshot& snapshot) {
  const std::string text = snapshot.document().text();
  const auto pause = [&](check::Report report, std::string_view) {
    snapshot.throw_if_unwanted();
    return report;
  };
  const fixing::FixedText fixed = fixing::fix_text(
      text, {.selection = snapshot.selection(), .setup = snapshot.check_setup(), .finding_filter = pause});
  return queries::edits_to(snapshot, fixed.text, fixed.origins);
}

Json fix_all(const Snapshot& snapshot, const Json&) {
  const std::vector<protocol::TextEdit> edits = edits_of_all(snapshot);
  if (edits.empty()) throw rpc::Error(rpc::ErrorCode::RequestFailed, "nothing can be fixed safely");
  return queries::workspace_edit(snapshot, edits);
}

void offer_fix_all(const Snapshot& snapshot, const ActionParams&, std::vector<Action>& actions) {
  static constexpr Text kTitle = {"fix all that can be fixed safely", "correggere tutto ciò che è sicuro"};
  if (snapshot.report().findings.empty()) return;
  actions.push_back(
      {.title = std::string(kTitle.in(snapshot.language())), .kind = kFixAll, .diagnostics = nullptr, .data = nullptr});
}

struct FixAllParams {};
void from_json(const Json&, FixAllParams&) {}

Json fix_all_now(const Snapshot& snapshot, const FixAllParams&) {
  return {{"edit", queries::workspace_edit(snapshot, edits_of_all(snapshot))}};
}

}  // namespace

extern const Feature fixes = {.commands = {on<&fix_all_now>("isocnc.fixAll")},
                              .actions = {{.kind = kQuickFix, .offer = offer_fixes, .edit = rewrite_habit},
                                          {.kind = kQuickFix, .offer = offer_silence},
                                          {.kind = kFixAll, .offer = offer_fix_all, .edit = fix_all}}};

}  // namespace isocnc::features
