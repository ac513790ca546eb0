#include "interpreter/syntax/line_finder.h"

#include <algorithm>

#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"
#include "interpreter/text/unicode.h"

namespace isocnc::syntax {

std::string_view LineFinder::line(std::size_t index) {
  if (found_ && index == at_) return line_;
  const char* p = rest_.data();
  const char* const end = rest_.data() + rest_.size();
  for (; at_ < index; ++at_) p = text::next_line(p, end);
  rest_ = {p, static_cast<std::size_t>(end - p)};
  line_ = {p, static_cast<std::size_t>(text::find_line_end(p, end) - p)};
  found_ = true;
  walked_ = 0;
  column_ = 1;
  return line_;
}

std::size_t LineFinder::column(std::size_t byte) {
  if (byte < walked_) {
    walked_ = 0;
    column_ = 1;
  }
  for (; walked_ < std::min(byte, line_.size()); ++column_)
    walked_ += std::max<std::size_t>(1, text::sequence_length(line_.substr(walked_)));
  return column_;
}

}  // namespace isocnc::syntax
