#include "analyzer/transforming/block_transformer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace isocnc::transforming {

using dialect::GRole;
using dialect::ModalGroup;
using execution::MoveKind;
using execution::State;
using geometry::Vec3;
using syntax::Instruction;
using syntax::InstructionKind;
using syntax::Word;

namespace {

/// A number below this, in mm or as a component, is 0.
constexpr double kNothing = 1e-9;
/// The new program is at most this far from where it would be without rounding, mm.
constexpr double kRounding = 1e-3;
/// Arcs that sweep less give their center exactly enough by R where their ends are rounded.
constexpr double kSafeSweepByRadius = 150;

/// A word that a block needs: its letter, its value in units of the program, and how far it may be rounded.
struct WantedWord {
  char letter = 'X';
  double value = 0;
  int decimals = Decimals::kMillimeters;
};

/// The arguments of an instruction.
class ArgumentWords {
 public:
  ArgumentWords(const syntax::LineTree& line, const Instruction& instruction) {
    const bool has_command = instruction.kind != InstructionKind::Continuation;
    for (std::uint16_t i = instruction.begin; i < instruction.end; ++i)
      if (line.words[i].owner == instruction.number && !(has_command && i == instruction.command))
        words_.push_back(&line.words[i]);
  }

  const Word* find(char letter) const {
    for (const Word* word : words_)
      if (word->letter == letter) return word;
    return nullptr;
  }
  bool has(char letter) const { return find(letter) != nullptr; }
  double value_or(char letter, double otherwise) const {
    const Word* const word = find(letter);
    return word == nullptr ? otherwise : word->value;
  }
  /// Null where there are none, as of a G00 before another G that the control refuses.
  const Word* first() const { return words_.empty() ? nullptr : words_.front(); }
  /// Those with one of these letters, as they are written.
  std::vector<const Word*> of(std::string_view letters) const {
    std::vector<const Word*> found;
    for (const Word* word : words_)
      if (letters.find(word->letter) != std::string_view::npos) found.push_back(word);
    return found;
  }

 private:
  std::vector<const Word*> words_;
};

std::string text_of(const WantedWord& wanted) { return wanted.letter + number_like("", wanted.value, wanted.decimals); }

/// Writes the wanted words in place of those with these letters: each in place of the one with its letter, or else of
/// one whose letter is not wanted any more, or else after the last one, or after `anchor` if there is none. The anchor
/// may be null where nothing is wanted.
void write(LineEdits& edits, const std::vector<const Word*>& present, const std::vector<WantedWord>& wanted,
           const Word* anchor) {
  std::vector<const Word*> free;
  for (const Word* word : present)
    if (std::none_of(wanted.begin(), wanted.end(), [&](const WantedWord& each) { return each.letter == word->letter; }))
      free.push_back(word);
  const Word* const last = present.empty() ? anchor : present.back();
  for (const WantedWord& each : wanted) {
    const auto same =
        std::find_if(present.begin(), present.end(), [&](const Word* word) { return word->letter == each.letter; });
    if (same != present.end()) {
      edits.change(**same, each.letter, each.value, each.decimals);
    } else if (!free.empty()) {
      edits.change(*free.front(), each.letter, each.value, each.decimals);
      free.erase(free.begin());
    } else {
      edits.insert_after(*last, text_of(each));
    }
  }
}

int length_decimals(const State& state) { return state.in_inches() ? Decimals::kInches : Decimals::kMillimeters; }

/// The axes (0 to 2) that are to be given where some are given: all to which one of them contributes.
std::vector<int> wanted_axes(const PoseMap& map, const ArgumentWords& words, std::string_view letters) {
  std::vector<int> axes;
  for (int to = 0; to < 3; ++to)
    for (int from = 0; from < 3; ++from)
      if (words.has(letters[static_cast<std::size_t>(from)]) && std::abs(map.linear(to, from)) > kNothing) {
        axes.push_back(to);
        break;
      }
  return axes;
}

/// Whether the map leads to coordinates that no decimals give exactly.
bool is_rounding(const PoseMap& map) {
  const Eigen::Array33d part = map.linear.array().abs();
  return (part * (1 - part)).maxCoeff() > kNothing;
}

bool leans(double b_deg) { return std::abs(std::sin(b_deg * std::numbers::pi / 180)) > kNothing; }

}  // namespace

std::string BlockTransformer::next(const syntax::LineTree& line, const State& before) {
  obstacle_.reset();
  const execution::BlockRecorder original(line, before, setup_);
  LineEdits edits(line);
  line_ = &line;
  edits_ = &edits;
  for (const Instruction& instruction : line.instructions) {
    if (instruction.is_motion() && original.motion() != nullptr) edit_motion(instruction, *original.motion());
    if (instruction.g() != nullptr && instruction.g()->mounts_face()) edit_frame(instruction, before);
  }
  edit_compensation(original.state());
  edit_feed();
  std::string text = obstacle_ ? std::string(line.text) : edits.text();
  state_ = execution::BlockRecorder(syntax::ParsedLine(text).tree(), state_, setup_).state();
  return text;
}

void BlockTransformer::edit_motion(const Instruction& instruction, const Motion& motion) {
  const State& modes = motion.state;
  if (map_.stays(modes) && map_.transformation().movement != Movement::None && motion.move.kind != MoveKind::Rapid) {
    obstacle_ = TransformObstacle::FeedInMachine;
    return;
  }
  const PoseMap map = map_.in_force(modes);
  const ArgumentWords words(*line_, instruction);
  const geometry::Pose target = target_of(motion, map);
  const bool adds = modes.incremental();
  const double unit = modes.mm_per_unit();

  std::vector<WantedWord> linear;
  for (const int axis : wanted_axes(map, words, "XYZ"))
    linear.push_back(
        {"XYZ"[axis], (target.tip[axis] - (adds ? state_.position.tip[axis] : 0)) / unit, length_decimals(modes)});
  write(*edits_, words.of("XYZ"), linear, words.first());

  std::vector<WantedWord> rotary;
  const bool has_b = words.has('B');
  const bool turns_face = map.c_offset != 0 && leans(target.b) && std::abs(state_.position.c - target.c) > 1e-6;
  if (has_b) rotary.push_back({'B', target.b - (adds ? state_.position.b : 0), Decimals::kDegrees});
  if (words.has('C') || (has_b && turns_face))
    rotary.push_back({'C', target.c - (adds ? state_.position.c : 0), Decimals::kDegrees});
  write(*edits_, words.of("BC"), rotary, words.first());

  if (motion.move.kind != MoveKind::Arc) return;
  edit_motion_g(instruction, motion, map);
  edit_center(instruction, motion, map);
}

/// Where a motion of the new program ends. A whole turn ends exactly where it starts, which rounded coordinates might
/// miss.
geometry::Pose BlockTransformer::target_of(const Motion& motion, const PoseMap& map) const {
  geometry::Pose target = map.pose(motion.move.to);
  const Vec3 start = map.point(motion.move.from.tip);
  if (motion.move.kind != MoveKind::Arc || (start - state_.position.tip).norm() > kRounding) return target;
  const int normal = motion.move.normal_axis;
  const Vec3 way = motion.move.to.tip - motion.move.from.tip;
  const int axes[] = {(normal + 1) % 3, (normal + 2) % 3};
  if (std::hypot(way[axes[0]], way[axes[1]]) > geometry::kEqualCoordinate) return target;
  for (const int axis : axes) target.tip[axis] = state_.position.tip[axis];
  return target;
}

/// Exchanges G02 and G03, and writes the G where it cannot continue that of the line above.
void BlockTransformer::edit_motion_g(const Instruction& instruction, const Motion& motion, const PoseMap& map) {
  const int normal = motion.move.normal_axis;
  if (!map.keeps_plane(normal)) {
    obstacle_ = TransformObstacle::PlaneRotated;
    return;
  }
  const int old_g = motion.state.mode(ModalGroup::Motion);
  const int new_g = map.flips_plane(normal) ? 5 - old_g : old_g;
  if (instruction.kind == InstructionKind::G) {
    edits_->change_last_digit(line_->command(instruction), static_cast<char>('0' + new_g));
  } else if (state_.mode(ModalGroup::Motion) != new_g) {
    edits_->insert_before(line_->command(instruction), fmt::format("G{:02}", new_g));
  }
}

/// Moves the center of an arc. Where its ends are rounded, R would not give the center of nearly half a turn exactly
/// enough, so that the center is written for it.
void BlockTransformer::edit_center(const Instruction& instruction, const Motion& motion, const PoseMap& map) {
  const ArgumentWords words(*line_, instruction);
  const execution::ProgrammedMove& move = motion.move;
  const bool needs_center =
      words.of("IJK").empty() && is_rounding(map) && std::abs(move.sweep_deg) > kSafeSweepByRadius;
  if (words.of("IJK").empty() && !needs_center) return;
  const Vec3 center = map.point(move.center);
  const auto wanted = [&](int axis) {
    const double from = motion.state.incremental() ? state_.position.tip[axis] : 0;
    return WantedWord{"IJK"[axis], (center[axis] - from) / motion.state.mm_per_unit(), length_decimals(motion.state)};
  };
  if (needs_center) {
    edits_->replace(*words.find('R'), text_of(wanted(0)) + ' ' + text_of(wanted(1)));
    return;
  }
  std::vector<WantedWord> centers;
  for (const int axis : wanted_axes(map, words, "IJK")) centers.push_back(wanted(axis));
  write(*edits_, words.of("IJK"), centers, words.first());
}

void BlockTransformer::edit_frame(const Instruction& instruction, const State& before) {
  const PoseMap map = map_.in_workpiece(before);
  const dialect::GCode& code = *instruction.g();
  if (code.takes_origin()) {
    const ArgumentWords words(*line_, instruction);
    const double unit = before.mm_per_unit();
    const Vec3 origin =
        map.point(Vec3(words.value_or('X', 0), words.value_or('Y', 0), words.value_or('Z', 0)) * unit) / unit;
    std::vector<WantedWord> wanted;
    for (int axis = 0; axis < 3; ++axis)
      if (words.has("XYZ"[axis]) || std::abs(origin[axis]) > kNothing)
        wanted.push_back({"XYZ"[axis], origin[axis], length_decimals(before)});
    write(*edits_, words.of("XYZ"), wanted, &line_->command(instruction));
  }
  if (code.role == GRole::FaceByAngles) {
    edit_face_angles(instruction, map);
  } else {
    edit_face_axes(instruction, before);
  }
}

/// Moves i, j and k of a face. A mirrored face stays right-handed by turning around the axis that is mirrored.
void BlockTransformer::edit_face_axes(const Instruction& instruction, const State& before) {
  const PoseMap map = map_.in_workpiece(before);
  execution::State mounted = before;
  mounted.face_mounted = true;
  const PoseMap inside = map_.in_force(mounted);
  const ArgumentWords words(*line_, instruction);
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view letters = instruction.g()->axes.substr(static_cast<std::size_t>(3 * axis), 3);
    Vec3 vector;
    for (int i = 0; i < 3; ++i) vector[i] = words.value_or(letters[static_cast<std::size_t>(i)], 0);
    vector = inside.linear(axis, axis) * (map.linear * vector);
    std::vector<WantedWord> wanted;
    for (int i = 0; i < 3; ++i) {
      const char letter = letters[static_cast<std::size_t>(i)];
      if (words.has(letter) || std::abs(vector[i]) > kNothing) wanted.push_back({letter, vector[i], Decimals::kVector});
    }
    write(*edits_, words.of(letters), wanted, &line_->command(instruction));
  }
}

void BlockTransformer::edit_face_angles(const Instruction& instruction, const PoseMap& map) {
  const ArgumentWords words(*line_, instruction);
  const double b = map.b_sign * words.value_or('B', 0);
  double c = map.c_sign * words.value_or('C', 0) + map.c_offset;
  if (std::abs(c) > 180) c = std::remainder(c, 360);  // The range of a G29 (I.3.2).
  std::vector<WantedWord> wanted;
  if (words.has('B')) wanted.push_back({'B', b, Decimals::kDegrees});
  if (words.has('C') || std::abs(c) > kNothing) wanted.push_back({'C', c, Decimals::kDegrees});
  const std::vector<const Word*> origin = words.of("XYZ");
  write(*edits_, words.of("BC"), wanted, origin.empty() ? &line_->command(instruction) : origin.back());
}

/// Exchanges G41 and G42.
void BlockTransformer::edit_compensation(const State& after) {
  int normal = 2;
  if (after.g(ModalGroup::Plane)->role == GRole::PlaneZX) normal = 1;
  if (after.g(ModalGroup::Plane)->role == GRole::PlaneYZ) normal = 0;
  if (!map_.in_force(after).flips_plane(normal)) return;
  for (const Instruction& instruction : line_->instructions) {
    if (instruction.is(GRole::CompensationLeft)) edits_->change_last_digit(line_->command(instruction), '2');
    if (instruction.is(GRole::CompensationRight)) edits_->change_last_digit(line_->command(instruction), '1');
  }
}

void BlockTransformer::edit_feed() {
  if (line_->feed < 0 || map_.transformation().feed_factor == 1) return;
  const Word& feed = line_->words[static_cast<std::size_t>(line_->feed)];
  edits_->change(feed, 'F', feed.value * map_.transformation().feed_factor, Decimals::kFeed);
}

}  // namespace isocnc::transforming
