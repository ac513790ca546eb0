#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "interpreter/chords/revolved_column.h"
#include "interpreter/stock/stock.h"
#include "interpreter/stock/sweep.h"
#include "interpreter/stock/swept_piece.h"
#include "interpreter/stock/upright_sweep.h"

namespace isocnc::stock {

/// Pieces of a body along a straight line, with the axis at rest in any direction.
struct SlantedLine {
  solids::AxisPlacement from;
  geometry::Vec3 travel = geometry::Vec3::Zero();
  std::size_t first_piece = 0;  ///< Of SweptShape::pieces.
  std::size_t piece_count = 0;
};

/// A body as the sweeps of one purpose see it.
struct SweptShape {
  std::vector<RevolvedColumn> columns;      ///< For a vertical axis that points up.
  std::vector<RevolvedColumn> turned_over;  ///< For one that points down.
  /// For other axes: those of the body, and then for each the part of its core at the lower end, as high as the radius
  /// there, and that at the upper end.
  std::vector<solids::BodyPiece> pieces;
  std::size_t body_pieces = 0;
  double radius = 0;
  double bottom = 0;
  double top = 0;
};

/// A part of a sweep that has a closed form.
struct UnitSweep {
  std::uint32_t sweep = 0;  ///< Index of the sweep.
  std::uint32_t shape = 0;  ///< Index of the shape.
  bool is_upside_down = false;
  std::uint32_t piece = 0;  ///< While the axis turns: which piece of the body this is a place or an end of.
  std::variant<UprightLine, LevelArc, SlantedLine> motion;
  solids::BoundingBox bounds;
};

/// The shapes of the bodies of some sweeps.
class SweptShapes {
 public:
  explicit SweptShapes(std::span<const Sweep> sweeps);

  const SweptShape& operator[](std::uint32_t index) const { return shapes_[index]; }
  /// Of a body that one of the sweeps has.
  std::uint32_t index_of(const solids::RevolvedBody& body, SweepPurpose purpose) const {
    return indexes_.at({&body, purpose});
  }

 private:
  std::vector<SweptShape> shapes_;
  std::map<std::pair<const solids::RevolvedBody*, SweepPurpose>, std::uint32_t> indexes_;
};

/// Divides sweeps into units. Arcs that are not level become chords, and motions that turn the axis become poses and
/// short straight motions; the deviations are stated in stock.h.
class SweepDivider {
 public:
  /// Refers to the shapes. `spacing` is that of the dexels, mm. There is no material above `top`, mm.
  SweepDivider(const SweptShapes& shapes, double spacing, double top);

  /// Appends the units of a sweep that has an index.
  void append(const Sweep& sweep, std::uint32_t index);
  std::span<const UnitSweep> units() const { return units_; }

 private:
  void append(const StraightPath& path);
  void append(const HelixPath& path);
  void append(const TurningPath& path);
  void append_line(const geometry::Vec3& from, const geometry::Vec3& to, const geometry::Vec3& axis);
  void append_chords(const geometry::Helix& helix, const geometry::Vec3& axis);
  void append_level(const geometry::Helix& helix, bool is_upside_down);
  void append_turn(const TurningPath& path, std::size_t piece);
  void append_slanted(const solids::AxisPlacement& from, const geometry::Vec3& travel, std::size_t first_piece,
                      std::size_t piece_count);
  void append_upright(const std::variant<UprightLine, LevelArc, SlantedLine>& motion, bool is_upside_down,
                      const solids::BoundingBox& path);
  const SweptShape& shape() const { return shapes_[shape_]; }

  const SweptShapes& shapes_;
  double tolerance_;
  double top_;
  std::vector<UnitSweep> units_;
  std::pair<const solids::RevolvedBody*, SweepPurpose> last_body_ = {nullptr, SweepPurpose::Cut};
  std::uint32_t shape_ = 0;  ///< Of the sweep that is being divided.
  std::uint32_t sweep_ = 0;  ///< Its index.
  std::uint32_t piece_ = 0;  ///< The index of the piece that is being divided.
};

/// The units of sweeps, in order.
class UnitSweeps {
 public:
  /// `spacing` and `top` as SweepDivider has them. The units are the same for any number of threads.
  UnitSweeps(std::span<const Sweep> sweeps, double spacing, double top, const Workers& workers);
  UnitSweeps(const UnitSweeps&) = delete;  // Its parts refer to its shapes.
  UnitSweeps& operator=(const UnitSweeps&) = delete;

  std::size_t size() const { return units_.size(); }
  const UnitSweep& operator[](std::size_t index) const { return *units_[index]; }
  const SweptShape& shape_of(const UnitSweep& unit) const { return shapes_[unit.shape]; }
  /// Cuts the dexels of a sink by a unit, or counts what it meets. `before`, if any, is a unit that has cut them
  /// already; if that was a motion to the start of this one, half of the dexels need not be looked at.
  void apply(const UnitSweep& unit, const UnitSweep* before, DexelSink& sink) const;

 private:
  SweptShapes shapes_;
  std::vector<SweepDivider> parts_;
  std::vector<const UnitSweep*> units_;  ///< Of all parts.
};

}  // namespace isocnc::stock
