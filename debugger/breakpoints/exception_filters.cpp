#include "debugger/breakpoints/exception_filters.h"

#include <algorithm>
#include <cmath>

#include "analyzer/explain.h"
#include "debugger/debuggee/block_effect.h"
#include "debugger/expressions/expression.h"
#include "interpreter/dialect/format.h"
#include "interpreter/kinematics/travel.h"
#include "interpreter/simulation/run_findings.h"
#include "interpreter/verification/verification_report.h"

namespace isocnc::breakpoints {

using dialect::Language;
using dialect::Text;

bool ExceptionFilters::judge_blocks() const {
  return is_on(ExceptionFilter::ToolChange) || is_on(ExceptionFilter::FirstCut) ||
         (is_on(ExceptionFilter::Warnings) && !warnings.empty()) || (is_on(ExceptionFilter::Run) && !of_run.empty());
}

bool ExceptionFilters::judge_motions(const timing::TimedMachine& machine) const {
  const auto& axes = machine.motion.axes;
  return is_on(ExceptionFilter::Limits) && std::any_of(axes.begin(), axes.end(), [](const auto& axis) {
           return std::isfinite(axis.minimum) || std::isfinite(axis.maximum);
         });
}

namespace {

constexpr Text kBeyondTravel{"axis {} would go to {}, beyond its travel, which ends at {}{}",
                             "l'asse {} andrebbe a {}, oltre la corsa, che finisce a {}{}"};
constexpr Text kAnyToolChange{"tool change", "cambio utensile"};
constexpr Text kFirstCut{"first feed move of this tool", "primo movimento in lavoro di questo utensile"};

/// An exception whose code is the filter's name.
Exception exception_of(ExceptionFilter filter, std::string message) {
  return {
      .filter = filter, .code = std::string(definition(filter).name), .message = std::move(message), .explanation = {}};
}

}  // namespace

std::optional<Exception> find_overtravel(const kinematics::Move& move, const timing::TimedMachine& machine,
                                         bool is_in_inches, Language language) {
  const auto found = kinematics::overtravels(machine.motion, move);
  if (found.empty()) return std::nullopt;
  const kinematics::Overtravel& first = found.front();
  const syntax::Finding told = simulation::travel_finding(first, is_in_inches);
  return exception_of(ExceptionFilter::Limits,
                      dialect::format(kBeyondTravel, language, dialect::kAxisLetters[first.axis],
                                      expressions::show_value(told.values[1]), expressions::show_value(told.values[2]),
                                      dialect::inches_note(told.is_in_inches, language)));
}

bool ExceptionFilters::counts(ExceptionFilter filter, const expressions::Moment& before) const {
  if (!is_on(filter)) return false;
  const auto& condition = conditions_[static_cast<std::size_t>(filter)];
  return !condition || condition->holds_at(before);
}

/// The first of the findings on the line of a block.
static std::optional<Exception> find_finding(ExceptionFilter filter, const std::multimap<std::size_t, Warning>& all,
                                             const running::Block& block, Language language) {
  const auto found = all.find(block.line);
  if (found == all.end()) return std::nullopt;
  return Exception{.filter = filter,
                   .code = std::string(dialect::definition(found->second.id).code),
                   .message = found->second.message,
                   .explanation = analyzer::explain(found->second.id, language)};
}

static bool is_first_cut(const running::Block& block, const debuggee::BlockEffect& effect) {
  return block.is_tool_unused && std::any_of(effect.moves.begin(), effect.moves.end(),
                                             [](const auto& move) { return move.kind != execution::MoveKind::Rapid; });
}

std::optional<Exception> ExceptionFilters::find_contact(const verification::Contact& contact,
                                                        const expressions::Moment& at, Language language) const {
  if (!counts(ExceptionFilter::Contacts, at)) return std::nullopt;
  return Exception{.filter = ExceptionFilter::Contacts,
                   .code = std::string(dialect::definition(contact.id).code),
                   .message = verification::in_words(contact, language),
                   .explanation = analyzer::explain(contact.id, language)};
}

std::optional<Exception> ExceptionFilters::find_exception(const running::Block& block,
                                                          const expressions::Moment& before,
                                                          const execution::Setup& setup, Language language) const {
  using enum ExceptionFilter;
  for (const auto& [filter, findings] : {std::pair(Run, &of_run), std::pair(Warnings, &warnings)})
    if (counts(filter, before))
      if (auto found = find_finding(filter, *findings, block, language)) return found;
  if (counts(ToolChange, before) && debuggee::changes_tool(block))
    return exception_of(ToolChange, std::string(kAnyToolChange.in(language)));
  if (!counts(FirstCut, before)) return std::nullopt;
  const debuggee::BlockEffect effect = debuggee::effect_of(block, setup);
  if (effect.has_error || !is_first_cut(block, effect)) return std::nullopt;
  return exception_of(FirstCut, std::string(kFirstCut.in(language)));
}

}  // namespace isocnc::breakpoints
