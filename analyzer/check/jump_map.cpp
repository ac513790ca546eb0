#include "analyzer/check/jump_map.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"
#include "interpreter/threads/side_by_side.h"

namespace isocnc::check {

/// The number of line feeds, counted in blocks whose count fits a byte, so that the compiler counts 16 bytes at once.
static std::size_t count_line_feeds(std::string_view text) {
  constexpr std::size_t kRow = 16;
  constexpr std::size_t kMaxRows = 255;
  std::size_t count = 0;
  while (text.size() >= kRow) {
    const std::size_t rows = std::min(kMaxRows, text.size() / kRow);
    std::array<std::uint8_t, kRow> counts{};
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t i = 0; i < kRow; ++i) counts[i] += text[kRow * row + i] == '\n';
    for (const std::uint8_t each : counts) count += each;
    text.remove_prefix(kRow * rows);
  }
  return count + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Counts the lines of a text up to given places, which must ascend.
class LineCounter {
 public:
  explicit LineCounter(std::string_view text) : text_(text) {}

  std::size_t line_of(std::size_t offset) {
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
  std::size_t line_ = 0;
};

/// Whether the O at `offset` may end the word GOTO.
static bool may_belong_to_goto(std::string_view text, std::size_t offset) {
  while (offset > 0 && text::is_blank(text[offset - 1])) --offset;
  if (offset == 0) return false;
  const char before = text::upper(text[offset - 1]);
  return before == 'G' || before == ')';
}

std::optional<double> misspelled_label(const syntax::LineTree& line) {
  if (line.words.empty()) return std::nullopt;
  const syntax::Word& first = line.words.front();
  std::string_view digits = line.text.substr(first.begin);
  if (first.letter != syntax::kNumber) {
    const char letter = text::upper(digits.front());
    const bool is_wrong_n = letter == 'N' && !first.is_plain_integer();
    const bool is_reported = std::any_of(line.findings.begin(), line.findings.end(),
                                         [&](const syntax::Finding& each) { return each.span.begin == first.begin; });
    const bool may_be_n = is_reported && std::string_view("BHJM").find(letter) != std::string_view::npos;
    if (!is_wrong_n && !may_be_n) return std::nullopt;
    digits.remove_prefix(1);
  }
  double number = 0;
  bool has_digit = false;
  for (const char c : digits) {
    if (text::is_blank(c)) continue;
    const bool is_o = text::upper(c) == 'O';
    if (!is_o && !text::is_digit(c)) break;
    number = 10 * number + (is_o ? 0 : c - '0');
    has_digit = true;
  }
  return has_digit ? std::optional(number) : std::nullopt;
}

bool may_hold_jumps(std::string_view text) {
  static constexpr std::string_view kLetters = "VvOo";
  return std::any_of(kLetters.begin(), kLetters.end(),
                     [&](char letter) { return text.find(letter) != std::string_view::npos; });
}

/// A line number at the start of a line, in the usual plain form.
struct PlainLabel {
  std::uint64_t number = 0;
  const char* end = nullptr;  ///< The place after the number; null if there is none or the line needs the parser.
};

static PlainLabel plain_label(const char* p, const char* end) {
  if (end - p < 20 || *p != 'N' || !text::is_digit(p[1])) return {};
  std::uint64_t label = 0;
  const char* at = p + 1;
  for (; at - p <= 15 && text::is_digit(*at); ++at) label = label * 10 + static_cast<std::uint64_t>(*at - '0');
  const bool is_plain = *at == ' ' && text::char_class(at[1]) == text::CharClass::Letter;
  return {label, is_plain ? at + 1 : nullptr};
}

/// The first O or o at or after `p`, or `end`. Tests 64 bytes at a time: for most programs this is the only search for
/// jumps.
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
  for (; end - p >= 16; p += 16)
    if (const auto found = static_cast<unsigned>(_mm_movemask_epi8(os_at(p))); found != 0)
      return p + std::countr_zero(found);
#endif
  return std::find_if(p, end, is_o);
}

/// The first N, O or V (of either case) at or after `p`, or `end`: every event contains one of them.
static const char* next_event_letter(const char* p, const char* end) {
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

/// Calls `take` with the events of a text and the starts of their lines. Most lines with such a letter have a plain
/// line number and no other event: that is so if the next such letter is on another line.
template <class Take>
static void scan_events(std::string_view text, Take take) {
  syntax::TreeStore store;
  const char* const end = text.data() + text.size();
  const char* labelled = nullptr;  // The start of a line whose plain label has not been reported yet.
  PlainLabel label;
  for (const char* p = next_event_letter(text.data(), end);;) {
    const char* begin = p;
    while (begin != text.data() && !text::is_line_end(begin[-1])) --begin;
    if (labelled && (p == end || begin != labelled))
      take(FlowEvent{.kind = FlowEvent::Kind::Label, .label = label.number}, labelled);
    if (p == end) return;
    label = p == begin && p != labelled ? plain_label(p, end) : PlainLabel{};
    labelled = label.end ? begin : nullptr;
    if (!labelled) {
      store.clear();
      label.end = store.append_line(begin, end);
      each_event(store.tree(0, begin), [&](const FlowEvent& event) { take(event, begin); });
    }
    p = next_event_letter(label.end, end);
  }
}

void each_event_in(std::string_view text, const std::function<void(const FlowEvent&)>& take) {
  LineCounter counter(text);
  scan_events(text, [&](FlowEvent event, const char* line) {
    event.line = static_cast<std::uint32_t>(counter.line_of(static_cast<std::size_t>(line - text.data())));
    take(event);
  });
}

namespace {

/// A jump, and where its line starts in the text.
struct FoundJump {
  std::size_t start = 0;
  syntax::Jump jump;
};

}  // namespace

/// Finds the jumps on some lines of a text, without parsing lines that hold none.
static void find_jumps(std::string_view text, std::size_t begin, std::size_t end, std::vector<FoundJump>& found) {
  syntax::TreeStore store;
  const char* const lines_end = text.data() + end;
  for (const char* p = text.data() + begin; (p = next_o(p, lines_end)) != lines_end;) {
    if (!may_belong_to_goto(text, static_cast<std::size_t>(p - text.data()))) {
      ++p;
      continue;
    }
    const char* line = p;
    while (line != text.data() && !text::is_line_end(line[-1])) --line;
    store.clear();
    p = store.append_line(line, lines_end);
    each_event(store.tree(0, line), [&](const FlowEvent& event) {
      if (event.kind == FlowEvent::Kind::Jump)
        found.push_back({static_cast<std::size_t>(line - text.data()), event.jump});
    });
  }
}

/// The jumps of a text, in their order; threads share the search.
static std::vector<FoundJump> find_jumps(std::string_view text, int jobs) {
  constexpr std::size_t kPartBytes = 1024 * 1024;
  const char* const end = text.data() + text.size();
  // The lines of a part start in it.
  const auto start_of = [&](std::size_t part) {
    const std::size_t place = std::min(part * kPartBytes, text.size());
    return place == 0 ? 0 : static_cast<std::size_t>(text::next_line(text.data() + place - 1, end) - text.data());
  };
  std::vector<std::vector<FoundJump>> found(text.size() / kPartBytes + 1);
  std::atomic<std::size_t> next_part = 0;
  threads::side_by_side(std::min(jobs, static_cast<int>(found.size())), [&] {
    for (std::size_t part = 0; (part = next_part++) < found.size();)
      find_jumps(text, start_of(part), start_of(part + 1), found[part]);
  });
  std::vector<FoundJump> all = std::move(found.front());
  for (auto part = found.begin() + 1; part != found.end(); ++part) all.insert(all.end(), part->begin(), part->end());
  return all;
}

/// The map of the jumps found in a text, without labels.
JumpMap JumpMap::of_jumps_in(std::string_view text, int jobs) {
  std::vector<Site> sites;
  std::vector<std::size_t> starts;
  LineCounter counter(text);
  for (const FoundJump& found : find_jumps(text, jobs)) {
    sites.push_back({counter.line_of(found.start), found.jump});
    starts.push_back(found.start);
  }
  JumpMap map(std::move(sites), nullptr);
  map.starts_ = std::move(starts);
  return map;
}

JumpMap::JumpMap(std::string_view text, int jobs) : JumpMap(of_jumps_in(text, jobs)) {
  if (compares_registers()) read_labels(text);
}

JumpMap JumpMap::with_labels(std::string_view text, int jobs) {
  JumpMap map = of_jumps_in(text, jobs);
  if (!map.empty()) map.read_labels(text);
  return map;
}

std::uint32_t JumpMap::count_above(std::size_t place) const {
  return static_cast<std::uint32_t>(std::lower_bound(starts_.begin(), starts_.end(), place) - starts_.begin());
}

JumpMap::JumpMap(std::vector<Site> sites, const JumpMap* before)
    : sites_(std::move(sites)), knows_labels_(sites_.empty()) {
  if (sites_.empty()) return;
  filter_.resize(16384);
  targets_.reserve(sites_.size());
  for (const Site& site : sites_) {
    targets_.push_back(site.jump.target);
    const std::size_t bit = filter_bit(site.jump.target);
    filter_[bit / 64] |= std::uint64_t{1} << (bit % 64);
  }
  sort_once(targets_);
  find_constants(before);
  reads_.resize(sites_.size());
}

/// The register that a jump compares, if that and its constant are known; else 0.
static int compared_by(const syntax::Jump& jump) {
  return jump.variable > 0 && jump.condition_is_known() ? jump.variable : 0;
}

/// Takes over the constants of registers that the same jumps compare as before: to sort them all takes longest.
void JumpMap::find_constants(const JumpMap* before) {
  RegisterSet differs = ~RegisterSet{0};
  if (before && sites_.size() == before->sites_.size()) {
    differs = 0;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const syntax::Jump& jump = sites_[i].jump;
      const syntax::Jump& old = before->sites_[i].jump;
      const int now = compared_by(jump);
      const int then = compared_by(old);
      if (now == then && (now == 0 || jump.value == old.value)) continue;
      differs |= register_bit(now) | register_bit(then);
    }
  }
  for (const Site& site : sites_) {
    const int reg = compared_by(site.jump);
    if (reg == 0) continue;
    compared_ |= register_bit(reg);
    if ((differs & register_bit(reg)) != 0) constants_[static_cast<std::size_t>(reg)].push_back(site.jump.value);
  }
  for (int reg = 1; reg <= dialect::kRegisterCount; ++reg) {
    std::vector<double>& values = constants_[static_cast<std::size_t>(reg)];
    if ((differs & register_bit(reg)) != 0) {
      sort_once(values);
    } else {
      values = before->constants(reg);
    }
  }
}

void JumpMap::add(std::vector<ReducedEvent>& events, const FlowEvent& event) {
  switch (event.kind) {
    case FlowEvent::Kind::Assignment:
      add_assignments(events, register_bit(event.reg));
      break;
    case FlowEvent::Kind::Label:
      add_place(events, event.kind, event.label);
      break;
    case FlowEvent::Kind::Jump:
      add_place(events, event.kind, event.jump.target);
      break;
  }
}

void JumpMap::read_labels(std::string_view text) {
  std::vector<ReducedEvent> events;
  scan_events(text, [&](const FlowEvent& event, const char*) {
    if (event.kind != FlowEvent::Kind::Label || names(event.label)) add(events, event);
  });
  follow(std::move(events));
}

/// Computes what depends on the order of jumps, labels and assignments.
void JumpMap::follow(std::vector<ReducedEvent> events) {
  // Labels mostly ascend, and so do those that jumps name: each is at the last place or the next one.
  std::size_t near_labels = 0;
  std::size_t near_jumps = 0;
  for (ReducedEvent& event : events) {
    std::size_t& near = event.kind == FlowEvent::Kind::Label ? near_labels : near_jumps;
    if (near + 1 < targets_.size() && targets_[near] < event.label) ++near;
    if (targets_[near] != event.label) {
      const auto found = std::lower_bound(targets_.begin(), targets_.end(), event.label);
      if (found == targets_.end() || *found != event.label) continue;
      near = static_cast<std::size_t>(found - targets_.begin());
    }
    event.target = near;
  }
  if (compares_registers()) find_reads(events);
  find_targets(events);
}

/// Goes from the end of the program to its start: as all jumps go forward, one pass finds which registers are read
/// later.
void JumpMap::find_reads(const std::vector<ReducedEvent>& events) {
  std::vector<RegisterSet> read_at_target(targets_.size());
  RegisterSet read = 0;
  std::size_t jump = sites_.size();
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    read &= ~event->assigned;
    if (event->kind == FlowEvent::Kind::Label) {
      if (event->target != kNone) read_at_target[event->target] = read;
      continue;
    }
    const int variable = sites_[--jump].jump.variable;
    reads_[jump].after = read;
    reads_[jump].at_target = read_at_target[event->target];
    read |= reads_[jump].at_target;
    if (variable > 0) read |= register_bit(variable);
    reads_[jump].before = read;
  }
}

/// A line's label takes effect before its jump, so an IF cannot jump to its own line (D51).
void JumpMap::find_targets(const std::vector<ReducedEvent>& events) {
  std::vector<std::size_t> last_definitions(targets_.size(), kNone);
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].kind != FlowEvent::Kind::Label || events[i].target == kNone) continue;
    if (std::exchange(last_definitions[events[i].target], i) != kNone) repeated_.insert(events[i].label);
  }
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].kind != FlowEvent::Kind::Jump) continue;
    const std::size_t last = last_definitions[events[i].target];
    targets_of_jumps_.push_back(last == kNone ? Target::NotFound : last > i ? Target::Below : Target::Above);
  }
  knows_labels_ = true;
}

std::size_t JumpMap::first_from(std::size_t line) const {
  const auto is_above = [&](const Site& site) { return site.line < line; };
  return static_cast<std::size_t>(std::partition_point(sites_.begin(), sites_.end(), is_above) - sites_.begin());
}

JumpMap JumpMap::moved(std::size_t first, const std::vector<Site>& sites, std::int64_t lines) && {
  const auto others = std::copy(sites.begin(), sites.end(), sites_.begin() + static_cast<std::ptrdiff_t>(first));
  for (auto site = others; site != sites_.end(); ++site) site->line += static_cast<std::size_t>(lines);
  return std::move(*this);
}

bool jump_alike(const syntax::Jump& a, const syntax::Jump& b) {
  return a.variable == b.variable && a.comparison == b.comparison &&
         (a.value == b.value || (std::isnan(a.value) && std::isnan(b.value))) && a.target == b.target;
}

bool FlowEvent::means_the_same(const FlowEvent& other) const {
  return kind == other.kind && reg == other.reg && label == other.label &&
         (kind != Kind::Jump || jump_alike(jump, other.jump));
}

bool JumpMap::is_equivalent(std::uint32_t jump, const JumpMap& other, std::uint32_t other_jump) const {
  return jump_alike(sites_[jump].jump, other.sites_[other_jump].jump) && reads_[jump] == other.reads_[other_jump] &&
         target_of(jump) == other.target_of(other_jump);
}

// --- JumpCollector

JumpCollector::JumpCollector(const JumpMap& before) : before_(&before) {
  sites_.reserve(before.sites().size());
  events_.reserve(2 * before.sites().size());
}

void JumpCollector::add(std::size_t line, const FlowEvent& event) {
  if (event.kind == FlowEvent::Kind::Jump) sites_.push_back({line, event.jump});
  JumpMap::add(events_, event);
}

void JumpCollector::add_jump(std::size_t line, const syntax::Jump& jump) {
  sites_.push_back({line, jump});
  JumpMap::add_place(events_, FlowEvent::Kind::Jump, jump.target);
}

JumpMap JumpCollector::finish() && {
  JumpMap map(std::move(sites_), before_);
  if (!map.empty()) map.follow(std::move(events_));
  return map;
}

}  // namespace isocnc::check
