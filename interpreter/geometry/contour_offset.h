#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include "interpreter/geometry/plane_curve.h"

namespace isocnc::geometry {

/// A line or an arc of a contour, and how the cutter must follow it.
struct ContourElement {
  PlaneCurve curve;       ///< Longer than 0.
  std::uint64_t tag = 0;  ///< Number set by the caller, ascending; copied to the element's pieces and flaws.
  int side = 1;           ///< The cutter runs to the left (1) or to the right (-1).
  bool reduces = false;   ///< Parts that the cutter cannot reach without a gouge are omitted.
  bool cuts = true;       ///< False for rapids, which are excluded from the gouge check.
};

/// A piece of the path of the cutter's center.
struct OffsetPiece {
  PlaneCurve curve;
  std::uint64_t tag = 0;
  bool is_inserted = false;  ///< A corner or a lead-in, not the offset of the element itself.
};

/// A place where the cutter does not fit: an inside arc that is too small, or a gouge.
struct ContourFlaw {
  std::uint64_t tag = 0;
  std::optional<double> small_arc;  ///< Radius of an inside arc that is smaller than the cutter's; empty for a gouge.
};

/// Leads the center of a round cutter along a contour, offset by the cutter's radius. All in one plane, mm. Pieces come
/// out a few elements after their element goes in; memory does not grow. A value: a copy runs independently.
///
/// Outside corners are rounded about their point; at inside corners both offsets are trimmed where they cross. Offsets
/// that do not cross are connected by a straight line, which gouges the contour; where the elements reduce the contour,
/// the loop that gouges is cut off where its ends cross, if that is within kLookAhead pieces. The path is always
/// continuous.
///
/// Gouge check: reports where a piece comes nearer to an element than the radius, by more than kGouge.
/// - Each piece is compared with the kNeighbors elements before and after it, and with those of the last kLookBack
///   whose wall faces its own, as on both sides of a neck.
/// - Not compared: other elements, because a finishing pass runs where the wall of the roughing pass was; and
///   consecutive elements that are tangent.
/// - Lead-in and lead-out cross the place where the contour closes. Hence they are compared with their neighbors only,
///   at half the radius.
class ContourOffset {
 public:
  static constexpr std::size_t kLookAhead = 32;
  static constexpr std::size_t kLookBack = 256;
  static constexpr std::uint64_t kNeighbors = 3;
  static constexpr double kGouge = 0.01;  ///< mm

  /// `radius` above 0.
  explicit ContourOffset(double radius) : radius_(radius) {}

  double radius() const { return radius_; }

  /// Starts a contour; call it first, or after finish(). The cutter moves straight from `line.start` to the offset
  /// start of the next element, or, without a next element, to `line.end`.
  void lead_in(const PlaneCurve& line, const ContourElement& like, bool is_inserted);
  /// Adds an element; call it after lead_in().
  void add(const ContourElement& element);
  /// Moves the cutter to the offset end of the last element, and emits all pieces. The contour may continue from there:
  /// an outside corner is rounded as usual; at an inside corner the cutter goes straight to the offset start of the
  /// next element.
  void finish();
  /// Adds a straight lead-out. It is checked for gouges but not returned by next_piece().
  void lead_out(const PlaneCurve& line, std::uint64_t tag);
  /// Excludes everything cut so far from gouge checks, because the cutter has been raised.
  void forget() { ++pass_; }

  std::optional<OffsetPiece> next_piece();
  std::optional<ContourFlaw> next_flaw();

  /// Bytes held beside the object itself, once the caller has taken all pieces and flaws.
  std::size_t memory() const { return contour_.size() * sizeof(KeptElement) + pieces_.size() * sizeof(KeptPiece); }

 private:
  struct KeptElement {
    PlaneCurve curve;
    Eigen::AlignedBox2d box;
    std::uint64_t number = 0;
    std::uint64_t pass = 0;
    int side = 1;
    bool is_too_small = false;
    bool is_smooth = false;  // Tangent to the element before it.
  };
  struct KeptPiece {
    OffsetPiece out;
    Eigen::AlignedBox2d box;   // Box around the piece, set once its end is known.
    std::uint64_t number = 0;  // Number of its element.
    std::uint64_t pass = 0;
    int side = 1;
    bool cuts = true;
    bool is_lead_in = false;  // Lead-in or lead-out.
    bool is_smooth = false;
    bool gouges = false;
    bool has_gouge_to_report = false;  // A gouge that no other finding explains.
    bool is_reported = false;
  };

  void join(PlaneCurve& next, const ContourElement& element, const Vec2& arriving);
  bool trim(PlaneCurve& next);
  void insert(const PlaneCurve& curve);
  void finish_piece(KeptPiece& piece);
  void look_at(KeptPiece& piece, const KeptElement& element) const;
  bool closes(const PlaneCurve& curve) const;
  bool has_stopped() const { return emitted_ == pieces_.size(); }
  bool is_explained(std::uint64_t a, std::uint64_t b) const;
  void reduce(std::size_t last);
  bool cut_loop(std::size_t first, std::size_t last);
  void release(std::size_t held);
  void report_gouge(KeptPiece& piece);

  double radius_;
  std::deque<KeptElement> contour_;  // The last kLookBack elements that cut.
  std::deque<KeptPiece> pieces_;  // Emitted pieces of the last kLookBack elements, then waiting ones; the last is open.
  std::size_t emitted_ = 0;       // Number of emitted pieces in `pieces_`.
  std::deque<OffsetPiece> out_;
  std::deque<ContourFlaw> flaws_;
  std::uint64_t count_ = 0;   // Number of elements.
  std::uint64_t before_ = 0;  // Number of elements before this contour.
  // First element that starts where the contour did.
  std::uint64_t closing_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t pass_ = 0;
  int side_ = 0;  // Side of the last element.
  Vec2 arriving_ = Vec2::Zero();
};

}  // namespace isocnc::geometry
