#include "debugger/expressions/watched_value.h"

#include <cmath>

#include "interpreter/text/characters.h"

namespace isocnc::expressions {

/// The value of a formula that asks for nothing but numbers.
static double constant(const Expression& expression) {
  static const execution::State kState;
  static const running::Registers kRegisters{};
  return expression.at({.state = kState, .registers = kRegisters});
}

static constexpr dialect::Text kNeedsLimit{
    "CLEARANCE, DEPTH and REMOVED change all along a path: watch a limit, as CLEARANCE < 5",
    "CLEARANCE, DEPTH e REMOVED cambiano lungo tutto il percorso: sorvegliare un limite, come CLEARANCE < 5"};

/// The limit of the surroundings that something is, whose value begins before `sign`. None for what is no limit.
static std::optional<debuggee::SurroundingsLimit> read_limit(std::string_view text, std::size_t sign,
                                                             dialect::Language language) {
  if (sign + 1 == text.size()) return std::nullopt;
  const std::size_t right = text[sign + 1] == '=' ? sign + 2 : sign + 1;
  const auto quantity = Expression::compile(text.substr(0, sign), language);
  const auto value = Expression::compile(text.substr(right), language);
  if (!std::holds_alternative<Expression>(quantity) || !std::holds_alternative<Expression>(value)) return std::nullopt;
  const Quantity* const watched = std::get<Expression>(quantity).sole_quantity();
  const auto& number = std::get<Expression>(value);
  if (watched == nullptr || !watched->limited || !number.is_constant()) return std::nullopt;
  const double limit = constant(number);
  if (!std::isfinite(limit)) return std::nullopt;
  if (text[sign] != '=')
    return debuggee::SurroundingsLimit{.of = *watched->limited, .is_from_below = text[sign] == '>', .value = limit};
  // Equal to one of two values is beyond what is between them.
  if (watched->limited != debuggee::LimitedQuantity::InCut || (limit != 0 && limit != 1)) return std::nullopt;
  return debuggee::SurroundingsLimit{.of = *watched->limited, .is_from_below = limit == 1, .value = 0.5};
}

/// `CLEARANCE < 5`, `INCUT = 1`, `INCUT`. None for what is no limit of the surroundings.
static std::optional<debuggee::SurroundingsLimit> read_limit(std::string_view text, const Expression& whole,
                                                             dialect::Language language) {
  const Quantity* const watched = whole.sole_quantity();
  const std::size_t sign = text.find_first_of("<>=");
  if (sign != std::string_view::npos) return read_limit(text, sign, language);
  if (watched == nullptr || watched->limited != debuggee::LimitedQuantity::InCut) return std::nullopt;
  return debuggee::SurroundingsLimit{.of = *watched->limited, .is_either_way = true};
}

std::variant<WatchedValue, ExpressionProblem> WatchedValue::compile(std::string_view text, dialect::Language language) {
  const std::size_t equals = text.find('=');
  const bool has_threshold = equals != std::string_view::npos && equals > 0 &&
                             std::string_view("<>!").find(text[equals - 1]) == std::string_view::npos;
  auto value = Expression::compile(has_threshold ? text.substr(0, equals) : text, language);
  if (const auto* const problem = std::get_if<ExpressionProblem>(&value)) return *problem;
  WatchedValue result;
  result.value = std::get<Expression>(std::move(value));
  result.name = text::trimmed(text);
  if (result.value.reads_surroundings()) {
    result.limit = read_limit(text, result.value, language);
    if (!result.limit) return ExpressionProblem{std::string(kNeedsLimit.in(language))};
  }
  if (!has_threshold || result.limit) return result;
  const std::size_t right = text.find_first_not_of('=', equals);
  const auto threshold = Expression::compile(right == std::string_view::npos ? "" : text.substr(right), language);
  if (const auto* const problem = std::get_if<ExpressionProblem>(&threshold)) return *problem;
  result.threshold = constant(std::get<Expression>(threshold));
  return result;
}

bool WatchedValue::is_change(double before, double after) const {
  if (std::isnan(before) && std::isnan(after)) return false;
  if (!threshold) return !(before == after);
  const double from = before - *threshold;
  const double to = after - *threshold;
  return (from < 0 && to >= 0) || (from > 0 && to <= 0) || (from != 0 && to == 0);
}

/// Between the ends of the trail only what is known counts.
std::optional<std::pair<double, double>> WatchedValue::find_change(const ValueTrail& trail, std::size_t place) const {
  if (limit) return std::nullopt;
  const std::size_t last = trail.values.size() - trail.width + place;
  const double start = trail.values[place];
  double before = start;
  for (std::size_t i = threshold ? place + trail.width : last; i <= last; i += trail.width) {
    const double after = trail.values[i];
    if (std::isnan(after) && i != last) continue;
    if (is_change(before, after)) return std::pair(start, after);
    before = after;
  }
  return std::nullopt;
}

}  // namespace isocnc::expressions
