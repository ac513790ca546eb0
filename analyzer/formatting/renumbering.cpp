#include "analyzer/formatting/renumbering.h"

#include <algorithm>

#include "analyzer/formatting/motion_in_force.h"
#include "interpreter/dialect/format.h"
#include "interpreter/syntax/each_tree.h"
#include "interpreter/text/characters.h"

namespace isocnc::formatting {

using dialect::Text;
using syntax::LineTree;

static constexpr Text kObstacles[] = {
    {"line {0} has an error and a line number or a jump; correct it first",
     "la linea {0} ha un errore e un numero di riga o un salto: va prima corretta"},
    {"line {0} jumps to {1}, which is no line's number",
     "la linea {0} salta a {1}, che non è il numero di nessuna linea"},
    {"line {0} is one more {1}, to which a jump leads; which of them is meant?",
     "la linea {0} è un'altra {1}, alla quale porta un salto: quale delle due si intende?"},
    {"line {0} would have a number of more than 15 digits", "la linea {0} avrebbe un numero di più di 15 cifre"},
};

std::string Renumbering::RenumberingObstacle::message(dialect::Language language) const {
  return dialect::format(kObstacles[static_cast<std::size_t>(kind)], language, line + 1, label);
}

EachLine each_line_of(std::string_view text) {
  return [text](const std::function<void(const LineTree&)>& look) {
    syntax::each_tree(text, [&](const LineTree& tree, std::string_view) { look(tree); });
  };
}

/// The label without blanks and in one letter case, as neither matters.
static std::string label_text(std::string_view written) {
  std::string text;
  for (const char c : written)
    if (text::is_digit(c) || text::upper(c) == 'N') text += text::upper(c);
  return text;
}

Renumbering::Renumbering(const EachLine& each_line, const NumberStyle& style) : style_(style), next_(style.start) {
  std::size_t number = 0;
  each_line([&](const LineTree& line) { read_jump(number++, line); });
  number = 0;
  MotionInForce motion;
  const auto number_next = [&](const LineTree& line) {
    motion.enter(line);
    number_label(number++, line, motion.may_go_on(line));
    motion.leave(line);
  };
  if (!obstacle_) each_line(number_next);
  if (obstacle_) return;
  for (const auto& [label, jump] : labels_)
    if (!jump.is_defined && (!obstacle_ || jump.jump_line < obstacle_->line)) {
      obstacle_.reset();
      refuse(RenumberingObstacle::Kind::LabelMissing, jump.jump_line, jump.text);
    }
  next_ = style.start;
}

void Renumbering::refuse(RenumberingObstacle::Kind kind, std::size_t line, std::string label) {
  if (!obstacle_) obstacle_ = {kind, line, std::move(label)};
}

void Renumbering::read_jump(std::size_t number, const LineTree& line) {
  const auto names_a_line = [](const syntax::Word& word) { return word.letter == 'N' || word.letter == syntax::kGoto; };
  if (!line.findings.empty() && std::any_of(line.words.begin(), line.words.end(), names_a_line))
    return refuse(RenumberingObstacle::Kind::Error, number);
  if (line.jump == nullptr || !line.jump->has_target) return;
  labels_.try_emplace(line.jump->target, NumberedLabel{label_text(line.text_of(line.jump->target_span)), number});
}

void Renumbering::number_label(std::size_t number, const LineTree& line, bool may_go_on) {
  if (!is_numbered(line, may_go_on)) return;
  if (next_ > syntax::kMaxLineNumber) return refuse(RenumberingObstacle::Kind::TooManyDigits, number);
  const std::uint64_t is_now = next_;
  next_ += style_.step;
  const auto named = line.has_label() ? labels_.find(line.label) : labels_.end();
  if (named == labels_.end()) return;
  NumberedLabel& label = named->second;
  if (label.is_defined) return refuse(RenumberingObstacle::Kind::LabelTwice, number, label.text);
  label.is_defined = true;
  label.number = is_now;
}

bool Renumbering::is_numbered(const LineTree& line, bool may_go_on) const {
  if (!line.findings.empty()) return false;
  if (line.has_label()) return true;
  return style_.all_lines && !line.is_empty() && !may_go_on;
}

void Renumbering::change(const LineTree& line, bool may_go_on, syntax::LineChange& change) {
  if (is_numbered(line, may_go_on)) {
    change.line_number = next_;
    next_ += style_.step;
  }
  if (line.jump != nullptr && line.jump->has_target) change.target = labels_.at(line.jump->target).number;
}

}  // namespace isocnc::formatting
