#include "debugger/breakpoints/hit_condition.h"

#include <utility>

#include "debugger/expressions/read_number.h"
#include "interpreter/text/characters.h"

namespace isocnc::breakpoints {

std::optional<HitCondition> HitCondition::read(std::string_view text) {
  static constexpr std::pair<std::string_view, Kind> kSigns[] = {
      {">=", Kind::GreaterEqual}, {"<=", Kind::LessEqual}, {"==", Kind::Equal}, {">", Kind::Greater},
      {"<", Kind::Less},          {"=", Kind::Equal},      {"%", Kind::Every}};
  text = text::trimmed(text);
  HitCondition condition;
  for (const auto& [sign, kind] : kSigns) {
    if (!text.starts_with(sign)) continue;
    condition.kind_ = kind;
    text = text::trimmed(text.substr(sign.size()));
    break;
  }
  const auto count = expressions::read_number<std::uint64_t>(text);
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

}  // namespace isocnc::breakpoints
