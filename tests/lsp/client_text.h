#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/text/characters.h"
#include "lsp/protocol/encoding.h"
#include "lsp/rpc/json.h"

namespace isocnc::lsp {

using rpc::Json;

/// A program with a marked selection: `[!G01 X10!]`; `[!!]` is the cursor.
struct SelectedProgram {
  std::string text;
  std::size_t begin = 0;
  std::size_t end = 0;

  explicit SelectedProgram(std::string_view marked) {
    begin = marked.find("[!");
    end = marked.find("!]") - 2;
    text = marked;
    text.erase(text.find("!]"), 2).erase(begin, 2);
  }
};

/// A text in which positions are lines and columns as a client counts them.
class ClientText {
 public:
  explicit ClientText(std::string text, protocol::Encoding encoding = protocol::Encoding::Utf16)
      : text_(std::move(text)), encoding_(encoding) {
    starts_.push_back(0);
    const char* const end = text_.data() + text_.size();
    for (const char* p = text_.data(); p != end;) {
      p = text::find_line_end(p, end);
      if (p == end) break;
      p = text::skip_line_end(p, end);
      starts_.push_back(static_cast<std::size_t>(p - text_.data()));
    }
  }

  const std::string& text() const { return text_; }
  std::size_t line_count() const { return starts_.size(); }

  Json place(std::size_t offset) const {
    std::size_t line = starts_.size() - 1;
    while (starts_[line] > offset) --line;
    const std::string_view content = std::string_view(text_).substr(starts_[line]);
    return {{"line", line}, {"character", protocol::units_before(content, offset - starts_[line], encoding_)}};
  }
  Json range(std::size_t begin, std::size_t end) const { return {{"start", place(begin)}, {"end", place(end)}}; }

  /// The text in a range.
  std::string in(const Json& range) const {
    const std::size_t begin = offset(range["start"]);
    return text_.substr(begin, offset(range["end"]) - begin);
  }

  /// The text after TextEdits, which must not overlap.
  std::string with(const Json& edits) const {
    std::vector<Edit> sorted;
    for (const Json& edit : edits)
      sorted.push_back({offset(edit["range"]["start"]), offset(edit["range"]["end"]), edit["newText"]});
    std::stable_sort(sorted.begin(), sorted.end(), [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
    std::string result;
    std::size_t copied = 0;
    for (const Edit& edit : sorted) {
      if (edit.begin < copied) return "overlapping edits: " + edits.dump();
      result += text_.substr(copied, edit.begin - copied) + edit.text;
      copied = edit.end;
    }
    return result + text_.substr(copied);
  }

 private:
  struct Edit {
    std::size_t begin;
    std::size_t end;
    std::string text;
  };

  std::size_t offset(const Json& place) const {
    const std::size_t start = starts_.at(place["line"]);
    return start + protocol::byte_at(std::string_view(text_).substr(start), place["character"], encoding_);
  }

  std::string text_;
  protocol::Encoding encoding_;
  std::vector<std::size_t> starts_;
};

}  // namespace isocnc::lsp
