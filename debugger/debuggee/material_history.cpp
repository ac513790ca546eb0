#include "debugger/debuggee/material_history.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "interpreter/verification/verifier.h"

namespace isocnc::debuggee {

using motion::Stretch;
using removal::Incident;
using removal::IncidentKind;
using removal::MaterialCheck;
using removal::Removed;
using simulation::Simulation;
using verification::Contact;

static constexpr double kToTheEnd = std::numeric_limits<double>::infinity();

/// States around the last question.
static constexpr std::size_t kLatest = 4;

MaterialHistory::MaterialHistory(const Debuggee& debuggee, const verification::Scene& scene,
                                 const removal::Workpiece& workpiece, const CopyLimits& limits)
    : debuggee_(debuggee),
      scene_(scene),
      machine_(debuggee.machine()),
      limits_(limits),
      begin_(std::make_shared<const BlockState>(BlockState{.check = MaterialCheck(workpiece, machine_)})),
      spacing_(limits.spacing) {}

// --- Cutting

/// What stretches have removed since the past was forgotten.
static Removed removed_so_far(const MaterialCheck& check) {
  Removed all;
  for (const Removed& each : check.removed_by_stretch()) all.add(each);
  return all;
}

static double first_parameter(const Stretch& stretch) { return stretch.phases[0].from; }
static double last_parameter(const Stretch& stretch) { return stretch.parameter_at(stretch.start + stretch.duration); }

static double length_of(const Stretch& stretch) { return last_parameter(stretch) - first_parameter(stretch); }

/// Whether more has been removed than what a dexel may be wrong.
static bool has_removed(const Removed& removed, double spacing) { return removed.volume > spacing * spacing * 1e-3; }

namespace {

/// Stretches of a block that follow one another without a stop for something else.
struct MotionRun {
  std::size_t begin = 0;  ///< Indices of pieces.
  std::size_t end = 0;
  double length = 0;  ///< Of the path, mm; degrees where B and C alone move.
};

/// Those around a piece, which is a stretch.
MotionRun run_around(const BlockRecord& record, std::size_t piece) {
  MotionRun run{.begin = piece, .end = piece};
  while (run.begin > 0 && record.pieces[run.begin - 1].stretch) --run.begin;
  while (run.end < record.pieces.size() && record.pieces[run.end].stretch) ++run.end;
  for (std::size_t i = run.begin; i < run.end; ++i) run.length += length_of(*record.pieces[i].stretch);
  return run;
}

/// Of a block that ends with a stretch.
MotionRun last_run_of(const BlockRecord& record) { return run_around(record, record.pieces.size() - 1); }

}  // namespace

/// What happens in a block up to a moment. Tools are changed where the machine does it; other events take effect as the
/// block begins to move, or after its motions.
void MaterialHistory::feed(MaterialCheck& check, const BlockRecord& record, double until) const {
  geometry::Frame frame = record.frame;
  auto event = record.events.begin();
  const auto take_events = [&](bool takes_all) {
    for (; event != record.events.end(); ++event) {
      const bool is_motion = std::holds_alternative<running::MoveEvent>(event->what);
      if (is_motion && !takes_all) return;
      if (is_motion || std::holds_alternative<running::ToolEvent>(event->what)) continue;
      if (const auto* const other = std::get_if<running::FrameEvent>(&event->what)) frame = other->in_force;
      check.take(timing::TimedEvent{.event = *event, .start = record.start, .move = {}});
    }
  };
  for (const RecordedPiece& piece : record.pieces) {
    if (piece.end() > until && piece.start() >= until) break;
    if (const auto* const tool = std::get_if<running::ToolEvent>(&piece.timed.event.what)) {
      if (piece.end() > until) break;
      const verification::MountedTool mounted = verification::mounted_tool(scene_, machine_, tool->tool);
      check.mount(tool->tool, verification::cutting_tool(scene_, mounted), piece.timed.event, piece.end(), frame,
                  piece.timed.ends_at_known_place);
    }
    if (!piece.stretch) continue;
    take_events(false);
    if (piece.end() <= until) {
      check.take(*piece.stretch, removal::MotionFacts(piece.timed), frame);
    } else {
      check.take_part(*piece.stretch, removal::MotionFacts(piece.timed), frame, first_parameter(*piece.stretch),
                      piece.stretch->parameter_at(until));
    }
  }
  if (until == kToTheEnd) take_events(true);
}

/// A copy that is cut up to a moment within the next block, and has forgotten what was before the block.
MaterialCheck MaterialHistory::cut_until(const BlockState& from, const BlockRecord& record, double time) const {
  MaterialCheck check = from.check;
  check.stop_asking();
  check.forget_past();
  feed(check, record, time);
  check.settle();
  return check;
}

/// Cuts blocks, some of them at once: the tiles are gone through once for all of them.
class MaterialHistory::BlockCutting {
 public:
  /// Refers to both.
  BlockCutting(const MaterialHistory& history, BlockState& state) : history_(history), state_(state) {
    state.check.settle();
    state.check.forget_past();
    count_ = state.check.stretch_count();
  }

  void take(const BlockRecord& record) {
    history_.feed(state_.check, record, kToTheEnd);
    blocks_.push_back({.number = record.block, .end = state_.check.stretch_count() - count_});
    if (!record.pieces.empty()) {
      blocks_.back().takes_time = true;
      if (record.pieces.back().stretch) blocks_.back().last_way = last_run_of(record).length;
    }
    // Long motions take more dexels than short ones.
    const double spacing = state_.check.stock().spacing();
    for (const RecordedPiece& piece : record.pieces)
      if (piece.stretch) state_.work += 1 + length_of(*piece.stretch) / (8 * spacing);
    ++state_.block;
  }
  std::size_t waiting() const { return blocks_.empty() ? 0 : blocks_.back().end; }

  void finish() {
    state_.check.settle();
    const std::vector<Removed>& removed = state_.check.removed_by_stretch();
    const double spacing = state_.check.stock().spacing();
    std::size_t stretch = 0;
    for (const TakenBlock& each : blocks_) {
      state_.last = {};
      for (; stretch < each.end; ++stretch) state_.last.add(removed[stretch]);
      if (!each.takes_time) continue;
      if (!each.last_way) {
        state_.cut_block.reset();
      } else if (has_removed(state_.last, spacing)) {
        state_.cut_block = each.number;
        state_.free_way = 0;
      } else {
        state_.free_way += *each.last_way;
      }
    }
    blocks_.clear();
  }

 private:
  struct TakenBlock {
    std::uint64_t number = 0;
    std::size_t end = 0;  ///< Stretches up to its end.
    bool takes_time = false;
    std::optional<double> last_way;  ///< Of the motion at its end; none if it does not end with one.
  };

  const MaterialHistory& history_;
  BlockState& state_;
  std::size_t count_ = 0;  ///< Stretches before.
  std::vector<TakenBlock> blocks_;
};

void MaterialHistory::apply(BlockState& state, const BlockRecord& record) const {
  BlockCutting cutting(*this, state);
  cutting.take(record);
  cutting.finish();
}

// --- Copies

MaterialHistory::StatePointer MaterialHistory::nearest(std::uint64_t block) const {
  StatePointer best = begin_;
  const auto consider = [&](const StatePointer& state) {
    if (state->block <= block && (best == begin_ || state->block > best->block)) best = state;
  };
  if (const auto after = copies_.upper_bound(block); after != copies_.begin()) consider(std::prev(after)->second.state);
  if (const auto after = nearby_.upper_bound(block); after != nearby_.begin()) consider(std::prev(after)->second.state);
  for (const StatePointer& state : latest_) consider(state);
  return best;
}

/// Before a block, after what has been run by hand there.
MaterialHistory::StatePointer MaterialHistory::before(std::uint64_t block) {
  const StatePointer start = nearest(block);
  if (start != begin_ && start->block == block) return start;
  constexpr std::size_t kAtOnce = 256;
  auto moving = std::make_shared<BlockState>(*start);
  std::optional<BlockCutting> cutting;
  const auto begin = [&] {
    if (moving.use_count() > 1) moving = std::make_shared<BlockState>(*moving);  // What is kept stays as it is.
    cutting.emplace(*this, *moving);
  };
  const auto finish = [&] {
    if (cutting) cutting->finish();
    cutting.reset();
  };
  const auto pass_block = [&](Simulation& simulation) {
    if (!cutting) begin();
    cutting->take(record_block(simulation));
    if (cutting->waiting() < kAtOnce) return;
    finish();
    if (moving->block < block && !debuggee_.is_run_by_hand_at(moving->block)) keep(moving);
  };
  const auto pass_by_hand = [&](Simulation& simulation) {
    finish();
    begin();
    cutting.reset();
    while (!simulation.has_ended()) feed(moving->check, record_block(simulation), kToTheEnd);
    moving->check.settle();
    moving->last = removed_so_far(moving->check);
    moving->cut_block.reset();
  };
  debuggee_.pass_blocks(start == begin_ ? std::nullopt : std::optional(start->block), block, pass_block, pass_by_hand);
  finish();
  remember(moving);
  return moving;
}

/// Bytes of the tiles that a stock does not share with another one.
static std::size_t bytes_beside(const stock::Stock& stock, const stock::Stock& other) {
  std::size_t bytes = 0;
  for (const stock::TileIndex& index : stock.tiles_changed_since(other)) bytes += stock.tile(index).memory();
  return bytes;
}

/// Keeps a state that is far enough from those that are kept.
void MaterialHistory::keep(const StatePointer& state) {
  const auto after = copies_.lower_bound(state->block);
  const StatePointer& last = after == copies_.begin() ? begin_ : std::prev(after)->second.state;
  const bool is_near_next = after != copies_.end() && after->second.state->work < state->work + spacing_;
  if (state->work >= last->work + spacing_ && !is_near_next) {
    copies_.emplace_hint(after, state->block,
                         KeptCopy{.state = state, .bytes = bytes_beside(state->check.stock(), last->check.stock())});
    thin_out(copies_, limits_.bytes, spacing_);
    return;
  }
  const double close = limits_.spacing / 16;
  const auto next = nearby_.lower_bound(state->block);
  if (next != nearby_.end() && next->second.state->work < state->work + close) return;
  const StatePointer& known = next == nearby_.begin() ? last : std::prev(next)->second.state;
  if (std::max(known->work, last->work) + close > state->work) return;
  nearby_.emplace_hint(next, state->block,
                       KeptCopy{.state = state, .bytes = bytes_beside(state->check.stock(), known->check.stock())});
  while (nearby_.size() > limits_.nearby || (nearby_.size() > 1 && bytes_of(nearby_) > limits_.bytes / 4)) {
    const bool is_first_farther = state->block - nearby_.begin()->first > nearby_.rbegin()->first - state->block;
    nearby_.erase(is_first_farther ? nearby_.begin() : std::prev(nearby_.end()));
  }
}

/// Keeps the answer to a question.
void MaterialHistory::remember(const StatePointer& state) {
  keep(state);
  latest_.push_back(state);
  if (latest_.size() > kLatest) latest_.pop_front();
}

std::size_t MaterialHistory::bytes_of(const Copies& copies) {
  std::size_t bytes = 0;
  for (const auto& [block, copy] : copies) bytes += copy.bytes;
  return bytes;
}

/// Removes every other copy until the rest takes no more than `limit` bytes.
void MaterialHistory::thin_out(Copies& copies, std::size_t limit, double& spacing) const {
  while (copies.size() > 1 && bytes_of(copies) > limit) {
    StatePointer last = begin_;
    bool is_odd = false;
    for (auto each = copies.begin(); each != copies.end(); is_odd = !is_odd) {
      if (!is_odd) {
        each = copies.erase(each);
        continue;
      }
      each->second.bytes = bytes_beside(each->second.state->check.stock(), last->check.stock());
      last = each->second.state;
      ++each;
    }
    spacing *= 2;
  }
}

void MaterialHistory::forget_from(std::uint64_t blocks) {
  copies_.erase(copies_.lower_bound(blocks), copies_.end());
  nearby_.erase(nearby_.lower_bound(blocks), nearby_.end());
  std::erase_if(latest_, [&](const StatePointer& state) { return state->block >= blocks; });
  if (record_ && record_->block + 1 >= blocks) record_.reset();
  moment_.reset();
  ends_in_cut_.erase(ends_in_cut_.lower_bound(blocks > 0 ? blocks - 1 : 0), ends_in_cut_.end());
}

std::size_t MaterialHistory::memory() const { return bytes_of(copies_) + bytes_of(nearby_); }

// --- Moments

BlockRecord MaterialHistory::record_of(std::uint64_t block) const {
  BlockRecord record{.block = block};
  debuggee_.pass_blocks(
      block, block + 1, [&](Simulation& simulation) { record = record_block(simulation); }, [](Simulation&) {});
  return record;
}

const BlockRecord& MaterialHistory::record(std::uint64_t block) {
  if (!record_ || record_->block != block) record_ = record_of(block);
  return *record_;
}

const MaterialHistory::CutMoment& MaterialHistory::moment_of(const Simulation& simulation) {
  const bool is_in_block = simulation.is_in_block();
  const std::uint64_t block = simulation.blocks() - (is_in_block ? 1 : 0);
  const double time = is_in_block ? simulation.time() : 0;
  if (moment_ && moment_->block == block && moment_->is_in_block == is_in_block && moment_->time == time)
    return *moment_;
  StatePointer state = before(block);
  if (is_in_block) {
    const auto within = std::make_shared<BlockState>(BlockState{.check = cut_until(*state, record(block), time)});
    within->last = removed_so_far(within->check);
    state = within;
  }
  moment_ = {.block = block, .is_in_block = is_in_block, .time = time, .state = state};
  return *moment_;
}

const stock::Stock& MaterialHistory::stock_at(const Simulation& simulation) {
  return moment_of(simulation).state->check.stock();
}

Removed MaterialHistory::removed_at(const Simulation& simulation) { return moment_of(simulation).state->last; }

bool MaterialHistory::is_in_cut(const Simulation& simulation) {
  if (!simulation.is_in_block()) return ends_in_cut(simulation.blocks());
  const std::uint64_t number = simulation.blocks() - 1;
  const bool was_in_cut = ends_in_cut(number);
  const BlockRecord& block = record(number);
  if (block.pieces.empty()) return was_in_cut;
  const double time = simulation.time();
  std::size_t now = 0;
  while (now + 1 < block.pieces.size() && !(block.pieces[now].end() > time)) ++now;
  if (block.pieces[now].start() > time) return was_in_cut;
  return block.pieces[now].stretch && in_cut_pieces(*before(number), block, now, time).back().is_in_cut;
}

/// Where nothing has been removed, the cutter is in the cut until its way is as long as the dexels are apart: between
/// two dexels it meets none.
bool MaterialHistory::ends_in_cut(std::uint64_t block) {
  const StatePointer state = before(block);
  if (!state->cut_block || !(state->free_way < state->check.stock().spacing())) return false;
  const std::uint64_t cut_block = *state->cut_block;
  if (const auto known = ends_in_cut_.find(cut_block); known != ends_in_cut_.end()) return known->second;
  const BlockRecord& last = record(cut_block);
  const bool ends_in_cut = in_cut_pieces(*before(cut_block), last, last.pieces.size() - 1, kToTheEnd).back().is_in_cut;
  constexpr std::size_t kKnown = 1000;
  if (ends_in_cut_.size() >= kKnown) ends_in_cut_.erase(ends_in_cut_.begin());
  ends_in_cut_[cut_block] = ends_in_cut;
  return ends_in_cut;
}

/// The pieces, of a length, of the stretches around a piece of a block, up to the one of a moment.
std::vector<MaterialHistory::InCutPiece> MaterialHistory::in_cut_pieces(const BlockState& from,
                                                                        const BlockRecord& record, std::size_t piece,
                                                                        double until) const {
  constexpr double kMaxPieces = 4096;
  const MotionRun run = run_around(record, piece);
  MaterialCheck check = cut_until(from, record, record.pieces[run.begin].start());
  const double spacing = check.stock().spacing();
  const double count = std::clamp(std::floor(run.length / spacing + 1e-9), 1.0, kMaxPieces);
  const auto begin_of = [&](std::size_t number) { return run.length * (static_cast<double>(number) / count); };
  std::vector<InCutPiece> pieces;
  const auto end_piece = [&] {
    check.settle();
    if (!pieces.empty()) pieces.back().is_in_cut = has_removed(removed_so_far(check), spacing);
    check.forget_past();
  };
  double passed = 0;  // Length of the stretches before.
  for (std::size_t i = run.begin; i < run.end; ++i) {
    const Stretch& stretch = *record.pieces[i].stretch;
    const double first = first_parameter(stretch);
    const double length = length_of(stretch);
    for (double done = 0, end = 0; done == 0 || done < length; done = end) {
      constexpr double kRounding = 1e-9;
      const bool is_next = static_cast<double>(pieces.size()) < count;
      if (is_next && !(begin_of(pieces.size()) > passed + done + kRounding)) {
        const double time = done > 0 ? stretch.time_at(first + done) : stretch.start;
        end_piece();
        if (time > until) return pieces;
        pieces.push_back({.time = time});
      }
      end = static_cast<double>(pieces.size()) < count ? std::min(begin_of(pieces.size()) - passed, length) : length;
      check.take_part(stretch, removal::MotionFacts(record.pieces[i].timed), record.frame, first + done,
                      end < length ? first + end : last_parameter(stretch));
      if (!(end > done)) break;  // Of no length.
    }
    passed += length;
  }
  end_piece();
  const bool is_short = run.length < spacing && run.begin == 0;
  if (is_short && from.cut_block && from.free_way + run.length < spacing) pieces.back().is_in_cut = true;
  return pieces;
}

// --- Blocks

MaterialHistory::BlockAnswers MaterialHistory::examine(const BlockRecord& record, const BlockQuestions& questions) {
  const StatePointer from = before(record.block);
  const auto to = std::make_shared<BlockState>(*from);
  apply(*to, record);
  BlockAnswers answers;
  if (questions.contacts) find_contacts(record, *from, *to, answers);
  find_crossings(record, *from, *to, questions, answers);
  record_ = record;
  if (debuggee_.is_run_by_hand_at(to->block)) return answers;
  remember(to);
  return answers;
}

static bool is_error(const Incident& incident) {
  return dialect::definition(verification::diagnostic_of(incident.kind)).severity == dialect::Severity::Error;
}

static bool is_same(const Incident& a, const Incident& b) { return a.kind == b.kind && a.time == b.time; }

void MaterialHistory::find_contacts(const BlockRecord& record, const BlockState& from, const BlockState& to,
                                    BlockAnswers& answers) const {
  const std::vector<Incident> all_known = from.check.incidents_so_far();
  for (const Incident& each : to.check.incidents_so_far()) {
    if (!is_error(each)) continue;
    const auto known =
        std::find_if(all_known.begin(), all_known.end(), [&](const Incident& other) { return is_same(each, other); });
    if (known == all_known.end()) {
      if (each.time >= record.start) answers.contacts.push_back(verification::contact_of(each, scene_));
    } else if (each.amount > known->amount + kDeeper) {
      answers.deeper.push_back(verification::contact_of(each, scene_));
    }
  }
}

void MaterialHistory::find_crossings(const BlockRecord& record, const BlockState& from, const BlockState& to,
                                     const BlockQuestions& questions, BlockAnswers& answers) {
  for (std::size_t i = 0; i < questions.limits.size(); ++i) {
    const SurroundingsLimit& limit = questions.limits[i];
    std::vector<double> times;
    if (limit.of == LimitedQuantity::Removed) times = removed_crossings(limit, record, from, to);
    if (limit.of == LimitedQuantity::InCut) times = in_cut_crossings(limit, record, from, to);
    for (const double time : times) answers.crossings.push_back({.time = time, .limit = i});
  }
}

/// What is removed grows from 0 while a block goes on.
std::vector<double> MaterialHistory::removed_crossings(const SurroundingsLimit& limit, const BlockRecord& record,
                                                       const BlockState& from, const BlockState& to) const {
  constexpr double kMoment = 1e-7;  // Seconds: less than any way that matters.
  if (!limit.is_beyond(from.last.volume) && limit.is_beyond(0)) return {record.start};
  if (limit.is_beyond(0) || !limit.is_beyond(to.last.volume)) return {};
  const auto is_beyond_at = [&](double time) {
    return limit.is_beyond(removed_so_far(cut_until(from, record, time)).volume);
  };
  double before = record.start;
  double after = record.end;
  while (after - before > kMoment) {
    const double middle = before + (after - before) / 2;
    if (!(middle > before && middle < after)) break;
    (is_beyond_at(middle) ? after : before) = middle;
  }
  return {after};
}

std::vector<double> MaterialHistory::in_cut_crossings(const SurroundingsLimit& limit, const BlockRecord& record,
                                                      const BlockState& from, const BlockState& to) {
  std::vector<double> times;
  bool was_in_cut = ends_in_cut(record.block);
  const auto pass = [&](double time, bool is_in_cut) {
    if (is_in_cut != was_in_cut && limit.is_beyond(is_in_cut ? 1 : 0)) times.push_back(time);
    was_in_cut = is_in_cut;
  };
  for (std::size_t i = 0; i < record.pieces.size(); ++i) {
    if (!record.pieces[i].stretch) {
      pass(record.pieces[i].start(), false);
      continue;
    }
    for (const InCutPiece& each : in_cut_pieces(from, record, i, kToTheEnd)) pass(each.time, each.is_in_cut);
    i = run_around(record, i).end - 1;
  }
  if (to.cut_block == record.block) ends_in_cut_[record.block] = was_in_cut;
  return times;
}

}  // namespace isocnc::debuggee
