#include "interpreter/comparison/operation_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "interpreter/comparison/change_list.h"

namespace isocnc::comparison {

namespace {

/// Compared with each other, more would take too long.
constexpr std::size_t kMaxOperations = 2000;

/// From a tool change to the next one or to the epilogue.
struct ComparedOperation {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t partner = kNone;  ///< Index of the same operation of the other run.
  /// Rapids on the way there that the partner does not make, since it is there already.
  std::vector<std::size_t> left_out = {};

  bool leaves_out(std::size_t action) const {
    return std::find(left_out.begin(), left_out.end(), action) != left_out.end();
  }
};

/// The epilogue, the last actions, is in none of them.
std::vector<ComparedOperation> operations_of(const RecordedRun& run, std::size_t epilogue) {
  std::vector<ComparedOperation> operations;
  const std::size_t last = run.actions.size() - epilogue;
  for (std::size_t i = 0; i < last; ++i)
    if (run.actions[i].kind == ActionKind::Tool) operations.push_back({i, last});
  for (std::size_t i = 1; i < operations.size(); ++i) operations[i - 1].end = operations[i].begin;
  return operations;
}

const execution::ToolCode& tool_at(const RecordedRun& run, const ComparedOperation& operation) {
  return run.tools[run.actions[operation.begin].tool].code;
}

/// The tool of the operation before one; with the line of its M06 where it is used several times. Empty for none.
std::string tool_before(const RecordedRun& run, const std::vector<ComparedOperation>& operations, std::size_t index) {
  if (index == 0) return "";
  const execution::ToolCode& tool = tool_at(run, operations[index - 1]);
  const auto uses = std::count_if(operations.begin(), operations.end(),
                                  [&](const ComparedOperation& each) { return tool_at(run, each) == tool; });
  const std::string name = running::tool_name(tool);
  return uses < 2 ? name : name + "@" + std::to_string(run.actions[operations[index - 1].begin].line + 1);
}

/// How many actions both runs end with that are no motions, as M05 and M02; 1 where the runs end differently.
std::size_t common_epilogue(const RunPair& runs) {
  const std::size_t fewer = std::min(runs.a.actions.size(), runs.b.actions.size());
  std::size_t count = 0;
  while (count < fewer) {
    const MachineAction& left = runs.a.actions[runs.a.actions.size() - 1 - count];
    const MachineAction& right = runs.b.actions[runs.b.actions.size() - 1 - count];
    if (left.is_motion() || left.kind == ActionKind::Tool || left.kind != right.kind ||
        !is_same_effect(runs, left, right))
      break;
    ++count;
  }
  return std::max<std::size_t>(count, 1);
}

/// Finds which operations of two runs belong together, and brings them into one order.
class OperationSorter {
 public:
  OperationSorter(const RunPair& runs, const ComparisonOptions& options, std::size_t epilogue)
      : runs_(runs),
        options_(options),
        epilogue_(epilogue),
        of_a_(operations_of(runs.a, epilogue)),
        of_b_(operations_of(runs.b, epilogue)) {}

  /// Too many are not compared with each other.
  bool are_few() const { return of_a_.size() <= kMaxOperations && of_b_.size() <= kMaxOperations; }

  /// Pairs operations that do the same: those at both ends as they stand, the others wherever they are. Returns how
  /// many are left without a partner.
  std::size_t pair_exact() {
    const std::size_t fewer = std::min(of_a_.size(), of_b_.size());
    std::size_t first = 0;
    while (first < fewer && pair_if_same(first, first)) ++first;
    for (std::size_t last = 1; last + first <= fewer && pair_if_same(of_a_.size() - last, of_b_.size() - last);) ++last;
    std::map<std::pair<execution::ToolCode, std::size_t>, std::vector<std::size_t>> known;
    for (std::size_t k = 0; k < of_b_.size(); ++k)
      if (of_b_[k].partner == ComparedOperation::kNone)
        known[{tool_at(runs_.b, of_b_[k]), size_of_work(runs_.b, of_b_[k])}].push_back(k);
    for (std::size_t i = 0; i < of_a_.size(); ++i) {
      if (of_a_[i].partner != ComparedOperation::kNone) continue;
      for (const std::size_t k : known[{tool_at(runs_.a, of_a_[i]), size_of_work(runs_.a, of_a_[i])}])
        if (pair_if_same(i, k)) break;
    }
    return alone(of_a_).size() + alone(of_b_).size();
  }

  std::optional<OrderedRuns> sort() {
    if (!pair_rest()) return std::nullopt;
    const std::vector<bool> stays = staying();
    // Runs are copied only where there is something to tell.
    const bool is_same_order = std::find(stays.begin(), stays.end(), false) == stays.end() && alone(of_b_).empty();
    if (is_same_order) return std::nullopt;
    OrderedRuns ordered{.a = runs_.a, .b = runs_.b, .changes = {}};
    ordered.a.actions = {runs_.a.actions.begin(), runs_.a.actions.begin() + prologue(runs_.a, of_a_)};
    ordered.b.actions = {runs_.b.actions.begin(), runs_.b.actions.begin() + prologue(runs_.b, of_b_)};
    std::vector<std::size_t> place_of_a(of_a_.size() + 1);  // Where each begins now.
    std::vector<std::size_t> place_of_b(of_b_.size() + 1);
    for (std::size_t i = 0; i < of_a_.size(); ++i) {
      const std::size_t partner = of_a_[i].partner;
      place_of_a[i] = ordered.a.actions.size();
      if (partner == ComparedOperation::kNone) continue;
      place_of_b[partner] = ordered.b.actions.size();
      append(runs_.a, of_a_[i], ordered.a);
      append(runs_.b, of_b_[partner], ordered.b);
      same_way_there(of_a_[i], of_b_[partner], ordered, place_of_a[i], place_of_b[partner]);
      if (!stays[i]) ordered.changes.push_back({moved(i), place_of_a[i]});
    }
    for (std::size_t i = 0; i < of_a_.size(); ++i)
      if (of_a_[i].partner == ComparedOperation::kNone)
        ordered.changes.push_back({only(ChangeKind::Removed, i), place_of_a[i]});
    for (std::size_t k = 0; k < of_b_.size(); ++k) {
      if (of_b_[k].partner != ComparedOperation::kNone) continue;
      place_of_b[k] = ordered.b.actions.size();
      const std::size_t after = k + 1 < of_b_.size() ? of_b_[k + 1].partner : ComparedOperation::kNone;
      ordered.changes.push_back({only(ChangeKind::Added, k),
                                 after == ComparedOperation::kNone ? ordered.a.actions.size() : place_of_a[after]});
    }
    finish(runs_.a, of_a_, place_of_a, ordered.a);
    finish(runs_.b, of_b_, place_of_b, ordered.b);
    return ordered;
  }

 private:
  using Difference = std::vector<MachineAction>::difference_type;

  /// How many actions come before the first operation.
  Difference prologue(const RecordedRun& run, const std::vector<ComparedOperation>& operations) const {
    return static_cast<Difference>(operations.empty() ? run.actions.size() - epilogue_ : operations[0].begin);
  }

  /// How many actions an operation has from its first feed move on.
  static std::size_t size_of_work(const RecordedRun& run, const ComparedOperation& operation) {
    std::size_t first = operation.begin;
    while (first < operation.end && (!run.actions[first].is_motion() || run.actions[first].is_rapid)) ++first;
    return operation.end - first;
  }

  /// Where the machine stands before an action.
  static geometry::Pose place_before(const RecordedRun& run, std::size_t action) {
    for (std::size_t i = action; i < run.actions.size(); ++i)
      if (run.actions[i].is_motion()) return run.actions[i].from;
    return {};
  }

  /// Whether a rapid takes the axes that it moves to where those of the other run stand already, before an action.
  bool is_there(const MachineAction& motion, const RecordedRun& other, std::size_t action) const {
    if (!motion.is_motion() || !motion.is_rapid || motion.is_by_joints) return false;
    const geometry::Pose place = place_before(other, action);
    const auto is_at = [&](double from, double to, double there) {
      return from == to || std::abs(to - there) <= options_.tolerance;
    };
    for (int axis = 0; axis < 3; ++axis)
      if (!is_at(motion.from.tip[axis], motion.to.tip[axis], place.tip[axis])) return false;
    return is_at(motion.from.b, motion.to.b, place.b) && is_at(motion.from.c, motion.to.c, place.c);
  }

  /// What both leave out of the way there.
  using LeftOut = std::pair<std::vector<std::size_t>, std::vector<std::size_t>>;

  /// Whether both do the same, but for where the axes stand that the way there leaves where they are; and rapids to
  /// where one of them stands already.
  std::optional<LeftOut> same_but_for_way(const ComparedOperation& left, const ComparedOperation& right) const {
    bool is_on_the_way = true;
    bool has_other_way = false;
    LeftOut left_out;
    std::size_t i = left.begin;
    std::size_t k = right.begin;
    while (i < left.end && k < right.end) {
      const MachineAction& one = runs_.a.actions[i];
      const MachineAction& other = runs_.b.actions[k];
      if (is_same_alone(runs_, options_, one, other)) {
        if (one.is_motion()) is_on_the_way = false;
        ++i, ++k;
        continue;
      }
      if (!is_on_the_way) return std::nullopt;
      has_other_way = true;
      if (goes_along(one, other)) {
        ++i, ++k;
      } else if (is_there(one, runs_.b, k)) {
        left_out.first.push_back(i++);
      } else if (is_there(other, runs_.a, i)) {
        left_out.second.push_back(k++);
      } else {
        return std::nullopt;
      }
    }
    const bool is_same = i == left.end && k == right.end && (!has_other_way || !is_on_the_way);
    return is_same ? std::optional(left_out) : std::nullopt;
  }

  /// Whether two rapids take the axes that they move to the same places.
  bool goes_along(const MachineAction& one, const MachineAction& other) const {
    if (!one.is_rapid || !other.is_rapid || one.is_by_joints || other.is_by_joints) return false;
    const auto is_equal = [&](double left_from, double left_to, double right_from, double right_to) {
      return std::abs(left_to - right_to) <= options_.tolerance || (left_from == left_to && right_from == right_to);
    };
    for (int axis = 0; axis < 3; ++axis)
      if (!is_equal(one.from.tip[axis], one.to.tip[axis], other.from.tip[axis], other.to.tip[axis])) return false;
    return is_equal(one.from.b, one.to.b, other.from.b, other.to.b) &&
           is_equal(one.from.c, one.to.c, other.from.c, other.to.c);
  }

  bool pair_if_same(std::size_t i, std::size_t k) {
    const ComparedOperation& left = of_a_[i];
    const ComparedOperation& right = of_b_[k];
    if (right.partner != ComparedOperation::kNone || tool_at(runs_.a, left) != tool_at(runs_.b, right)) return false;
    std::optional<LeftOut> left_out = same_but_for_way(left, right);
    if (!left_out) return false;
    pair(i, k);
    std::tie(of_a_[i].left_out, of_b_[k].left_out) = std::move(*left_out);
    return true;
  }

  void pair(std::size_t i, std::size_t k) {
    of_a_[i].partner = k;
    of_b_[k].partner = i;
  }

  static std::vector<std::size_t> alone(const std::vector<ComparedOperation>& operations) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < operations.size(); ++i)
      if (operations[i].partner == ComparedOperation::kNone) indices.push_back(i);
    return indices;
  }

  /// Whether an operation that only one run has is missing in the other one, and not only its tool change: then what
  /// comes before it would have its actions there.
  /// `prologue` is how many actions the other run has before its first operation.
  static bool is_missing(const std::vector<ComparedOperation>& operations, const std::vector<ComparedOperation>& others,
                         std::size_t index, Difference prologue) {
    const auto size = [](const ComparedOperation& operation) { return operation.end - operation.begin; };
    const std::size_t half = size(operations[index]) / 2;
    if (index == 0) return static_cast<std::size_t>(prologue) <= operations[0].begin + half;
    const ComparedOperation& before = operations[index - 1];
    return before.partner == ComparedOperation::kNone || size(others[before.partner]) <= size(before) + half;
  }

  /// Those that are otherwise keep their order; false where it is not clear which of them belong together.
  bool pair_rest() {
    // As many of both: those in the same place got another tool. Else some are more.
    const bool are_as_many = alone(of_a_).size() == alone(of_b_).size();
    if (are_as_many) pair_by_place();
    pair_by_tool(alone(of_a_), alone(of_b_));
    if (!are_as_many) pair_by_place();
    const std::vector<std::size_t> a_left = alone(of_a_);
    const std::vector<std::size_t> b_left = alone(of_b_);
    if (a_left.empty() && b_left.empty()) return true;
    // After an error nothing is done: that has not been removed.
    if (runs_.a.actions.back().number != runs_.b.actions.back().number) return false;
    const Difference a_prologue = prologue(runs_.a, of_a_);
    const Difference b_prologue = prologue(runs_.b, of_b_);
    return std::all_of(a_left.begin(), a_left.end(),
                       [&](std::size_t i) { return is_missing(of_a_, of_b_, i, b_prologue); }) &&
           std::all_of(b_left.begin(), b_left.end(),
                       [&](std::size_t k) { return is_missing(of_b_, of_a_, k, a_prologue); });
  }

  /// Pairs operations that come after the same ones.
  void pair_by_place() {
    for (const std::size_t i : alone(of_a_)) {
      const bool has_place = i == 0 || of_a_[i - 1].partner != ComparedOperation::kNone;
      if (!has_place) continue;
      const std::size_t k = i == 0 ? 0 : of_a_[i - 1].partner + 1;
      if (k < of_b_.size() && of_b_[k].partner == ComparedOperation::kNone) pair(i, k);
    }
  }

  /// Pairs as many operations of the same tools as possible, in their order.
  void pair_by_tool(const std::vector<std::size_t>& a_alone, const std::vector<std::size_t>& b_alone) {
    const std::size_t columns = b_alone.size() + 1;
    std::vector<std::size_t> best((a_alone.size() + 1) * columns);  // Of the rest from each pair of places on.
    const auto is_same_tool = [&](std::size_t i, std::size_t k) {
      return tool_at(runs_.a, of_a_[a_alone[i]]) == tool_at(runs_.b, of_b_[b_alone[k]]);
    };
    for (std::size_t i = a_alone.size(); i-- > 0;)
      for (std::size_t k = b_alone.size(); k-- > 0;)
        best[i * columns + k] = is_same_tool(i, k) ? best[(i + 1) * columns + k + 1] + 1
                                                   : std::max(best[(i + 1) * columns + k], best[i * columns + k + 1]);
    for (std::size_t i = 0, k = 0; i < a_alone.size() && k < b_alone.size();) {
      if (is_same_tool(i, k)) {
        pair(a_alone[i++], b_alone[k++]);
      } else {
        best[(i + 1) * columns + k] >= best[i * columns + k + 1] ? ++i : ++k;
      }
    }
  }

  /// The operations of a that keep their order in b: as many actions as possible.
  std::vector<bool> staying() const {
    std::vector<std::size_t> best(of_a_.size());  // Actions of the heaviest row that ends with each.
    std::vector<std::size_t> before(of_a_.size(), ComparedOperation::kNone);
    std::size_t last = ComparedOperation::kNone;
    for (std::size_t i = 0; i < of_a_.size(); ++i) {
      if (of_a_[i].partner == ComparedOperation::kNone) continue;
      for (std::size_t j = 0; j < i; ++j) {
        if (of_a_[j].partner == ComparedOperation::kNone || of_a_[j].partner > of_a_[i].partner || best[j] <= best[i])
          continue;
        best[i] = best[j];
        before[i] = j;
      }
      best[i] += of_a_[i].end - of_a_[i].begin;
      if (last == ComparedOperation::kNone || best[i] > best[last]) last = i;
    }
    std::vector<bool> stays(of_a_.size());
    for (; last != ComparedOperation::kNone; last = before[last]) stays[last] = true;
    return stays;
  }

  static BehaviorChange described(ChangeKind kind) {
    BehaviorChange change;
    change.kind = kind;
    return change;
  }

  void describe_old(const RecordedRun& run, const ComparedOperation& operation, BehaviorChange& change) const {
    change.old_lines = lines_of(run, operation.begin, operation.end);
    change.old_start = run.actions[operation.begin].line;
    change.old_motions = motion_count(run, operation.begin, operation.end);
    change.old_tool = tool_at(run, operation);
    change.seconds -= run.actions[operation.end].start - run.actions[operation.begin].start;
  }
  void describe_new(const RecordedRun& run, const ComparedOperation& operation, BehaviorChange& change) const {
    change.new_lines = lines_of(run, operation.begin, operation.end);
    change.new_start = run.actions[operation.begin].line;
    change.new_motions = motion_count(run, operation.begin, operation.end);
    change.new_tool = tool_at(run, operation);
    change.seconds += run.actions[operation.end].start - run.actions[operation.begin].start;
  }

  BehaviorChange moved(std::size_t i) const {
    BehaviorChange change = described(ChangeKind::Reordered);
    describe_old(runs_.a, of_a_[i], change);
    describe_new(runs_.b, of_b_[of_a_[i].partner], change);
    change.is_operation = true;
    change.old_value = tool_before(runs_.a, of_a_, i);
    change.new_value = tool_before(runs_.b, of_b_, of_a_[i].partner);
    return change;
  }

  /// An operation of a alone, or of b.
  BehaviorChange only(ChangeKind kind, std::size_t index) const {
    BehaviorChange change = described(kind);
    change.is_operation = true;
    const bool is_of_a = kind == ChangeKind::Removed;
    if (is_of_a) {
      describe_old(runs_.a, of_a_[index], change);
      change.new_start = runs_.b.actions.back().line;
    } else {
      describe_new(runs_.b, of_b_[index], change);
      change.old_start = runs_.a.actions.back().line;
    }
    // The other run comes to it where it does what follows.
    const std::vector<ComparedOperation>& own = is_of_a ? of_a_ : of_b_;
    const std::vector<ComparedOperation>& other = is_of_a ? of_b_ : of_a_;
    std::size_t next = index + 1;
    while (next < own.size() && own[next].partner == ComparedOperation::kNone) ++next;
    if (next == own.size()) return change;
    const std::size_t action = other[own[next].partner].begin;
    (is_of_a ? change.new_start : change.old_start) = (is_of_a ? runs_.b : runs_.a).actions[action].line;
    return change;
  }

  /// How many actions of two operations that belong together are on the way there: up to the first motion that both
  /// make in the same way. None if there is no such motion, since then the places differ for another reason.
  std::size_t way_there(const ComparedOperation& left, const ComparedOperation& right) const {
    for (std::size_t i = left.begin, k = right.begin; i < left.end && k < right.end; ++i, ++k) {
      const MachineAction& one = runs_.a.actions[i];
      const MachineAction& other = runs_.b.actions[k];
      if (one.is_motion() != other.is_motion()) return 0;
      if (!one.is_motion()) continue;
      if (is_same_alone(runs_, options_, one, other)) return i - left.begin;
      if (!goes_along(one, other)) return 0;
    }
    return 0;
  }

  /// Lets the first motions of two operations begin in the same place.
  static void same_start(OrderedRuns& ordered, std::size_t a_place, std::size_t b_place) {
    const auto first_motion = [](std::vector<MachineAction>& actions, std::size_t place) {
      return std::find_if(actions.begin() + static_cast<Difference>(place), actions.end(),
                          [](const MachineAction& action) { return action.is_motion(); });
    };
    const auto there = first_motion(ordered.a.actions, a_place);
    const auto here = first_motion(ordered.b.actions, b_place);
    if (there == ordered.a.actions.end() || here == ordered.b.actions.end()) return;
    if (there->arc == MachineAction::kNone && here->arc == MachineAction::kNone) here->from = there->from;
  }

  /// The rapids at the begin of two operations that belong together lead there from where the order has it. Those of
  /// the second one stand at `place`.
  void same_way_there(const ComparedOperation& left, const ComparedOperation& right, OrderedRuns& ordered,
                      std::size_t a_place, std::size_t place) const {
    if (!left.left_out.empty() || !right.left_out.empty()) return same_start(ordered, a_place, place);
    const std::size_t count = way_there(left, right);
    bool is_first = true;
    for (std::size_t i = left.begin, k = right.begin; i < left.end && k < right.end; ++i, ++k, ++place) {
      if (runs_.a.actions[i].is_motion() != runs_.b.actions[k].is_motion()) return;
      if (!runs_.a.actions[i].is_motion()) continue;
      const MachineAction& there = ordered.a.actions[ordered.a.actions.size() - (left.end - i)];
      MachineAction& here = ordered.b.actions[place];
      if (there.arc != MachineAction::kNone || here.arc != MachineAction::kNone) return;
      const bool is_on_the_way = i - left.begin < count;
      // The first motion that is the same comes from there, too.
      if (is_first || i - left.begin <= count) here.from = there.from;
      if (is_on_the_way) here.to = there.to;
      is_first = false;
      if (!is_on_the_way) return;
    }
  }

  /// Adds an operation, which begins where the one before it ends now.
  static void append(const RecordedRun& run, const ComparedOperation& operation, RecordedRun& ordered) {
    const auto is_motion = [](const MachineAction& action) { return action.is_motion(); };
    const auto before = std::find_if(ordered.actions.rbegin(), ordered.actions.rend(), is_motion);
    const bool has_place = before != ordered.actions.rend();
    const geometry::Pose place = has_place ? before->to : geometry::Pose{};
    const std::size_t count = ordered.actions.size();
    for (std::size_t i = operation.begin; i < operation.end; ++i)
      if (!operation.leaves_out(i)) ordered.actions.push_back(run.actions[i]);
    const auto motion =
        std::find_if(ordered.actions.begin() + static_cast<Difference>(count), ordered.actions.end(), is_motion);
    if (has_place && motion != ordered.actions.end() && motion->arc == MachineAction::kNone) motion->from = place;
  }

  /// Adds the epilogue, and brings times and IFs into the new order.
  void finish(const RecordedRun& run, const std::vector<ComparedOperation>& operations,
              const std::vector<std::size_t>& places, RecordedRun& ordered) const {
    const std::size_t epilogue = run.actions.size() - epilogue_;
    const std::size_t place = ordered.actions.size();
    ordered.actions.insert(ordered.actions.end(), run.actions.begin() + static_cast<Difference>(epilogue),
                           run.actions.end());
    const auto duration = [&](std::size_t i) {
      return i + 1 < run.actions.size() ? run.actions[i + 1].start - run.actions[i].start : 0;
    };
    const Difference first = prologue(run, operations);
    std::vector<std::size_t> index(run.actions.size());  // Where each action stands now.
    std::iota(index.begin(), index.begin() + first, std::size_t{0});
    std::iota(index.begin() + static_cast<Difference>(epilogue), index.end(), place);
    std::vector<double> durations(ordered.actions.size());
    for (std::size_t i = 0; i < static_cast<std::size_t>(first); ++i) durations[i] = duration(i);
    for (std::size_t i = epilogue; i < run.actions.size(); ++i) durations[index[i]] = duration(i);
    for (std::size_t operation = 0; operation < operations.size(); ++operation) {
      const ComparedOperation& each = operations[operation];
      std::size_t next = places[operation];
      for (std::size_t i = each.begin; i < each.end; ++i) {
        index[i] = next;
        if (each.partner == ComparedOperation::kNone || each.leaves_out(i)) continue;
        durations[next++] = duration(i);
      }
    }
    double start = 0;
    for (std::size_t i = 0; i < durations.size(); ++i) {
      ordered.actions[i].start = start;
      start += durations[i];
    }
    for (ActionDecision& decision : ordered.decisions) decision.action = index[decision.action];
    for (ActionSpindle& spindle : ordered.spindles)
      if (spindle.cause) spindle.cause = index[*spindle.cause];
    std::stable_sort(
        ordered.decisions.begin(), ordered.decisions.end(),
        [](const ActionDecision& left, const ActionDecision& right) { return left.action < right.action; });
  }

  const RunPair& runs_;
  const ComparisonOptions& options_;
  std::size_t epilogue_;
  std::vector<ComparedOperation> of_a_;
  std::vector<ComparedOperation> of_b_;
};

}  // namespace

std::optional<OrderedRuns> in_same_order(const RunPair& runs, const ComparisonOptions& options) {
  OperationSorter sorter(runs, options, 1);
  if (!sorter.are_few()) return std::nullopt;
  // What stands after the last operation may belong to it, or to whichever is the last one.
  const std::size_t epilogue = common_epilogue(runs);
  const std::size_t left = sorter.pair_exact();
  if (left > 0 && epilogue > 1) {
    OperationSorter without(runs, options, epilogue);
    if (without.pair_exact() < left) return without.sort();
  }
  return sorter.sort();
}

}  // namespace isocnc::comparison
