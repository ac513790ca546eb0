#include "debugger/expressions/expression.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include "debugger/expressions/read_number.h"
#include "interpreter/dialect/format.h"
#include "interpreter/text/characters.h"
#include "interpreter/text/unicode.h"

namespace isocnc::expressions {

using dialect::Language;
using dialect::Text;

/// Maximum depth of nesting, which bounds the stack of an evaluation, too.
static constexpr std::size_t kMaxDepth = 64;

static bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }

static bool is_true(double value) { return value != 0 && !std::isnan(value); }

static constexpr Text kColumn{"column {}: {}", "colonna {}: {}"};
static constexpr Text kNothing{"a value is missing here", "qui manca un valore"};
static constexpr Text kNoSuchName{"there is nothing called {}", "non c'è niente che si chiami {}"};
static constexpr Text kNoSense{"{} has no meaning here", "{} qui non ha senso"};
static constexpr Text kUnclosed{"this parenthesis is not closed", "questa parentesi non è chiusa"};
static constexpr Text kTooDeep{"this nests too deeply", "troppi livelli di parentesi"};
static constexpr Text kBadFormat{"a format is x (hexadecimal) or a number of decimals, 0 to {}, not {}",
                                 "un formato è x (esadecimale) o un numero di decimali, da 0 a {}, non {}"};

/// Recursive descent, up to the first mistake.
class ExpressionCompiler {
 public:
  ExpressionCompiler(std::string_view text, Language language) : text_(text), language_(language) {}

  std::variant<Expression, ExpressionProblem> compile() {
    parse(0, 0);
    skip_blanks();
    if (!problem_ && at_ < text_.size()) fail(at_, no_sense());
    if (problem_) return *problem_;
    return std::move(result_);
  }

 private:
  using Operation = Expression::Operation;

  struct Operator {
    std::string_view sign;
    Operation operation;
    int rank;  ///< Greater for an operator that binds more tightly.
  };
  /// A sign that begins another one stands after it.
  static constexpr std::array<Operator, 14> kOperators{{{"||", Operation::Or, 1},
                                                        {"&&", Operation::And, 2},
                                                        {"==", Operation::Equal, 3},
                                                        {"!=", Operation::NotEqual, 3},
                                                        {"<>", Operation::NotEqual, 3},
                                                        {"<=", Operation::LessEqual, 4},
                                                        {">=", Operation::GreaterEqual, 4},
                                                        {"<", Operation::Less, 4},
                                                        {">", Operation::Greater, 4},
                                                        {"=", Operation::Equal, 3},
                                                        {"+", Operation::Add, 5},
                                                        {"-", Operation::Subtract, 5},
                                                        {"*", Operation::Multiply, 6},
                                                        {"/", Operation::Divide, 6}}};

  void fail(std::size_t at, const std::string& message) {
    if (problem_) return;
    problem_ = ExpressionProblem{dialect::format(kColumn, language_, text::column_of(text_, at), message)};
  }
  std::string message(const Text& text, std::string_view what) const {
    return dialect::format(text, language_, text::printable(what));
  }
  std::string no_sense() const {
    const std::string_view rest = text_.substr(at_);
    return message(kNoSense, rest.substr(0, std::max<std::size_t>(1, text::sequence_length(rest))));
  }

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  const Operator* next_operator() {
    skip_blanks();
    const std::string_view rest = text_.substr(at_);
    for (const Operator& each : kOperators)
      if (rest.starts_with(each.sign)) return &each;
    return nullptr;
  }

  /// Operands and operators of at least this rank.
  void parse(int min_rank, std::size_t depth) {
    parse_operand(depth);
    while (!problem_) {
      const Operator* const next = next_operator();
      if (next == nullptr || next->rank < min_rank) return;
      at_ += next->sign.size();
      parse(next->rank + 1, depth + 1);
      add({.operation = next->operation});
    }
  }

  void parse_operand(std::size_t depth) {
    skip_blanks();
    if (depth > kMaxDepth) return fail(at_, std::string(kTooDeep.in(language_)));
    if (at_ == text_.size()) return fail(at_, std::string(kNothing.in(language_)));
    const char c = text_[at_];
    if (c == '(') return parse_parenthesis(depth);
    if (c == '-' || c == '!' || c == '+') {
      ++at_;
      parse_operand(depth + 1);
      if (c != '+') add({.operation = c == '-' ? Operation::Negate : Operation::Not});
      return;
    }
    if (is_letter(c)) return parse_name();
    if (text::is_digit(c) || c == '.') return parse_number();
    fail(at_, no_sense());
  }

  void parse_parenthesis(std::size_t depth) {
    const std::size_t open = at_++;
    parse(0, depth + 1);
    skip_blanks();
    if (problem_) return;
    if (at_ == text_.size()) return fail(open, std::string(kUnclosed.in(language_)));
    if (text_[at_] != ')') return fail(at_, no_sense());
    ++at_;
  }

  void parse_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || text::is_digit(text_[at_]))) ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    const Quantity* const quantity = find_quantity(name);
    if (quantity == nullptr) return fail(begin, message(kNoSuchName, name));
    add({.operation = Operation::Read, .quantity = quantity});
  }

  void parse_number() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (text::is_digit(text_[at_]) || text_[at_] == '.')) ++at_;
    double value = 0;
    const char* const end = text_.data() + at_;
    const auto [rest, error] =
        fast_float::from_chars(text_.data() + begin, end, value, fast_float::chars_format::fixed);
    if (error != std::errc{} || rest != end || std::isinf(value))
      return fail(begin, message(kNoSense, text_.substr(begin, at_ - begin)));
    add({.operation = Operation::Number, .number = value});
  }

  void add(const Expression::StackInstruction& instruction) { result_.code_.push_back(instruction); }

  std::string_view text_;
  Language language_;
  std::size_t at_ = 0;
  Expression result_;
  std::optional<ExpressionProblem> problem_;
};

std::variant<Expression, ExpressionProblem> Expression::compile(std::string_view text, Language language) {
  return ExpressionCompiler(text, language).compile();
}

double Expression::apply(Operation operation, double left, double right) {
  switch (operation) {
    case Operation::Add:
      return left + right;
    case Operation::Subtract:
      return left - right;
    case Operation::Multiply:
      return left * right;
    case Operation::Divide:
      return left / right;
    case Operation::Less:
      return left < right;
    case Operation::LessEqual:
      return left <= right;
    case Operation::Greater:
      return left > right;
    case Operation::GreaterEqual:
      return left >= right;
    case Operation::Equal:
      return left == right;
    case Operation::NotEqual:
      return left != right && !std::isnan(left) && !std::isnan(right);
    case Operation::And:
      return is_true(left) && is_true(right);
    default:
      return is_true(left) || is_true(right);
  }
}

double Expression::at(const Moment& moment) const {
  // At most one operand waits for each level of nesting and each rank of operators.
  std::array<double, 2 * kMaxDepth + 16> stack{};
  std::size_t size = 0;
  for (const StackInstruction& each : code_) {
    switch (each.operation) {
      case Operation::Number:
        stack[size++] = each.number;
        break;
      case Operation::Read:
        stack[size++] = each.quantity->at(moment);
        break;
      case Operation::Negate:
        stack[size - 1] = -stack[size - 1];
        break;
      case Operation::Not:
        stack[size - 1] = !is_true(stack[size - 1]);
        break;
      default:
        --size;
        stack[size - 1] = apply(each.operation, stack[size - 1], stack[size]);
    }
  }
  return stack[0];
}

bool Expression::holds_at(const Moment& moment) const { return is_true(at(moment)); }

const Quantity* Expression::sole_quantity() const { return code_.size() == 1 ? code_.front().quantity : nullptr; }

bool Expression::is_constant() const {
  return std::all_of(code_.begin(), code_.end(), [](const auto& each) { return each.quantity == nullptr; });
}

bool Expression::reads_depth() const {
  return std::any_of(code_.begin(), code_.end(), [](const StackInstruction& each) {
    return each.quantity && each.quantity->limited == debuggee::LimitedQuantity::Depth;
  });
}

bool Expression::reads_surroundings() const {
  return std::any_of(code_.begin(), code_.end(),
                     [](const auto& each) { return each.quantity != nullptr && each.quantity->limited.has_value(); });
}

/// What follows the comma: `x`, `2`. None where it is no format.
static std::optional<ValueFormat> read_format(std::string_view text, ValueFormat format) {
  if (text == "x" || text == "X" || text == "h") {
    format.is_hexadecimal = true;
    return format;
  }
  const auto decimals = read_number<int>(text);
  if (!decimals || *decimals < 0 || *decimals > ValueFormat::kMaxDecimals) return std::nullopt;
  return ValueFormat{.is_hexadecimal = false, .decimals = *decimals, .keeps_zeros = true};
}

std::variant<Expression::Formatted, ExpressionProblem> compile_formatted(std::string_view text,
                                                                         const ValueFormat& format, Language language) {
  const std::size_t comma = text.rfind(',');
  auto compiled = Expression::compile(text.substr(0, comma), language);
  if (const auto* const problem = std::get_if<ExpressionProblem>(&compiled)) return *problem;
  Expression::Formatted result{std::get<Expression>(std::move(compiled)), format};
  if (comma == std::string_view::npos) return result;
  std::string_view written = text.substr(comma + 1);
  while (written.starts_with(' ')) written.remove_prefix(1);
  while (written.ends_with(' ')) written.remove_suffix(1);
  const auto read = read_format(written, format);
  if (!read)
    return ExpressionProblem{
        dialect::format(kColumn, language, text::column_of(text, comma + 1),
                        dialect::format(kBadFormat, language, ValueFormat::kMaxDecimals, text::printable(written)))};
  result.format = *read;
  return result;
}

std::string show_value(double value, const ValueFormat& format) {
  constexpr double kMaxInteger = 9007199254740992.0;  // Larger doubles skip integers.
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value < 0 ? "-∞" : "∞";
  if (format.is_hexadecimal && value == std::floor(value) && std::abs(value) < kMaxInteger)
    return fmt::format("{}0x{:X}", value < 0 ? "-" : "", static_cast<std::uint64_t>(std::abs(value)));
  if (!format.keeps_zeros) return dialect::written_number(value, format.decimals);
  const std::string text = fmt::format("{:.{}f}", value, format.decimals);
  return text == "-0" ? "0" : text;
}

}  // namespace isocnc::expressions
