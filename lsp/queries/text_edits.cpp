#include "lsp/queries/text_edits.h"

#include <algorithm>

#include <fmt/format.h>

#include "interpreter/text/characters.h"
#include "interpreter/text/unicode.h"
#include "lsp/rpc/message.h"

namespace isocnc::queries {

using fixes::Edit;
using text::is_inside_character;

std::optional<protocol::TextEdit> line_edit(const documents::Snapshot& snapshot, std::size_t line,
                                            std::string_view text) {
  const std::string_view before = snapshot.document().text_of_line(line);
  if (before == text) return std::nullopt;
  const std::size_t shorter = std::min(before.size(), text.size());
  std::size_t head = 0;
  while (head < shorter && before[head] == text[head]) ++head;
  const auto is_inside = [&](std::size_t at) {
    return (at < before.size() && is_inside_character(before[at])) ||
           (at < text.size() && is_inside_character(text[at]));
  };
  while (head > 0 && is_inside(head)) --head;
  std::size_t tail = 0;
  while (tail < shorter - head && before[before.size() - 1 - tail] == text[text.size() - 1 - tail]) ++tail;
  while (tail > 0 && is_inside_character(before[before.size() - tail])) --tail;
  const syntax::Span span{static_cast<std::uint32_t>(head), static_cast<std::uint32_t>(before.size() - tail)};
  return protocol::TextEdit{snapshot.to_client(line, span), std::string(text.substr(head, text.size() - tail - head))};
}

/// The terminator of the program's first line; LF if the program has only one line.
static std::string_view line_end_of(const documents::Snapshot& snapshot) {
  const std::string_view first = snapshot.document().terminator(0);
  return first.empty() ? "\n" : first;
}

std::vector<protocol::TextEdit> to_client(const documents::Snapshot& snapshot, const std::vector<Edit>& edits) {
  std::vector<protocol::TextEdit> all;
  all.reserve(edits.size());
  for (const Edit& edit : edits)
    all.push_back(
        {{snapshot.to_client(edit.begin), snapshot.to_client(edit.end)}, edit.text_with(line_end_of(snapshot))});
  return all;
}

namespace {

/// Collects the edits that bring the lines of a new text into the document.
class Merge {
 public:
  explicit Merge(const documents::Snapshot& snapshot) : snapshot_(snapshot), count_(snapshot.document().line_count()) {}

  void add(std::string_view line, std::string_view terminator, std::size_t origin) {
    const bool is_old = origin >= next_ && origin < count_ && snapshot_.document().terminator(origin) == terminator;
    if (!is_old) {
      fresh_.append(line).append(terminator);
      return;
    }
    replace_up_to({origin, 0});
    if (auto edit = line_edit(snapshot_, origin, line)) edits_.push_back(std::move(*edit));
    next_ = origin + 1;
  }

  std::vector<protocol::TextEdit> finish() {
    const std::size_t last = count_ - 1;
    if (next_ < count_) replace_up_to({last, snapshot_.document().text_of_line(last).size()});
    return std::move(edits_);
  }

 private:
  /// Replaces all old lines up to `end` by the new lines.
  void replace_up_to(const syntax::Position& end) {
    const syntax::Position begin{next_, 0};
    if (begin != end || !fresh_.empty())
      edits_.push_back({{snapshot_.to_client(begin), snapshot_.to_client(end)}, std::move(fresh_)});
    fresh_.clear();
  }

  const documents::Snapshot& snapshot_;
  const std::size_t count_;
  std::size_t next_ = 0;  // The next line of the document.
  std::string fresh_;
  std::vector<protocol::TextEdit> edits_;
};

}  // namespace

std::vector<protocol::TextEdit> edits_to(const documents::Snapshot& snapshot, std::string_view text,
                                         const std::vector<std::size_t>& origins) {
  Merge merge(snapshot);
  const char* const end = text.data() + text.size();
  const char* line = text.data();
  for (const std::size_t origin : origins) {
    const char* const line_end = text::find_line_end(line, end);
    const char* const next = text::skip_line_end(line_end, end);
    merge.add({line, static_cast<std::size_t>(line_end - line)}, {line_end, static_cast<std::size_t>(next - line_end)},
              origin);
    line = next;
  }
  return merge.finish();
}

protocol::RawJson written(const std::vector<protocol::TextEdit>& edits) {
  std::string all = "[";
  for (const protocol::TextEdit& edit : edits) {
    const auto& [start, end] = edit.range;
    fmt::format_to(std::back_inserter(all),
                   R"({}{{"range":{{"start":{{"line":{},"character":{}}},"end":{{"line":{},"character":{}}}}},)"
                   R"("newText":{}}})",
                   all.size() > 1 ? "," : "", start.line, start.character, end.line, end.character,
                   rpc::write(Json(edit.new_text)));
  }
  return {all + "]"};
}

Json workspace_edit(const documents::Snapshot& snapshot, const std::vector<protocol::TextEdit>& edits) {
  if (!snapshot.client().can("/workspace/workspaceEdit/documentChanges"))
    return {{"changes", {{snapshot.uri(), edits}}}};
  const Json document = {{"uri", snapshot.uri()}, {"version", snapshot.version()}};
  return {{"documentChanges", Json::array({{{"textDocument", document}, {"edits", edits}}})}};
}

}  // namespace isocnc::queries
