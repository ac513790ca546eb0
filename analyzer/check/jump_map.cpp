#include "analyzer/check/jump_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "interpreter/syntax/characters.h"
#include "interpreter/syntax/each_tree.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::check {

/// How many line feeds there are. In blocks whose count fits a byte, so that the compiler counts sixteen bytes at once.
static std::uint64_t count_line_feeds(std::string_view text) {
  constexpr std::size_t kRow = 16;
  constexpr std::size_t kMostRows = 255;
  std::uint64_t count = 0;
  while (text.size() >= kRow) {
    const std::size_t rows = std::min(kMostRows, text.size() / kRow);
    std::array<std::uint8_t, kRow> counts{};
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t i = 0; i < kRow; ++i) counts[i] += text[kRow * row + i] == '\n';
    for (const std::uint8_t each : counts) count += each;
    text.remove_prefix(kRow * rows);
  }
  return count + static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Counts the lines of a text up to ever later places.
class LineCounter {
 public:
  explicit LineCounter(std::string_view text) : text_(text) {}

  std::uint64_t line_of(std::size_t offset) {
    if (offset_ == 0) has_carriage_returns_ = text_.find('\r') != std::string_view::npos;
    const std::string_view passed = text_.substr(offset_, offset - offset_);
    line_ += count_line_feeds(passed);
    if (has_carriage_returns_)
      for (std::size_t i = 0; i < passed.size(); ++i)
        line_ += passed[i] == '\r' && offset_ + i + 1 < text_.size() && text_[offset_ + i + 1] != '\n' ? 1 : 0;
    offset_ = offset;
    return line_;
  }

 private:
  std::string_view text_;
  bool has_carriage_returns_ = false;
  std::size_t offset_ = 0;
  std::uint64_t line_ = 0;
};

/// Whether a GOTO may end in the O at `offset`: of its letters O stands nowhere else outside comments.
static bool may_belong_to_goto(std::string_view text, std::size_t offset) {
  while (offset > 0 && syntax::is_blank(text[offset - 1])) --offset;
  if (offset == 0) return false;
  const char before = syntax::upper(text[offset - 1]);
  return before == 'G' || before == ')';
}

bool may_hold_jumps(std::string_view text) {
  static constexpr std::string_view kLetters = "VvOo";
  return std::any_of(kLetters.begin(), kLetters.end(),
                     [&](char letter) { return text.find(letter) != std::string_view::npos; });
}

/// A line number at the start of a line, as most of those that have one write it.
struct PlainLabel {
  std::uint64_t number = 0;
  const char* end = nullptr;  ///< Behind it; null where there is none, or where it takes a closer look.
};

static PlainLabel plain_label(const char* p, const char* end) {
  if (end - p < 20 || *p != 'N' || !syntax::is_digit(p[1])) return {};
  std::uint64_t label = 0;
  const char* at = p + 1;
  for (; at - p <= 15 && syntax::is_digit(*at); ++at) label = label * 10 + static_cast<std::uint64_t>(*at - '0');
  const bool is_plain = *at == ' ' && syntax::char_class(at[1]) == syntax::CharClass::Letter;
  return {label, is_plain ? at + 1 : nullptr};
}

/// The first O at or behind `p`, of either case, or `end`. Sixty-four bytes at a time: this is all that most programs
/// take before they are read.
static const char* next_o(const char* p, const char* end) {
  const auto is_o = [](char c) { return (c | 0x20) == 'o'; };
#ifdef __SSE2__
  const auto os_at = [](const char* at) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
    return _mm_cmpeq_epi8(_mm_or_si128(bytes, _mm_set1_epi8(0x20)), _mm_set1_epi8('o'));
  };
  for (; end - p >= 64; p += 64) {
    const __m128i any = _mm_or_si128(_mm_or_si128(os_at(p), os_at(p + 16)), _mm_or_si128(os_at(p + 32), os_at(p + 48)));
    if (_mm_movemask_epi8(any) != 0) break;
  }
#endif
  return std::find_if(p, end, is_o);
}

/// The first letter at or behind `p` that may make its line an event for registers, or `end`.
static const char* next_telling_letter(const char* p, const char* end) {
#ifdef __SSE2__
  for (; end - p >= 16; p += 16) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
    const __m128i n_or_o = _mm_cmpeq_epi8(_mm_or_si128(bytes, _mm_set1_epi8(0x21)), _mm_set1_epi8('o'));
    const __m128i v = _mm_cmpeq_epi8(_mm_or_si128(bytes, _mm_set1_epi8(0x20)), _mm_set1_epi8('v'));
    const auto found = static_cast<unsigned>(_mm_movemask_epi8(_mm_or_si128(n_or_o, v)));
    if (found != 0) return p + std::countr_zero(found);
  }
#endif
  while (p != end && std::string_view("NnOoVv").find(*p) == std::string_view::npos) ++p;
  return p;
}

/// Calls `take` with the events of a text and the beginnings of their lines. Most lines with a telling letter have a
/// plain line number and nothing else that tells, which shows where the next such letter stands on another line.
template <class Take>
static void scan_events(std::string_view text, Take take) {
  syntax::TreeStore store;
  const char* const end = text.data() + text.size();
  const char* labelled = nullptr;  // The beginning of a line with a plain label, not yet told.
  PlainLabel label;
  for (const char* p = next_telling_letter(text.data(), end);;) {
    const char* begin = p;
    while (begin != text.data() && !syntax::is_line_end(begin[-1])) --begin;
    if (labelled && (p == end || begin != labelled))
      take(JumpEvent{.kind = JumpEvent::Kind::Label, .label = label.number}, labelled);
    if (p == end) return;
    label = p == begin && p != labelled ? plain_label(p, end) : PlainLabel{};
    labelled = label.end ? begin : nullptr;
    if (!labelled) {
      store.clear();
      label.end = store.append_line(begin, end);
      each_event(store.tree(0, begin), [&](const JumpEvent& event) { take(event, begin); });
    }
    p = next_telling_letter(label.end, end);
  }
}

void each_event_in(std::string_view text, const std::function<void(const JumpEvent&)>& take) {
  LineCounter counter(text);
  scan_events(text, [&](JumpEvent event, const char* line) {
    event.line = static_cast<std::uint32_t>(counter.line_of(static_cast<std::size_t>(line - text.data())));
    take(event);
  });
}

JumpMap::JumpMap(std::string_view text) {
  LineCounter counter(text);
  syntax::TreeStore store;
  const char* const end = text.data() + text.size();
  for (const char* p = next_o(text.data(), end); p != end; p = next_o(p, end)) {
    if (!may_belong_to_goto(text, static_cast<std::size_t>(p - text.data()))) {
      ++p;
      continue;
    }
    const char* begin = p;
    while (begin != text.data() && !syntax::is_line_end(begin[-1])) --begin;
    store.clear();
    p = store.append_line(begin, end);
    const syntax::LineTree tree = store.tree(0, begin);
    if (tree.jump && tree.jump->has_target)
      add(counter.line_of(static_cast<std::size_t>(begin - text.data())), *tree.jump);
  }
  if (compares_registers()) note_all_registers(text);
  complete();
}

/// Gathers the assignments, labels and jumps of the program.
void JumpMap::note_all_registers(std::string_view text) {
  scan_events(text, [&](const JumpEvent& event, const char*) { note_registers(event.kind, event.reg, event.label); });
}

void JumpMap::add(std::uint64_t line, const syntax::Jump& jump) {
  sites_.push_back({line, jump});
  targets_.insert(jump.target);
  filter_.resize(16384);
  const std::size_t bit = filter_bit(jump.target);
  filter_[bit / 64] |= std::uint64_t{1} << (bit % 64);
  if (jump.variable <= 0 || !jump.condition_is_known()) return;
  constants_[static_cast<std::size_t>(jump.variable)].push_back(jump.value);
  compared_ |= register_bit(jump.variable);
}

void JumpMap::note_registers(JumpEvent::Kind kind, std::uint8_t reg, std::uint64_t label) {
  if (kind != JumpEvent::Kind::Label || names(label)) events_.push_back({kind, reg, label});
}

void JumpMap::complete() {
  for (std::vector<double>& values : constants_) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }
  // From the end of the program to its start: all jumps go forward, so one pass tells what is still read where.
  reads_.assign(sites_.size(), {});
  std::unordered_map<std::uint64_t, RegisterSet> read_at_label;
  RegisterSet read = 0;
  std::size_t jump = sites_.size();
  for (auto event = events_.rbegin(); event != events_.rend(); ++event) {
    switch (event->kind) {
      case JumpEvent::Kind::Assignment:
        read &= ~register_bit(event->reg);
        break;
      case JumpEvent::Kind::Label:
        read_at_label[event->label] = read;
        break;
      case JumpEvent::Kind::Jump: {
        const syntax::Jump& condition = sites_[--jump].jump;
        const auto target = read_at_label.find(condition.target);
        reads_[jump].behind = read;
        reads_[jump].at_target = target == read_at_label.end() ? 0 : target->second;
        read |= reads_[jump].at_target;
        if (condition.variable > 0) read |= register_bit(condition.variable);
        reads_[jump].before = read;
        break;
      }
    }
  }
  events_ = {};
}

void JumpMap::note_label(std::uint64_t label, std::uint64_t line) {
  const auto [last, is_first] = last_lines_.insert_or_assign(label, line);
  if (!is_first) repeated_.insert(label);
}

void JumpMap::resolve() {
  targets_of_jumps_.clear();
  for (const Site& site : sites_) {
    const auto last = last_lines_.find(site.jump.target);
    Target target = Target::NotFound;
    if (last != last_lines_.end()) target = last->second > site.line ? Target::Below : Target::Above;
    targets_of_jumps_.push_back(target);
  }
  last_lines_ = {};
  resolved_ = true;
}

void JumpMap::resolve(std::string_view text) {
  std::uint64_t line = 0;
  syntax::each_tree(text, [&](const syntax::LineTree& tree, std::string_view) {
    if (tree.has_label() && names(tree.label)) note_label(tree.label, line);
    ++line;
  });
  resolve();
}

std::size_t JumpMap::first_from(std::uint64_t line) const {
  const auto is_above = [&](const Site& site) { return site.line < line; };
  return static_cast<std::size_t>(std::partition_point(sites_.begin(), sites_.end(), is_above) - sites_.begin());
}

void JumpMap::move(std::size_t first, const std::vector<Site>& sites, std::int64_t lines) {
  const auto behind = std::copy(sites.begin(), sites.end(), sites_.begin() + static_cast<std::ptrdiff_t>(first));
  for (auto site = behind; site != sites_.end(); ++site) site->line += static_cast<std::uint64_t>(lines);
}

std::vector<std::uint64_t> JumpMap::named_beyond(const JumpMap& other) const {
  std::vector<std::uint64_t> labels;
  for (const std::uint64_t label : targets_)
    if (!other.names(label)) labels.push_back(label);
  std::sort(labels.begin(), labels.end());
  return labels;
}

/// Whether two conditions and their targets are the same.
static bool jump_alike(const syntax::Jump& a, const syntax::Jump& b) {
  return a.variable == b.variable && a.comparison == b.comparison &&
         (a.value == b.value || (std::isnan(a.value) && std::isnan(b.value))) && a.target == b.target;
}

bool JumpEvent::means_the_same(const JumpEvent& other) const {
  return kind == other.kind && reg == other.reg && label == other.label &&
         (kind != Kind::Jump || jump_alike(jump, other.jump));
}

bool JumpMap::does_the_same(std::uint32_t jump, const JumpMap& other) const {
  return jump_alike(sites_[jump].jump, other.sites_[jump].jump) && reads_[jump] == other.reads_[jump] &&
         target_of(jump) == other.target_of(jump);
}

}  // namespace isocnc::check
