#include "debugger/session/breakpoints.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "debugger/session/block_effect.h"
#include "interpreter/dialect/format.h"
#include "interpreter/syntax/characters.h"

namespace isocnc::debugger::session {

using dialect::Language;

static std::string_view trimmed(std::string_view text) {
  while (!text.empty() && syntax::is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && syntax::is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Digits and nothing else.
template <class Number>
static std::optional<Number> read_number(std::string_view digits) {
  Number number = 0;
  const char* const end = digits.data() + digits.size();
  const auto [behind, error] = std::from_chars(digits.data(), end, number);
  if (digits.empty() || error != std::errc{} || behind != end) return std::nullopt;
  return number;
}

std::optional<HitCondition> HitCondition::read(std::string_view text) {
  static constexpr std::pair<std::string_view, Kind> kSigns[] = {
      {">=", Kind::GreaterEqual}, {"<=", Kind::LessEqual}, {"==", Kind::Equal}, {">", Kind::Greater},
      {"<", Kind::Less},          {"=", Kind::Equal},      {"%", Kind::Every}};
  text = trimmed(text);
  HitCondition condition;
  for (const auto& [sign, kind] : kSigns) {
    if (!text.starts_with(sign)) continue;
    condition.kind_ = kind;
    text = trimmed(text.substr(sign.size()));
    break;
  }
  const auto count = read_number<std::uint64_t>(text);
  if (!count || (condition.kind_ == Kind::Every && *count == 0)) return std::nullopt;
  condition.count_ = *count;
  return condition;
}

bool HitCondition::admits(std::uint64_t hit) const {
  switch (kind_) {
    case Kind::Equal:
      return hit == count_;
    case Kind::Less:
      return hit < count_;
    case Kind::LessEqual:
      return hit <= count_;
    case Kind::Greater:
      return hit > count_;
    case Kind::GreaterEqual:
      return hit >= count_;
    case Kind::Every:
      return hit % count_ == 0;
  }
  return false;
}

std::variant<LogMessage, ExpressionProblem> LogMessage::compile(std::string_view text, const ValueFormat& format,
                                                                Language language) {
  static constexpr dialect::Text kUnclosed{"{{ has no }} behind it", "a {{ non segue una }}"};
  LogMessage result;
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if ((c == '{' || c == '}') && i + 1 < text.size() && text[i + 1] == c) {
      plain += c;
      ++i;
      continue;
    }
    if (c != '{') {
      plain += c;
      continue;
    }
    const std::size_t close = text.find('}', i);
    if (close == std::string_view::npos) return ExpressionProblem{dialect::format(kUnclosed, language)};
    auto compiled = compile_formatted(text.substr(i + 1, close - i - 1), format, language);
    if (const auto* const problem = std::get_if<ExpressionProblem>(&compiled)) return *problem;
    result.pieces_.push_back({std::exchange(plain, {}), std::get<Expression::Formatted>(std::move(compiled))});
    i = close;
  }
  if (!plain.empty()) result.pieces_.push_back({std::move(plain), std::nullopt});
  return result;
}

std::string LogMessage::at(const Moment& moment) const {
  std::string text;
  for (const Piece& piece : pieces_) {
    text += piece.text;
    if (piece.value) text += show_value(piece.value->expression.at(moment), piece.value->format);
  }
  return text;
}

std::uint64_t HitCounter::count(std::uint64_t block) {
  const auto place = std::lower_bound(blocks_.begin(), blocks_.end(), block);
  const auto number = static_cast<std::uint64_t>(place - blocks_.begin()) + 1;
  if (place == blocks_.end() || *place != block) blocks_.insert(place, block);
  return number;
}

void HitCounter::forget_from(std::uint64_t block) {
  blocks_.erase(std::lower_bound(blocks_.begin(), blocks_.end(), block), blocks_.end());
}

std::optional<WantedCode> WantedCode::read(std::string_view name) {
  name = trimmed(name);
  if (name.size() < 2) return std::nullopt;
  const char letter = syntax::upper(name.front());
  const auto number = read_number<std::uint32_t>(trimmed(name.substr(1)));
  if (!number || (letter != 'G' && letter != 'M' && letter != 'T')) return std::nullopt;
  if (*number > (letter == 'T' ? 999999u : 999u)) return std::nullopt;
  return WantedCode{letter, *number};
}

bool WantedCode::is_in(const syntax::LineTree& tree) const {
  return std::any_of(tree.words.begin(), tree.words.end(), [&](const syntax::Word& word) {
    return word.letter == letter && word.value == static_cast<double>(number);
  });
}

std::variant<Watched, ExpressionProblem> Watched::compile(std::string_view text, Language language) {
  const std::size_t equals = text.find('=');
  const bool has_threshold = equals != std::string_view::npos && equals > 0 &&
                             std::string_view("<>!").find(text[equals - 1]) == std::string_view::npos;
  const std::string_view left = has_threshold ? text.substr(0, equals) : text;
  auto value = Expression::compile(left, language);
  if (const auto* const problem = std::get_if<ExpressionProblem>(&value)) return *problem;
  Watched result{.value = std::get<Expression>(std::move(value)), .name = std::string(trimmed(text)), .threshold = {}};
  if (!has_threshold) return result;
  const std::size_t behind = text.find_first_not_of('=', equals);
  const auto threshold = Expression::compile(behind == std::string_view::npos ? "" : text.substr(behind), language);
  if (const auto* const problem = std::get_if<ExpressionProblem>(&threshold)) return *problem;
  static const execution::State kState;
  static const running::Registers kRegisters{};
  result.threshold = std::get<Expression>(threshold).at({.state = kState, .registers = kRegisters});
  return result;
}

bool Watched::tells(double before, double after) const {
  if (std::isnan(before) && std::isnan(after)) return false;
  if (!threshold) return !(before == after);
  const double from = before - *threshold;
  const double to = after - *threshold;
  return (from < 0 && to >= 0) || (from > 0 && to <= 0) || (from != 0 && to == 0);
}

static bool are_same(const FunctionBreakpoint& a, const FunctionBreakpoint& b) { return a.code == b.code; }
static bool are_same(const DataBreakpoint& a, const DataBreakpoint& b) { return a.watched.name == b.watched.name; }

template <class Some>
static void go_on_counting(std::vector<Some>& breakpoints, std::vector<Some>& before) {
  for (Some& breakpoint : breakpoints) {
    const auto old = std::find_if(before.begin(), before.end(), [&](const Some& each) {
      return are_same(each, breakpoint) && each.rules.text == breakpoint.rules.text;
    });
    if (old != before.end()) std::swap(breakpoint.counter, old->counter);
  }
}

void Breakpoints::set_functions(std::vector<FunctionBreakpoint> breakpoints) {
  go_on_counting(breakpoints, functions_);
  functions_ = std::move(breakpoints);
}

void Breakpoints::set_data(std::vector<DataBreakpoint> breakpoints) {
  go_on_counting(breakpoints, data_);
  data_ = std::move(breakpoints);
}

bool Breakpoints::has_thresholds() const {
  return std::any_of(data_.begin(), data_.end(), [](const auto& each) { return each.watched.threshold.has_value(); });
}

void Breakpoints::set_lines(std::vector<LineBreakpoint> breakpoints, std::uint64_t line_count) {
  for (LineBreakpoint& breakpoint : breakpoints) {
    const auto [begin, end] = lines_.equal_range(breakpoint.line);
    const auto old =
        std::find_if(begin, end, [&](const auto& each) { return each.second.rules.text == breakpoint.rules.text; });
    if (old != end) std::swap(breakpoint.counter, old->second.counter);
  }
  lines_.clear();
  bits_.assign(line_count / 64 + 1, 0);
  for (LineBreakpoint& breakpoint : breakpoints) {
    const std::uint64_t line = breakpoint.line;
    if (line >= line_count) continue;
    bits_[line / 64] |= std::uint64_t{1} << (line % 64);
    lines_.emplace(line, std::move(breakpoint));
  }
}

void Breakpoints::reach(Breakpoint& breakpoint, const Moment& moment, std::uint64_t block, Direction direction,
                        Outcome& outcome) {
  const BreakpointRules& rules = breakpoint.rules;
  if (rules.condition && !rules.condition->holds_at(moment)) return;
  if (direction == Direction::Backward && rules.message) return;
  if (rules.hits && !rules.hits->admits(breakpoint.counter.count(block))) return;
  if (rules.message) {
    outcome.messages.push_back(rules.message->at(moment));
  } else {
    outcome.stopped.push_back(breakpoint.id);
  }
}

void Breakpoints::judge_line(const Moment& moment, std::uint64_t block, Direction direction, Outcome& outcome) {
  const auto [begin, end] = lines_.equal_range(moment.line);
  for (auto each = begin; each != end; ++each) reach(each->second, moment, block, direction, outcome);
}

void Breakpoints::judge_functions(const syntax::LineTree& tree, const Moment& moment, std::uint64_t block,
                                  Direction direction, Outcome& outcome) {
  for (FunctionBreakpoint& each : functions_)
    if (each.code.is_in(tree)) reach(each, moment, block, direction, outcome);
}

void Breakpoints::start_trail(const Moment& moment, Trail& trail) const {
  trail.width = data_.size();
  trail.values.clear();
  read_data(moment, trail);
}

void Breakpoints::read_data(const Moment& moment, Trail& trail) const {
  for (const DataBreakpoint& each : data_) trail.values.push_back(each.watched.value.at(moment));
}

void Breakpoints::read_arc(const BlockEffect& effect, const Moment& moment, Trail& trail) const {
  if (effect.has_error) return;
  execution::State state = effect.state;
  for (const geometry::Pose& point : effect.on_arc) {
    state.position = point;
    read_data({.state = state,
               .registers = effect.registers,
               .vgpl = moment.vgpl,
               .line = moment.line,
               .override_percent = moment.override_percent,
               .playback = moment.playback},
              trail);
  }
}

/// From what to what a value has come when it told. On the way only what is known counts.
std::optional<std::pair<double, double>> Breakpoints::find_change(const Watched& watched, std::size_t place,
                                                                  const Trail& trail) {
  if (!watched.threshold) {
    const double before = trail.values[place];
    const double after = trail.values[trail.values.size() - trail.width + place];
    if (watched.tells(before, after)) return std::pair(before, after);
    return std::nullopt;
  }
  double before = trail.values[place];
  for (std::size_t i = place + trail.width; i < trail.values.size(); i += trail.width) {
    const double after = trail.values[i];
    const bool is_last = i + trail.width >= trail.values.size();
    if (std::isnan(after) && !is_last) continue;
    if (watched.tells(before, after)) return std::pair(trail.values[place], after);
    before = after;
  }
  return std::nullopt;
}

void Breakpoints::judge_data(const Trail& trail, const Moment& moment, std::uint64_t block, Direction direction,
                             Outcome& outcome) {
  // Others may have been set meanwhile.
  if (data_.empty() || trail.width != data_.size() || trail.values.size() % trail.width != 0) return;
  for (std::size_t i = 0; i < data_.size(); ++i)
    if (find_change(data_[i].watched, i, trail)) reach(data_[i], moment, block, direction, outcome);
}

std::string Breakpoints::description(std::int64_t id, const Trail& trail) const {
  for (std::size_t i = 0; i < data_.size() && i < trail.width; ++i) {
    if (data_[i].id != id) continue;
    if (const auto change = find_change(data_[i].watched, i, trail))
      return fmt::format("{}: {} -> {}", data_[i].watched.name, show_value(change->first), show_value(change->second));
  }
  return {};
}

void Breakpoints::forget_hits_from(std::uint64_t block) {
  for (auto& [line, breakpoint] : lines_) breakpoint.counter.forget_from(block);
  for (FunctionBreakpoint& each : functions_) each.counter.forget_from(block);
  for (DataBreakpoint& each : data_) each.counter.forget_from(block);
}

}  // namespace isocnc::debugger::session
