#include <optional>
#include <string>
#include <vector>

#include "analyzer/fixing/rewriting.h"
#include "analyzer/formatting/program_formatter.h"
#include "lsp/features/feature.h"
#include "lsp/queries/snapshot_program.h"
#include "lsp/queries/text_edits.h"

/// Code actions that write the program differently and keep its motions.
namespace isocnc::features {

using dialect::Text;
using fixing::Rewrite;
using formatting::LinesFormatter;
using formatting::MotionStyle;
using formatting::NumberStyle;
using formatting::ProgramStyle;
using protocol::TextEdit;

/// The maximum number of lines of a selection that is examined before an action is offered; a longer one is examined
/// after the user has chosen the action.
static constexpr std::size_t kQuickLines = 500;

namespace {

struct RewriteAction {
  Rewrite how;
  std::string_view kind;
  bool wants_selection;  ///< Whether a selection is required: a single line would only become three.
  Text title;
};

constexpr RewriteAction kRewriteActions[] = {
    {Rewrite::ArcByRadius,
     "refactor.rewrite.isocnc.arc",
     false,
     {"give the arc's radius in the place of its center", "indicare il raggio dell'arco al posto del centro"}},
    {Rewrite::ArcByCenter,
     "refactor.rewrite.isocnc.arc",
     false,
     {"give the arc's center in the place of its radius", "indicare il centro dell'arco al posto del raggio"}},
    {Rewrite::Incremental,
     "refactor.rewrite.isocnc.distance",
     true,
     {"write the selection in incremental dimensions (G91)", "scrivere la selezione in quote incrementali (G91)"}},
    {Rewrite::Absolute,
     "refactor.rewrite.isocnc.distance",
     true,
     {"write the selection in absolute dimensions (G90)", "scrivere la selezione in quote assolute (G90)"}},
    {Rewrite::Millimeters,
     "refactor.rewrite.isocnc.units",
     true,
     {"write the selection in millimeters (G71)", "scrivere la selezione in millimetri (G71)"}},
    {Rewrite::Inches,
     "refactor.rewrite.isocnc.units",
     true,
     {"write the selection in inches (G70)", "scrivere la selezione in pollici (G70)"}},
};

constexpr Text kNotTheSame = {
    "the motions would not stay the same: a jump leads into the lines or out of them, a line has an error, or the "
    "position before them is not known on all paths",
    "i movimenti non resterebbero gli stessi: un salto entra nelle righe o ne esce, una riga ha un errore, oppure la "
    "posizione che le precede non è nota su tutti i percorsi"};

[[noreturn]] void refuse(std::string_view why) { throw rpc::Error(rpc::ErrorCode::RequestFailed, std::string(why)); }

std::optional<Json> try_rewrite(const Snapshot& snapshot, Rewrite how, std::size_t first, std::size_t last) {
  queries::SnapshotProgram program(snapshot);
  const auto edits = fixing::rewrite(how, program, snapshot.setup(), first, last);
  if (!edits) return std::nullopt;
  return queries::workspace_edit(snapshot, queries::to_client(snapshot, *edits));
}

void offer_rewrites(const Snapshot& snapshot, const ActionParams& params, std::vector<Action>& actions) {
  for (std::size_t i = 0; i < std::size(kRewriteActions); ++i) {
    const RewriteAction& kind = kRewriteActions[i];
    if (!params.wants(kind.kind) || (kind.wants_selection && !params.is_selection())) continue;
    Action action{.title = std::string(kind.title.in(snapshot.language())),
                  .kind = kind.kind,
                  .diagnostics = nullptr,
                  .data = {{"rewrite", i}, {"first", params.first_line()}, {"last", params.last_line()}}};
    if (params.last_line() - params.first_line() < kQuickLines) {
      action.edit = try_rewrite(snapshot, kind.how, params.first_line(), params.last_line());
      if (!action.edit) continue;
    }
    actions.push_back(std::move(action));
  }
}

Json make_rewrite(const Snapshot& snapshot, const Json& data) {
  const std::size_t index = data.at("rewrite");
  if (index >= std::size(kRewriteActions)) refuse("there is no such rewrite");
  auto edit = try_rewrite(snapshot, kRewriteActions[index].how, data.at("first"), data.at("last"));
  if (!edit) refuse(kNotTheSame.in(snapshot.language()));
  return *edit;
}

// --- Rewrites by the formatter

/// The edits of lines `first` to `last` that change more than blanks and letter case.
std::vector<TextEdit> formatted(const Snapshot& snapshot, const ProgramStyle& style, std::size_t first,
                                std::size_t last) {
  const formatting::EachLine each_line = queries::each_line_of(snapshot);
  LinesFormatter formatter(style, each_line);
  if (formatter.obstacle()) refuse(formatter.obstacle()->message(snapshot.language()));
  std::vector<TextEdit> edits;
  std::size_t number = 0;
  each_line([&](const syntax::LineTree& line) {
    const syntax::LineChange change = formatter.next(line);
    const std::size_t at = number++;
    const bool changes = change.motion != syntax::LineChange::MotionEdit::Keep || change.line_number || change.target;
    if (!changes || at < first || at > last) return;
    if (auto edit = queries::line_edit(snapshot, at, formatter.written(line, change)))
      edits.push_back(std::move(*edit));
  });
  return edits;
}

struct StyleAction {
  std::string_view kind;
  Text title;
  ProgramStyle (*style)(const configuration::Format& format);
  bool is_for_all;  ///< Whether the action applies to the whole program, whatever is selected.
};

ProgramStyle numbering(const configuration::Format& format) {
  const auto configured = formatting::style_by(format).numbers;
  return {.numbers = configured.value_or(NumberStyle{})};
}

const StyleAction kStyleActions[] = {
    {"refactor.rewrite.isocnc.modal",
     {"write the motion G on each line", "scrivere la G di movimento su ogni riga"},
     [](const configuration::Format&) { return ProgramStyle{.motions = MotionStyle::Write}; },
     false},
    {"refactor.rewrite.isocnc.modal",
     {"write the motion G only where it changes", "scrivere la G di movimento solo dove cambia"},
     [](const configuration::Format&) { return ProgramStyle{.motions = MotionStyle::Fold}; },
     false},
    {"refactor.rewrite.isocnc.numbers",
     {"renumber the lines, with the labels of GOTO", "rinumerare le righe, con le etichette dei GOTO"},
     numbering,
     true},
};

/// Offers the actions without reading the whole program.
void offer_style_actions(const Snapshot& snapshot, const ActionParams& params, std::vector<Action>& actions) {
  for (std::size_t i = 0; i < std::size(kStyleActions); ++i) {
    const StyleAction& style_action = kStyleActions[i];
    if (!params.wants(style_action.kind)) continue;
    const bool is_for_all = style_action.is_for_all || !params.is_selection();
    const std::size_t last = is_for_all ? snapshot.document().line_count() - 1 : params.last_line();
    actions.push_back({.title = std::string(style_action.title.in(snapshot.language())),
                       .kind = style_action.kind,
                       .diagnostics = nullptr,
                       .data = {{"style", i}, {"first", is_for_all ? 0 : params.first_line()}, {"last", last}}});
  }
}

Json make_styling(const Snapshot& snapshot, const Json& data) {
  static constexpr Text kNothing = {"there is nothing to change", "non c'è niente da cambiare"};
  const std::size_t index = data.at("style");
  if (index >= std::size(kStyleActions)) refuse("there is no such style");
  const ProgramStyle style = kStyleActions[index].style(snapshot.configuration().format);
  const std::vector<TextEdit> edits = formatted(snapshot, style, data.at("first"), data.at("last"));
  if (edits.empty()) refuse(kNothing.in(snapshot.language()));
  return queries::workspace_edit(snapshot, edits);
}

struct NoParams {};
void from_json(const Json&, NoParams&) {}

Json renumber(const Snapshot& snapshot, const NoParams&) {
  const ProgramStyle style = numbering(snapshot.configuration().format);
  return {
      {"edit", queries::workspace_edit(snapshot, formatted(snapshot, style, 0, snapshot.document().line_count() - 1))}};
}

}  // namespace

extern const Feature rewrites = {
    .commands = {on<&renumber>("isocnc.renumber")},
    .actions = {{.kind = "refactor.rewrite", .offer = offer_rewrites, .edit = make_rewrite},
                {.kind = "refactor.rewrite", .offer = offer_style_actions, .edit = make_styling}}};

}  // namespace isocnc::features
