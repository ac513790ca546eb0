#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "analyzer/fixes/habits.h"
#include "analyzer/fixes/line_edits.h"
#include "interpreter/dialect/format.h"
#include "interpreter/text/characters.h"
#include "interpreter/text/unicode.h"

namespace isocnc::fixes {

using syntax::Instruction;
using syntax::Span;
using syntax::Word;

static bool is_letter_o(char c) { return text::upper(c) == 'O'; }

static bool holds_only(std::string_view text, std::string_view characters) {
  return text.find_first_not_of(characters) == std::string_view::npos;
}

/// Replaces the marked text.
static Draft rewritten(const FixRequest& request, std::string text) {
  Draft draft{{replaced(request, request.finding.span, text)}};
  draft.what = std::move(text);
  return draft;
}

/// MO6 and X1O: the finding is at the M, or at the O after the number.
Draft zero_for_letter_o(const FixRequest& request) {
  const std::string_view line = request.line.text;
  Span zeros = request.finding.span;
  const bool follows_number = is_letter_o(line[zeros.begin]);
  if (follows_number) {
    const bool continues = zeros.begin > 0 && (text::is_digit(line[zeros.begin - 1]) || line[zeros.begin - 1] == '.');
    if (!continues || !holds_only(request.marked(), "Oo0123456789.")) return {};
  } else {
    if (request.marked().size() != 1) return {};
    zeros.begin = zeros.end;
  }
  zeros.end = zeros.begin;
  while (zeros.end < line.size() && is_letter_o(line[zeros.end])) ++zeros.end;
  if (zeros.empty()) return {};
  return {{replaced(request, zeros, std::string(zeros.end - zeros.begin, '0'))}};
}

/// 10,5. Numbers with thousands separators are left to the author: 1.000,5, and 1,500 if the program has 2,000.5.
Draft point_for_comma(const FixRequest& request) {
  std::string text(request.marked());
  if (!holds_only(text, "0123456789,+- \t")) return {};
  if (std::count(text.begin(), text.end(), ',') != 1) return {};
  const auto after =
      std::count_if(text.begin() + static_cast<std::ptrdiff_t>(text.find(',')), text.end(), text::is_digit);
  if (after == 3 && request.program.habits().separates_thousands()) return {};
  std::replace(text.begin(), text.end(), ',', '.');
  return rewritten(request, std::move(text));
}

/// G1.0 becomes G1, G-91 becomes G91. Also for M, N, T and V.
Draft whole_number(const FixRequest& request) {
  const std::string_view text = request.marked();
  const char letter = text::upper(text.front());
  std::string_view number = text::trimmed(text.substr(1));
  if (!number.empty() && (number.front() == '-' || number.front() == '+')) number.remove_prefix(1);
  const std::size_t point = std::min(number.find('.'), number.size());
  const std::string_view digits = number.substr(0, point);
  if (digits.empty() || !holds_only(digits, "0123456789") || !holds_only(number.substr(point), ".0")) return {};
  if (std::count(number.begin(), number.end(), '.') > 1 || digits.size() == text.size() - 1) return {};
  int value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_known_g = letter != 'G' || dialect::g_code(static_cast<std::size_t>(value)) != nullptr;
  if (!is_known_g || (letter == 'M' && value == 0) || (letter == 'T' && digits.size() != 6)) return {};
  return rewritten(request, std::string(1, text.front()) + std::string(digits));
}

/// X-30 with a minus or a dash from a text processor (D67).
Draft plain_minus(const FixRequest& request) {
  const auto length = static_cast<std::uint32_t>(text::foreign_minus_length(request.marked()));
  if (length == 0) return {};
  const std::uint32_t begin = request.finding.span.begin;
  return {{replaced(request, {begin, begin + length}, "-")}};
}

Draft without_sign(const FixRequest& request) {
  std::string text(request.marked());
  const std::size_t minus = text.find('-');
  if (minus == std::string::npos || text.find('(') != std::string::npos) return {};
  text.erase(minus, 1);
  return rewritten(request, std::move(text));
}

/// X=5, which other controls accept.
Draft without_equals(const FixRequest& request) {
  const std::string_view line = request.line.text;
  const std::uint32_t at = request.finding.span.begin;
  const std::string_view before = text::trimmed(line.substr(0, at));
  const std::string_view after = text::trimmed(line.substr(at + 1));
  if (before.empty() || text::char_class(before.back()) != text::CharClass::Letter) return {};
  if (after.empty() || !text::is_number_char(after.front())) return {};
  return {{replaced(request, {at, at + 1}, {})}};
}

/// C270 is the same direction as C-90.
Draft angle_in_range(const FixRequest& request) {
  const double angle = std::remainder(request.finding.values[0], 360);
  if (!(std::abs(angle) <= request.finding.values[1]) || request.marked().find('(') != std::string_view::npos)
    return {};
  return rewritten(request, request.marked().front() + dialect::written_number(angle, decimals_of(request.marked())));
}

Draft comparison(const FixRequest& request) {
  static constexpr std::pair<std::string_view, std::string_view> kMeant[] = {
      {"==", "="}, {"=<", "<="}, {"=>", ">="}, {"!=", "<>"}, {"><", "<>"}};
  for (const auto& [text, meant] : kMeant)
    if (request.marked() == text) return rewritten(request, std::string(meant));
  return {};
}

/// GOTO 30: adds the N.
Draft label_with_letter(const FixRequest& request) {
  const std::string_view before = text::trimmed(request.line.text.substr(0, request.finding.span.begin));
  const bool is_label = !before.empty() && is_letter_o(before.back()) && request.line.jump != nullptr;
  if (!is_label || !holds_only(request.marked(), "0123456789")) return {};
  return rewritten(request, "N" + std::string(request.marked()));
}

/// GOTO N4O: the letter O for a zero.
Draft label_with_zeros(const FixRequest& request) {
  std::string text(request.marked());
  if (text::upper(text.front()) != 'N' || !holds_only(std::string_view(text).substr(1), "0123456789Oo")) return {};
  std::replace_if(text.begin(), text.end(), is_letter_o, '0');
  return text == request.marked() ? Draft{} : rewritten(request, std::move(text));
}

/// G20, G21, G700 and G710, which set inches and millimeters on other controls.
Draft code_of_this_control(const FixRequest& request) {
  const Word* const word = word_at(request.line, request.finding.span);
  const bool is_unit = word && is_foreign_unit(*word);
  return is_unit ? habit_draft(request, Habit::ForeignUnits) : Draft{};
}

/// G04 X2 or G04 F2, as on other controls. There, X1000 without a decimal point may be 1 s or 1000 s.
Draft time_by_p(const FixRequest& request) {
  const Word* const command = word_at(request.line, request.finding.span);
  const Instruction* const dwell = command ? owner_of(request.line, *command) : nullptr;
  if (!dwell || dwell->command + 2u > request.line.words.size()) return {};
  const Word& time = request.line.words[dwell->command + 1u];
  const bool is_x = time.letter == 'X' && time.owner == dwell->number && dwell->end == dwell->command + 2;
  if ((!is_x && time.letter != 'F') || !time.known()) return {};
  if (is_x && time.value >= 10 && request.line.text_of(time.span()).find('.') == std::string_view::npos) return {};
  return {{replaced(request, {time.begin, time.begin + 1}, "P")}, std::string(1, time.letter)};
}

/// G04 P500, meant in milliseconds.
Draft seconds_of_milliseconds(const FixRequest& request) { return habit_draft(request, Habit::Milliseconds); }

Draft free_label(const FixRequest& request) {
  const std::optional<std::uint64_t> number = request.program.free_line_number();
  if (!number || request.marked().find('(') != std::string_view::npos) return {};
  return rewritten(request, fmt::format("{}{}", request.marked().front(), *number));
}

static bool is_letter(char c) {
  return (text::upper(c) >= 'A' && text::upper(c) <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

/// Whether text that is to become a comment may hold words that move the machine (D67): X, Y or Z with a number
/// anywhere, and other letters unless they end a name (SUB1, PROGRAM 12).
static bool may_move_machine(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view after = text::trimmed(text.substr(i + 1));
    const char letter = text::upper(text[i]);
    const bool has_number =
        !after.empty() && (text::is_number_char(after.front()) || text::foreign_minus_length(after) > 0);
    if (!has_number || letter < 'A' || letter > 'Z') continue;
    const bool ends_name = i > 0 && is_letter(text[i - 1]);
    if (dialect::contains(dialect::letters("XYZ"), letter)) return true;
    if (!ends_name && dialect::contains(dialect::letters("BCIJKRGMT"), letter)) return true;
  }
  return false;
}

Draft closed_comment(const FixRequest& request) {
  if (may_move_machine(request.marked().substr(1))) return {};
  const auto end = request.finding.span.begin + static_cast<std::uint32_t>(text::trimmed(request.marked()).size());
  return {{inserted(request, end, ")")}};
}

/// OP 10): text before the `)` was meant as a comment; without such text, the `)` is superfluous.
Draft opened_comment(const FixRequest& request) {
  const syntax::ParsedLine before(request.line.text.substr(0, request.finding.span.begin));
  const syntax::LineTree tree = before.tree();
  std::size_t first = tree.words.size();
  while (const std::size_t prose = syntax::prose_at_end(tree.words.first(first))) first -= prose;
  if (first == tree.words.size() || may_move_machine(tree.text.substr(tree.words[first].begin))) return {};
  return {{inserted(request, tree.words[first].begin, "(")}};
}

/// Extends the span by the letters that it cuts off from a word, and the number after that: PROGRA M 12.
static Span whole_words(std::string_view line, Span span) {
  while (span.begin > 0 && is_letter(line[span.begin - 1])) --span.begin;
  const std::uint32_t end = span.end;
  while (span.end < line.size() && is_letter(line[span.end])) ++span.end;
  if (span.end == end) return span;
  std::uint32_t number = span.end;
  while (number < line.size() && text::is_blank(line[number])) ++number;
  while (number < line.size() && text::is_digit(line[number])) span.end = ++number;
  return span;
}

/// Text for people in place of words of the program.
Draft text_as_comment(const FixRequest& request) {
  if (text::foreign_minus_length(request.marked()) > 0) return {};          // A number.
  if (syntax::foreign_form(request.finding, request.line.text)) return {};  // It has a purpose on another control.
  const Span span = whole_words(request.line.text, request.finding.span);
  const std::string_view text = request.line.text_of(span);
  static constexpr std::string_view kSigns = "()%#=;";
  if (std::count_if(text.begin(), text.end(), is_letter) < 3 || text.find_first_of(kSigns) != std::string_view::npos ||
      may_move_machine(text))
    return {};
  return {{inserted(request, span.begin, "("), inserted(request, span.end, ")")}};
}

/// Comments between the marked words stay as they are.
Draft capitals(const FixRequest& request) {
  std::string text(request.marked());
  for (std::uint32_t i = 0; i < text.size(); ++i) {
    const auto is_here = [&](Span comment) { return comment.holds(request.finding.span.begin + i); };
    if (std::none_of(request.line.comments.begin(), request.line.comments.end(), is_here))
      text[i] = text::upper(text[i]);
  }
  return {{replaced(request, request.finding.span, std::move(text))}};
}

/// Replaces all tabs of the line, which has one finding for them.
Draft blank_for_tab(const FixRequest& request) {
  Draft draft;
  for (std::uint32_t at = request.finding.span.begin; at < request.line.text.size(); ++at) {
    const auto is_here = [&](Span comment) { return comment.holds(at); };
    if (request.line.text[at] == '\t' &&
        std::none_of(request.line.comments.begin(), request.line.comments.end(), is_here))
      draft.edits.push_back(replaced(request, {at, at + 1}, " "));
  }
  return draft;
}

}  // namespace isocnc::fixes
