#include "interpreter/syntax/tree_store.h"

#include "interpreter/syntax/characters.h"
#include "interpreter/syntax/line_parser.h"

namespace isocnc::syntax {

const char* TreeStore::append_rarer_line(const char* begin, const char* end) {
  if (begin != end && upper(*begin) == 'V')
    if (const char* const line_end = append_plain_assignment(begin, end)) return line_end;
  return append_any_line(begin, end);
}

const char* TreeStore::append_any_line(const char* begin, const char* end) {
  return LineParser(*this, begin, end).parse();
}

void TreeStore::append_copy(const TreeStore& other, std::size_t index) {
  Line line = other.lines_[index];
  const auto copy_row = [](auto& to, const auto& from, std::uint32_t& first, std::size_t count) {
    const auto* const source = from.data() + first;
    first = static_cast<std::uint32_t>(to.size());
    if constexpr (requires { to.append(source, count); }) {
      to.append(source, count);
    } else {
      to.insert(to.end(), source, source + count);
    }
  };
  copy_row(words_, other.words_, line.first_word, line.words);
  copy_row(instructions_, other.instructions_, line.first_instruction, line.instructions);
  copy_row(comments_, other.comments_, line.first_comment, line.comments);
  copy_row(findings_, other.findings_, line.first_finding, line.findings);
  if (line.jump >= 0) {
    jumps_.push_back(other.jumps_[static_cast<std::size_t>(line.jump)]);
    line.jump = static_cast<std::int32_t>(jumps_.size()) - 1;
  }
  lines_.push_back(line);
}

void TreeStore::clear() {
  lines_.clear();
  words_.clear();
  instructions_.clear();
  comments_.clear();
  findings_.clear();
  jumps_.clear();
}

std::size_t TreeStore::memory() const {
  return lines_.capacity() * sizeof(Line) + words_.capacity() * sizeof(Word) +
         instructions_.capacity() * sizeof(Instruction) + comments_.capacity() * sizeof(Span) +
         findings_.capacity() * sizeof(Finding) + jumps_.capacity() * sizeof(Jump);
}

}  // namespace isocnc::syntax
