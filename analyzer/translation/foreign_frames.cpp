#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "analyzer/translation/translation_run.h"

namespace isocnc::translation {

using geometry::Vec3;
using Untranslatable = UntranslatableReason;
using enum ForeignRole;

static constexpr char kFrameAxes[] = {'X', 'Y', 'Z'};

/// `G54`, `G59.1`.
static std::string zero_text(int name) {
  return name % 10 == 0 ? fmt::format("G{}", name / 10) : fmt::format("G{}.{}", name / 10, name % 10);
}

/// The zero point that G10 calls by a number, in tenths: 1 is G54, 7 is G59.1. None for 0, the one in force.
static std::optional<int> zero_by_number(int number) {
  if (number == 0) return std::nullopt;
  return number <= 6 ? 530 + 10 * number : 584 + number;
}

/// Changes the coordinate system; the tool stays, and its coordinates are others.
template <class Change>
void TranslationRun::change_frame(Change&& change) {
  const KnownPlace machine = frames_.to_machine(place_);
  change();
  place_ = frames_.from_machine(machine);
}

void TranslationRun::add_frames(CurrentBlock& current) {
  for (const auto& [tenths, role] : current.gs) {
    if (role == ZeroPoint || role == FurtherZero) select_zero(current, tenths, role);
    if (role == LocalShift) set_local_shift(current);
    if (role == SetPosition) set_position(current);
    if (role == ClearShift || role == SuspendShift || role == RestoreShift) {
      if (role == ClearShift) kept_shift_ = Vec3::Zero();
      const std::optional<Vec3> shift = role == RestoreShift ? kept_shift_ : std::optional<Vec3>(Vec3::Zero());
      if (shift)
        unknown_.erase(UnknownMode::Shift);
      else
        unknown_.insert(UnknownMode::Shift);
      change_frame([&] { frames_.shift = shift.value_or(Vec3::Zero()); });
    }
    if (role == Data) set_data(current);
    if (role == Rotation) set_rotation(current);
    if (role == RotationOff) end_rotation();
    if (role == Reference) go_to_reference(current, tenths);
  }
}

/// A block that is left as a comment has changed the frame: what is not known of it stops the motions below.
void TranslationRun::apply_refused_frames(CurrentBlock& current) {
  for (const auto& [tenths, role] : current.gs) {
    if (role == ZeroPoint || role == FurtherZero) select_zero(current, tenths, role);
    if (role == Rotation) suspended_by_.insert(Rotation);
    if (role == RotationOff) end_rotation();
    if (role == Compensation || role == CompensationOff) compensation_ = tenths / 10;
    forget_frame(current, tenths, role);
  }
}

/// What a G of a block that is left as a comment gives anew.
void TranslationRun::forget_frame(const CurrentBlock& current, int tenths, ForeignRole role) {
  const bool is_linuxcnc = setup_.control == SourceControl::LinuxCnc;
  if (tenths == 281 || tenths == 301) lost_references_.insert(tenths - 1);
  if (role == Data) {
    unknown_.insert(UnknownMode::ZeroPoint);
    forget_zero(current);
  }
  if (role == PresetShift || (role == LocalShift && !is_linuxcnc)) unknown_.insert(UnknownMode::LocalShift);
  const bool shifts = role == SetPosition || role == ClearShift || role == SuspendShift || role == RestoreShift ||
                      role == PresetShift || (role == LocalShift && is_linuxcnc);
  if (shifts) unknown_.insert(UnknownMode::Shift);
  if (role == SetPosition || role == LocalShift || role == ClearShift) kept_shift_.reset();
}

void TranslationRun::end_rotation() {
  suspended_by_.erase(Rotation);
  if (!frames_.rotation) return;
  turned_by_ = "G69";
  change_frame([&] { frames_.rotation.reset(); });
}

void TranslationRun::select_zero(CurrentBlock& current, int name, ForeignRole role) {
  unknown_.erase(UnknownMode::ZeroPoint);
  if (is_further_zero(current, role)) return select_further_zero(current, name);
  change_frame([&] { frames_.selected = name; });
  if (frames_.has_zero()) return;
  const std::string text = zero_text(name);
  for (const ForeignWord& word : current.words)
    if (word.letter == 'G' && word.tenths() == name)
      report(current, {Untranslatable::ZeroPointMissing, word.at, {text}});
  current.remark += (current.remark.empty() ? "" : " ") + text;
  said_once_.insert(Untranslatable::ZeroPointMissing);
}

/// G54.1 P3 and its like; Fanuc has G54 P3 for it.
bool TranslationRun::is_further_zero(const CurrentBlock& current, ForeignRole role) const {
  if (role == FurtherZero) return true;
  const bool calls = std::find(current.ms.begin(), current.ms.end(), 98) != current.ms.end();
  return role == ZeroPoint && setup_.control == SourceControl::Fanuc && current.find('P') != nullptr && !calls &&
         !current.has(Dwell) && !current.has(Cycle) && !holds_cycle();
}

/// No motion is written until another zero point is selected.
void TranslationRun::select_further_zero(CurrentBlock& current, int name) {
  change_frame([&] { frames_.selected = -name; });
  said_once_.insert(Untranslatable::ZeroPointMissing);
  for (const ForeignWord& word : current.words)
    if (word.letter == 'G' && word.tenths() == name) leave_out(current, Untranslatable::UnknownG, word);
  if (const ForeignWord* const p = current.find('P')) current.remark += " P" + p->digits;
}

/// A G10 that stays a comment: where its zero point lies is not known from there on.
void TranslationRun::forget_zero(const CurrentBlock& current) {
  const ForeignWord* const l = current.find('L');
  const ForeignWord* const p = current.find('P');
  const bool is_other_table = l != nullptr && !l->is_formula && l->value != 2 && l->value != 20;
  if (is_other_table) return;
  const bool is_external = setup_.control == SourceControl::Fanuc && (p == nullptr || p->is_formula || p->value == 0);
  if (is_external) unknown_.insert(UnknownMode::ExternalShift);
  if (is_external && p != nullptr && !p->is_formula) return;
  const bool is_known = p != nullptr && !p->is_formula && p->value >= 0 && p->value <= 9;
  if (!is_known) return frames_.forget_zeros();
  frames_.forget_zero(zero_by_number(static_cast<int>(p->value)).value_or(frames_.selected));
}

/// On LinuxCNC it is the shift of G92 under another name.
void TranslationRun::set_local_shift(const CurrentBlock& current) {
  const bool is_linuxcnc = setup_.control == SourceControl::LinuxCnc;
  if (current.find('X') != nullptr && current.find('Y') != nullptr && current.find('Z') != nullptr)
    unknown_.erase(is_linuxcnc ? UnknownMode::Shift : UnknownMode::LocalShift);
  change_frame([&] {
    Vec3& shift = is_linuxcnc ? frames_.shift : frames_.local;
    for (int axis = 0; axis < 3; ++axis)
      if (const ForeignWord* const word = current.find(kFrameAxes[axis])) shift[axis] = length_of(*word);
  });
  if (is_linuxcnc) kept_shift_ = unknown_.contains(UnknownMode::Shift) ? std::nullopt : std::optional(frames_.shift);
}

/// Whether the coordinates of the program are at known places of the machine.
bool TranslationRun::knows_frame() const {
  return !lacks({UnknownMode::ZeroPoint, UnknownMode::Shift, UnknownMode::LocalShift, UnknownMode::ExternalShift});
}

/// G92 of the others: the tool is at these coordinates.
void TranslationRun::set_position(CurrentBlock& current) {
  const auto give_up = [&](BlockRefusal refusal) {
    report(current, std::move(refusal));
    keep_as_comment(current);
    unknown_.insert(UnknownMode::Shift);
    kept_shift_.reset();
  };
  const ForeignWord& g92 = current.g_of(SetPosition);
  if (frames_.rotation) return give_up({Untranslatable::UnknownG, g92.at, {"G92"}});
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const ForeignWord* const word = current.find(kFrameAxes[axis]); word != nullptr && !place_.known[axis])
      return give_up({Untranslatable::PlaceUnknown, word->at, {"G92", std::string(1, word->letter)}});
  const bool gives_all = current.find('X') != nullptr && current.find('Y') != nullptr && current.find('Z') != nullptr;
  const bool lacks_others = lacks({UnknownMode::ZeroPoint, UnknownMode::LocalShift, UnknownMode::ExternalShift});
  if (gives_all && !lacks_others) unknown_.erase(UnknownMode::Shift);
  if (!knows_frame()) {  // What this adds to is not known.
    unknown_.insert(UnknownMode::Shift);
    kept_shift_.reset();
    return keep_as_comment(current);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const ForeignWord* const word = current.find(kFrameAxes[axis]);
    if (word == nullptr) continue;
    frames_.shift[axis] += place_.at[axis] - length_of(*word);
    place_.at[axis] = length_of(*word);
  }
  kept_shift_ = frames_.shift;
}

/// G10 L2 gives a zero point in machine coordinates, G10 L20 by the coordinates that the tool has there.
void TranslationRun::set_data(CurrentBlock& current) {
  const bool is_fanuc = setup_.control == SourceControl::Fanuc;
  const ForeignWord* const l = current.find('L');
  const ForeignWord* const p = current.find('P');
  const ForeignWord* const r = current.find('R');
  const int number = p != nullptr && p->value >= 0 && p->value <= 9 ? static_cast<int>(p->value) : -1;
  const bool by_place = l != nullptr && l->value == 20;
  const bool is_zero = l != nullptr && (l->value == 2 || (by_place && !is_fanuc));
  const int last = setup_.control == SourceControl::LinuxCnc ? 9 : 6;
  const int name = zero_by_number(std::max(number, 0)).value_or(frames_.selected);
  const auto give_up = [&](BlockRefusal refusal) {
    report(current, std::move(refusal));
    keep_as_comment(current);
    if (!is_zero) return;
    if (name == frames_.selected || number == 0) unknown_.insert(UnknownMode::ZeroPoint);
    forget_zero(current);
  };
  const ForeignWord& g10 = current.g_of(Data);
  const bool is_known_form = is_zero && number >= (is_fanuc ? 1 : 0) && number <= last &&
                             (r == nullptr || r->value == 0) &&
                             (number > 0 || !unknown_.contains(UnknownMode::ZeroPoint)) &&
                             (!by_place || !unknown_.contains(UnknownMode::Shift));
  if (!is_known_form) {
    const std::string of_all = is_fanuc && is_zero && number == 0 ? " P0" : "";
    return give_up({Untranslatable::UnknownG, g10.at, {l == nullptr ? "G10" : "G10 L" + l->digits + of_all}});
  }
  const std::optional<Vec3> old = frames_.zero(name);
  Vec3 zero = old.value_or(Vec3::Zero());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const ForeignWord* const word = current.find(kFrameAxes[axis]);
    const auto i = static_cast<Eigen::Index>(axis);
    if (word == nullptr && !old) return give_up({Untranslatable::ZeroPointMissing, g10.at, {zero_text(name)}});
    if (word == nullptr) continue;
    if (!by_place) {
      zero[i] = length_of(*word) + (is_fanuc && now_.incremental ? zero[i] : 0);
      continue;
    }
    const KnownPlace machine = frames_.to_machine(place_);
    if (!machine.known[axis])
      return give_up({Untranslatable::PlaceUnknown, word->at, {"G10 L20", std::string(1, word->letter)}});
    zero[i] = machine.at[i] - frames_.local[i] - frames_.shift[i] - length_of(*word);
  }
  if (name == frames_.selected)
    change_frame([&] { frames_.set_zero(name, zero); });
  else
    frames_.set_zero(name, zero);
}

/// G68: a face frame that is turned about the normal of the plane.
void TranslationRun::set_rotation(CurrentBlock& current) {
  const ForeignPlane& plane = foreign_plane(now_.plane);
  const ForeignWord* const r = current.find('R');
  const auto center = [&](int axis) -> std::optional<double> {
    if (const ForeignWord* const word = current.find(kFrameAxes[axis])) return length_of(*word);
    const bool is_known = knows_frame() && place_.known[static_cast<std::size_t>(axis)];
    return is_known ? std::optional(place_.at[axis]) : std::nullopt;
  };
  const std::optional<double> u = center(plane.u);
  const std::optional<double> v = center(plane.v);
  const bool is_sayable =
      r != nullptr && !now_.incremental && !frames_.rotation && u && v && !lacks({UnknownMode::Plane});
  if (!is_sayable) {
    report(current, Untranslatable::Rotation, current.g_of(Rotation));
    suspended_by_.insert(Rotation);
    return keep_as_comment(current);
  }
  turned_by_ = "G68";
  turned_plane_ = plane;
  change_frame([&] { frames_.rotation = TurnedCoordinates{plane, *u, *v, std::remainder(r->value, 360)}; });
}

std::string TranslationRun::coordinates(const Vec3& mm, std::string_view letters, int decimals) const {
  std::string words;
  for (int axis = 0; axis < 3; ++axis)
    words += fmt::format(" {}{}", letters[static_cast<std::size_t>(axis)], written_number(mm[axis] / unit(), decimals));
  return words;
}

/// Writes what leads from the frame in force to another: G27, G92, G29 or G24.
void TranslationRun::mount_frame(const WrittenFrame& wanted) {
  static constexpr double kSame = 1e-9;  // mm
  const bool shifts = (wanted.origin - written_frame_.origin).norm() > kSame;
  const bool turns = wanted.rotation != written_frame_.rotation;
  if (!shifts && !turns) return;
  if (written_frame_.rotation) writer_.add_code("G27");
  if (now_.inches != written_.inches) write_settings();  // The lengths of a frame follow the units.
  if (shifts) writer_.add_code("G92" + coordinates(wanted.origin, "XYZ", 9));
  if (wanted.rotation) {
    const TurnedCoordinates& rotation = *wanted.rotation;
    const Vec3 origin = rotation.turned(Vec3::Zero());
    if (rotation.plane.g == 17) {
      writer_.add_code(fmt::format("G29{} C{}", coordinates(origin, "XYZ", 9), written_number(rotation.degrees)));
    } else {
      std::string axes;
      static constexpr std::string_view kLetters[] = {"ABC", "IJK", "PQR"};
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 direction = rotation.turned(Vec3::Unit(axis)) - origin;
        for (int i = 0; i < 3; ++i)
          axes += fmt::format(" {}{}", kLetters[axis][static_cast<std::size_t>(i)], written_number(direction[i], 9));
      }
      writer_.add_code("G24" + coordinates(origin, "XYZ", 9) + axes);
    }
  }
  written_frame_ = wanted;
}

void TranslationRun::mount_selected_frame() { mount_frame({frames_.origin(), frames_.rotation}); }

/// G28 and G30: by way of the point in the block to the reference point, as a rapid in machine coordinates.
void TranslationRun::go_to_reference(CurrentBlock& current, int name) {
  const ForeignWord* const p = current.find('P');
  const auto found = setup_.map.references.find(name);
  const bool is_further = p != nullptr && p->value != 2;
  const bool is_given =
      !is_further && !lost_references_.contains(name) && (found != setup_.map.references.end() || name == 280);
  if (!is_given) {
    report(current, {Untranslatable::ReferenceMissing, current.g_of(Reference).at, {fmt::format("G{}", name / 10)}});
    keep_as_comment(current);
    return lose(current, !current.has_any("XYZ"));
  }
  const bool names_axes = current.has_any("XYZ");
  const KnownPlace via = target(current);
  const bool goes_by_way = names_axes && [&] {
    if (lacks({UnknownMode::Units, UnknownMode::Distance}) || (!now_.incremental && !knows_frame())) return true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (current.find(kFrameAxes[axis]) == nullptr) continue;
      const auto i = static_cast<Eigen::Index>(axis);
      const bool stays = (now_.incremental || place_.known[axis]) && std::abs(via.at[i] - place_.at[i]) < 1e-9;
      if (!stays) return true;
    }
    return false;
  }();
  if (!(goes_by_way ? may_move(current, false) : has_tool(current))) return;
  if (goes_by_way) {
    mount_selected_frame();
    write_motion(current, 0, axis_words(current));
    arrive(current, via);
  }
  const Vec3 reference = found != setup_.map.references.end() ? found->second : setup_.home;
  mount_frame({});
  KnownPlace machine = frames_.to_machine(place_);
  std::string words;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (names_axes && current.find(kFrameAxes[axis]) == nullptr) continue;
    const auto i = static_cast<Eigen::Index>(axis);
    words += fmt::format(" {}{}", kFrameAxes[axis], written_number(reference[i] / unit(), 9));
    machine.at[i] = reference[i];
    machine.known[axis] = true;
    find_again(axis);
  }
  write_motion_in(current, 0, "G00" + words, false);
  place_ = frames_.from_machine(machine);
}

}  // namespace isocnc::translation
