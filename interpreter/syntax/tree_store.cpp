#include "interpreter/syntax/tree_store.h"

#include "interpreter/syntax/line_parser.h"
#include "interpreter/text/characters.h"

namespace isocnc::syntax {

const char* TreeStore::append_lines(const char* begin, const char* stop, const char* end) {
  while (begin < stop) {
    begin = append_plain_lines(begin, stop, end);
    if (begin < stop) begin = text::skip_line_end(append_rarer_line(begin, end), end);
  }
  return begin;
}

const char* TreeStore::append_rarer_line(const char* begin, const char* end) {
  if (begin != end && text::upper(*begin) == 'V')
    if (const char* const line_end = append_plain_assignment(begin, end)) return line_end;
  return append_any_line(begin, end);
}

const char* TreeStore::append_any_line(const char* begin, const char* end) {
  return LineParser(*this, begin, end).parse();
}

void TreeStore::clear() {
  lines_.clear();
  words_.clear();
  instructions_.clear();
  comments_.clear();
  findings_.clear();
  jumps_.clear();
}

}  // namespace isocnc::syntax
