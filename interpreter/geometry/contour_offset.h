#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include "interpreter/geometry/plane_curve.h"

namespace isocnc::geometry {

/// A line or an arc of a contour, and how the cutter is to follow it.
struct ContourElement {
  PlaneCurve curve;       ///< Of some length.
  std::uint64_t tag = 0;  ///< The caller's; comes back with what the element becomes. Grows from each to the next.
  int side = 1;           ///< The cutter runs to the left (1) or to the right (-1).
  bool reduces = false;   ///< Whatever the cutter cannot reach without a gouge is left out.
  bool cuts = true;       ///< Else it is neither spared nor looked after, as rapids are.
};

/// A piece of the way of the cutter's center.
struct OffsetPiece {
  PlaneCurve curve;
  std::uint64_t tag = 0;
  bool is_inserted = false;  ///< A corner, or a way onto the contour, and not the element itself.
};

/// Something that the cutter cannot do as the contour wants it.
struct ContourFlaw {
  std::uint64_t tag = 0;
  std::optional<double> small_arc;  ///< The radius of an inside arc that is smaller than the cutter's; else a gouge.
};

/// Leads the center of a round cutter along a contour, beside it by the cutter's radius. All in one plane, mm. What
/// goes in comes out a few elements later; memory does not grow. A value: a copy goes on by itself.
///
/// Outside corners are rounded about their point, inside corners end where both sides meet. Where they do not meet, the
/// cutter goes from beside the end of the one straight to beside the begin of the other, and gouges the contour; where
/// the elements reduce the contour, the loop that gouges is cut off where its ends cross, if that is within kLookAhead
/// pieces. The way is always continuous, and where it comes nearer to an element than the radius, by more than kGouge,
/// that is told: to one of the kNeighbors elements before and behind it, and to one of the kLookBack whose wall faces
/// its own, as on both sides of a neck. Other elements are none of its business: a finishing pass goes where the wall
/// of the roughing pass was, and ways on and off lead over where the contour closes. For the same reason elements that
/// go on as they are spare each other, and ways on and off have neighbors alone, and only keep half the radius.
class ContourOffset {
 public:
  static constexpr std::size_t kLookAhead = 32;
  static constexpr std::size_t kLookBack = 256;
  static constexpr std::uint64_t kNeighbors = 3;
  static constexpr double kGouge = 0.01;  ///< mm

  /// `radius` above 0.
  explicit ContourOffset(double radius) : radius_(radius) {}

  double radius() const { return radius_; }

  /// Begins a contour, behind finish() or at first: from `line.start`, where the cutter stands, straight to beside the
  /// begin of the element that comes next, or, when none does, to `line.end`.
  void lead_in(const PlaneCurve& line, const ContourElement& like, bool is_inserted);
  /// Behind lead_in().
  void add(const ContourElement& element);
  /// The cutter comes to beside the end of the last element, and all that is known comes out. The contour may go on
  /// from there: round an outside corner as ever, while inside it goes straight across to beside the begin of the next
  /// one.
  void finish();
  /// A straight way off the contour. It is looked at, and does not come out.
  void lead_out(const PlaneCurve& line, std::uint64_t tag);
  /// What has been cut so far is out of the way of what follows: the cutter has been raised.
  void forget() { ++pass_; }

  std::optional<OffsetPiece> next_piece();
  std::optional<ContourFlaw> next_flaw();

  /// Bytes that it holds, beside itself, when all that came out has been taken.
  std::size_t memory() const { return contour_.size() * sizeof(Kept) + pieces_.size() * sizeof(Piece); }

 private:
  struct Kept {
    PlaneCurve curve;
    Eigen::AlignedBox2d box;
    std::uint64_t number = 0;
    std::uint64_t pass = 0;
    int side = 1;
    bool is_too_small = false;
    bool is_smooth = false;  // Goes on as the element before it.
  };
  struct Piece {
    OffsetPiece out;
    Eigen::AlignedBox2d box;   // Around it, once it has its end.
    std::uint64_t number = 0;  // Of the element.
    std::uint64_t pass = 0;
    int side = 1;
    bool cuts = true;
    bool is_lead_in = false;  // Or leads out.
    bool is_smooth = false;
    bool gouges = false;
    bool has_gouge_to_report = false;  // Of a gouge that no other finding explains.
    bool is_reported = false;
  };

  void join(PlaneCurve& next, const ContourElement& element, const Vec2& arriving);
  bool trim(PlaneCurve& next);
  void insert(const PlaneCurve& curve);
  void finish_piece(Piece& piece);
  void look_at(Piece& piece, const Kept& element) const;
  bool closes(const PlaneCurve& curve) const;
  bool has_stopped() const { return emitted_ == pieces_.size(); }
  bool is_explained(std::uint64_t a, std::uint64_t b) const;
  void reduce(std::size_t last);
  bool cut_loop(std::size_t first, std::size_t last);
  void release(std::size_t held);
  void report_gouge(Piece& piece);

  double radius_;
  std::deque<Kept> contour_;  // Elements that cut, the last kLookBack.
  std::deque<Piece> pieces_;  // Given out, those of the last kLookBack elements, then waiting; the last has no end yet.
  std::size_t emitted_ = 0;   // Of pieces_.
  std::deque<OffsetPiece> out_;
  std::deque<ContourFlaw> flaws_;
  std::uint64_t count_ = 0;                                            // Elements.
  std::uint64_t before_ = 0;                                           // Of them, before this contour.
  std::uint64_t closing_ = std::numeric_limits<std::uint64_t>::max();  // The first that begins where this one did.
  std::uint64_t pass_ = 0;
  int side_ = 0;  // Of the last element.
  Vec2 arriving_ = Vec2::Zero();
};

}  // namespace isocnc::geometry
