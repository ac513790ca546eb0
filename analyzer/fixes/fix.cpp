#include "analyzer/fixes/fix.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "analyzer/fixes/fix_table.h"
#include "analyzer/fixes/habits.h"
#include "analyzer/fixes/line_edits.h"
#include "interpreter/dialect/format.h"
#include "interpreter/syntax/formatter.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::fixes {

using dialect::DiagnosticId;

/// The first row of each code, computed once: programs may have a finding on every line.
static constexpr auto kFirstRows = [] {
  std::array<std::uint8_t, dialect::kDiagnosticCount> rows{};
  rows.fill(static_cast<std::uint8_t>(kFixes.size()));
  for (std::size_t row = kFixes.size(); row-- > 0;)
    rows[static_cast<std::size_t>(kFixes[row].diagnostic)] = static_cast<std::uint8_t>(row);
  return rows;
}();
static_assert(kFixes.size() < 255);

FixProgram::FixProgram() = default;
FixProgram::~FixProgram() = default;

Habits& FixProgram::habits() {
  if (!habits_) habits_ = std::make_unique<Habits>(*this);
  return *habits_;
}

std::optional<std::uint64_t> FixProgram::free_line_number() {
  if (!last_line_number_) last_line_number_ = highest_line_number();
  if (*last_line_number_ > syntax::kMaxLineNumber - 10) return std::nullopt;
  last_line_number_ = *last_line_number_ / 10 * 10 + 10;
  return last_line_number_;
}

std::string Fix::title_in(dialect::Language language) const {
  static constexpr dialect::Text kOneMore = {"{}, and on 1 more line", "{}, e su un'altra linea"};
  static constexpr dialect::Text kMore = {"{}, and on {} more lines", "{}, e su altre {} linee"};
  const std::string text = dialect::format(title, language, fmt::arg("text", marked), fmt::arg("new", what));
  if (more_lines == 0) return text;
  return dialect::format(more_lines == 1 ? kOneMore : kMore, language, text, more_lines);
}

std::string Edit::text_with(std::string_view line_end) const {
  std::string result;
  for (const char c : text) {
    if (c == '\n') {
      result += line_end;
    } else {
      result += c;
    }
  }
  return result;
}

/// The line with the edits applied, which may be several lines. Nothing if an edit is on another line.
static std::optional<std::string> edited_line(const FixRequest& request, std::vector<Edit> edits) {
  const auto is_elsewhere = [&](const Edit& edit) {
    return edit.begin.line != request.number || edit.end.line != request.number;
  };
  if (std::any_of(edits.begin(), edits.end(), is_elsewhere)) return std::nullopt;
  return edited(request.line.text, std::move(edits));
}

bool helps(const FixRequest& request, const std::vector<Edit>& edits) {
  const std::optional<std::string> text = edited_line(request, edits);
  if (!text) return true;
  std::array<std::int16_t, dialect::kDiagnosticCount> counts{};
  for (const syntax::Finding& finding : request.line.findings) ++counts[static_cast<std::size_t>(finding.id)];
  --counts[static_cast<std::size_t>(request.finding.id)];
  syntax::TreeStore store;
  const char* const end = text->data() + text->size();
  for (const char* p = text->data();;) {
    const char* const line_end = store.append_line(p, end);
    const syntax::LineTree line = store.tree(store.size() - 1, p);
    for (const syntax::Finding& finding : line.findings)
      if (--counts[static_cast<std::size_t>(finding.id)] < 0) return false;
    if (line_end == end) return true;
    p = text::skip_line_end(line_end, end);
  }
}

std::vector<Edit> all_edits(const Fix& fix, FixProgram& program) {
  if (fix.habit == Habit::None) return fix.edits;
  std::vector<Edit> edits;
  for (const LineRewrite& rewrite : program.habits().rewrites(fix.habit))
    edits.insert(edits.end(), rewrite.edits.begin(), rewrite.edits.end());
  return edits;
}

std::optional<Fix> fix_of(const FindingPlace& place, FixProgram& program) {
  const DiagnosticId id = place.finding.id;
  std::size_t row = kFirstRows[static_cast<std::size_t>(id)];
  if (row == kFixes.size() || kFixes[row].make == nullptr) return std::nullopt;
  if (program.text(place.line).size() > kLongestLine) return std::nullopt;
  const FixRequest request{place.line, place.finding, place.on_every_path, program.line(place.line), program};
  for (; row < kFixes.size() && kFixes[row].diagnostic == id; ++row) {
    Draft draft = kFixes[row].make(request);
    if (draft.edits.empty() || !helps(request, draft.edits)) continue;
    return Fix{.safety = kFixes[row].safety,
               .title = kFixes[row].title,
               .marked = std::string(request.marked()),
               .what = std::move(draft.what),
               .edits = std::move(draft.edits),
               .mends_repetitions = kFixes[row].mends_repetitions,
               .habit = draft.habit};
  }
  return std::nullopt;
}

}  // namespace isocnc::fixes
