#include "interpreter/solids/inner_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "interpreter/solids/convex_clearance.h"
#include "interpreter/solids/hulls.h"
#include "interpreter/solids/mesh_edges.h"

namespace isocnc::solids {

using geometry::Vec3;

namespace {

constexpr double kFlat = 1e-6;                         ///< Radians between faces that are one.
constexpr double kFacet = std::numbers::pi / 6;        ///< Largest turn from one facet to the next.
constexpr double kSharpest = 0.99 * std::numbers::pi;  ///< Outer edges count as no sharper.
constexpr std::uint32_t kNoFace = ~std::uint32_t{0};

/// The faces beside each edge of a closed mesh. Edge i of a triangle runs from its corner i to the next one.
class EdgeNeighbors {
 public:
  explicit EdgeNeighbors(std::span<const Triangle> triangles)
      : corners_(corner_numbers(triangles)), beside_(triangles.size(), {kNoFace, kNoFace, kNoFace}) {
    std::vector<detail::MeshEdge> edges = detail::sorted_edges(corners_);
    for (std::size_t i = 0; i < edges.size();) {
      const std::size_t end = detail::end_of_same(edges, i);
      pair(std::span(edges).subspan(i, end - i));
      i = end;
    }
  }

  /// kNoFace for an edge without length.
  std::uint32_t beside(std::uint32_t face, std::uint32_t edge) const { return beside_[face][edge]; }
  /// The number of a face's corner; equal corners have the same.
  std::uint32_t corner(std::uint32_t face, std::uint32_t index) const { return corners_[3 * face + index]; }

 private:
  /// Each edge with one that runs the other way; in a closed mesh there is one.
  void pair(std::span<detail::MeshEdge> edges) {
    const auto downs =
        std::stable_partition(edges.begin(), edges.end(), [](const detail::MeshEdge& e) { return e.runs_up; });
    for (auto up = edges.begin(), down = downs; up != downs && down != edges.end(); ++up, ++down) {
      beside_[up->start / 3][up->start % 3] = down->start / 3;
      beside_[down->start / 3][down->start % 3] = up->start / 3;
    }
  }

  std::vector<std::uint32_t> corners_;
  std::vector<std::array<std::uint32_t, 3>> beside_;
};

/// A half plane: inwards . p is at least `low`.
struct HalfPlane {
  Vec3 inwards;
  double low = 0;
};

using ConvexPolygon = std::vector<Vec3>;

ConvexPolygon clipped(const ConvexPolygon& polygon, const HalfPlane& to) {
  ConvexPolygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& from = polygon[i];
    const Vec3& next = polygon[(i + 1) % polygon.size()];
    const double at = to.inwards.dot(from) - to.low;
    const double at_next = to.inwards.dot(next) - to.low;
    if (at >= 0) result.push_back(from);
    if ((at < 0) != (at_next < 0)) result.push_back(from + at / (at - at_next) * (next - from));
  }
  return result;
}

/// A face's edge, with how the surface goes on beside it.
struct FaceEdge {
  Vec3 from;
  Vec3 to;
  Vec3 along;       ///< Unit vector; 0 for an edge without length.
  Vec3 inwards;     ///< Unit vector across it, into the face.
  double turn = 0;  ///< From this face's normal to the next one's, radians: positive at an outer edge.

  bool is_outer() const { return turn > kFlat; }
  bool is_inner() const { return turn < -kFlat; }
  int facets() const { return std::max(1, static_cast<int>(std::ceil(-turn / kFacet))); }
  /// Half the turn from one facet to the next.
  double half_step() const { return -turn / facets() / 2; }
};

class InnerFaces {
 public:
  InnerFaces(std::span<const Triangle> faces, double depth) : faces_(faces), neighbors_(faces), depth_(depth) {
    normals_.reserve(faces.size());
    for (const Triangle& face : faces) {
      const Vec3 area = face.area_vector();
      normals_.push_back(area.norm() > 0 ? Vec3(area.normalized()) : Vec3(Vec3::Zero()));
    }
    find_rims();
  }

  std::vector<Triangle> make() {
    for (std::uint32_t face = 0; face < faces_.size(); ++face)
      if (!normals_[face].isZero(0)) add_face(face);
    return std::move(result_);
  }

 private:
  FaceEdge edge_of(std::uint32_t face, std::uint32_t index) const {
    const Triangle& triangle = faces_[face];
    FaceEdge edge{.from = triangle.corners[index],
                  .to = triangle.corners[(index + 1) % 3],
                  .along = Vec3::Zero(),
                  .inwards = Vec3::Zero()};
    const Vec3& normal = normals_[face];
    const double length = (edge.to - edge.from).norm();
    const std::uint32_t beside = neighbors_.beside(face, index);
    if (!(length > 0) || beside == kNoFace) return edge;
    edge.along = (edge.to - edge.from) / length;
    edge.inwards = normal.cross(edge.along);
    const Vec3& other = normals_[beside];
    if (!other.isZero(0)) edge.turn = std::atan2(normal.cross(other).dot(edge.along), normal.dot(other));
    return edge;
  }

  /// An outer edge that ends at a corner of a face.
  struct RimEnd {
    std::uint32_t corner;
    std::uint32_t face;
    double inset;   ///< By how much the shifted face ends before the edge, mm.
    HalfPlane end;  ///< Where it ends.
    Vec3 along;     ///< From the corner along the edge, unit vector.
  };

  /// A face at one of its corners.
  struct FaceCorner {
    std::uint32_t corner;
    std::uint32_t face;
    double angle;  ///< Radians.
  };

  double inset_of(const FaceEdge& edge) const { return depth_ * std::tan(std::min(edge.turn, kSharpest) / 2); }
  HalfPlane end_at(const FaceEdge& edge) const { return {edge.inwards, edge.inwards.dot(edge.from) + inset_of(edge)}; }

  void find_rims() {
    for (std::uint32_t face = 0; face < faces_.size(); ++face)
      for (std::uint32_t i = 0; i < 3; ++i) {
        const auto& corners = faces_[face].corners;
        const Vec3 one = corners[(i + 1) % 3] - corners[i];
        const Vec3 other = corners[(i + 2) % 3] - corners[i];
        corners_.push_back({neighbors_.corner(face, i), face, std::atan2(one.cross(other).norm(), one.dot(other))});
        const FaceEdge edge = edge_of(face, i);
        if (!edge.is_outer()) continue;
        rims_.push_back({neighbors_.corner(face, i), face, inset_of(edge), end_at(edge), edge.along});
        rims_.push_back({neighbors_.corner(face, (i + 1) % 3), face, inset_of(edge), end_at(edge), -edge.along});
      }
    const auto by_place = [](const auto& a, const auto& b) {
      return std::pair(a.corner, a.face) < std::pair(b.corner, b.face);
    };
    std::stable_sort(rims_.begin(), rims_.end(), by_place);
    std::stable_sort(corners_.begin(), corners_.end(), by_place);
  }

  /// Those of a list that are at a corner, on the plane of a face.
  template <class Ends, class Use>
  void for_each_at(const Ends& ends, std::uint32_t corner, std::uint32_t face, Use&& use) const {
    constexpr double kSamePlane = 1e-3;
    for (auto end = std::lower_bound(ends.begin(), ends.end(), corner,
                                     [](const auto&each, std::uint32_t number) { return each.corner < number; });
         end != ends.end() && end->corner == corner; ++end)
      if ((normals_[end->face] - normals_[face]).norm() < kSamePlane) use(*end);
  }

  /// A face with a corner on the rim of the plane that it is part of ends before the rim, as its neighbors do. Where
  /// the rim turns inwards, what is near the corner counts instead of what is near the edge's line beyond it.
  void add_ends_at_corners(std::uint32_t face) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t corner = neighbors_.corner(face, i);
      const Vec3& at = faces_[face].corners[i];
      const Vec3 one = faces_[face].corners[(i + 1) % 3] - at;
      const Vec3 other = faces_[face].corners[(i + 2) % 3] - at;
      double angle = 0;
      for_each_at(corners_, corner, face, [&](const FaceCorner& each) { angle += each.angle; });
      double inset = 0;
      for_each_at(rims_, corner, face, [&](const RimEnd& rim) {
        if (angle < std::numbers::pi - kFlat || (one.dot(rim.along) >= 0 && other.dot(rim.along) >= 0))
          ends_.push_back(rim.end);
        else
          inset = std::max(inset, rim.inset);
      });
      const Vec3 middle = one.normalized() + other.normalized();
      if (!(inset > 0) || !(middle.norm() > 0)) continue;
      // The chord of the circle about the corner.
      const Vec3 inwards = middle.normalized();
      ends_.push_back({inwards, inwards.dot(at) + inset * inwards.dot(one.normalized())});
    }
  }

  /// The shifted face, longer at inner edges and shorter at outer ones.
  void add_face(std::uint32_t face) {
    const Vec3& normal = normals_[face];
    const Vec3 shift = -depth_ * normal;
    std::array<FaceEdge, 3> edges;
    for (std::uint32_t i = 0; i < 3; ++i) edges[i] = edge_of(face, i);
    ends_.clear();
    add_ends_at_corners(face);
    ConvexPolygon polygon;
    for (std::uint32_t i = 0; i < 3; ++i) polygon.push_back(faces_[face].corners[i] + shift + corner_shift(edges, i));
    // Ends that have passed one another leave nothing.
    if ((polygon[1] - polygon[0]).cross(polygon[2] - polygon[0]).dot(normal) > 0) add_ended(std::move(polygon), normal);
    for (std::uint32_t i = 0; i < 3; ++i)
      if (edges[i].is_inner() && face < neighbors_.beside(face, i)) add_facets(edges[i], normal);
  }

  /// How far inwards the shifted face ends at an edge, mm; negative at an inner edge.
  double end_of(const FaceEdge& edge) const {
    if (edge.is_outer()) return inset_of(edge);
    return edge.is_inner() ? -depth_ * std::tan(edge.half_step()) : 0.0;
  }

  /// From a corner of a face to where the ends at both edges meet. At a sharp corner, the point of a longer face is cut
  /// off, not as far as its edges are shifted.
  Vec3 corner_shift(const std::array<FaceEdge, 3>& edges, std::uint32_t corner) {
    constexpr double kLongest = 3;
    const FaceEdge& before = edges[(corner + 2) % 3];
    const FaceEdge& after = edges[corner];
    const double first = end_of(before);
    const double second = end_of(after);
    const double cosine = before.inwards.dot(after.inwards);
    const double square = 1 - cosine * cosine;
    if (!(square > 1e-12)) return std::min(first, 0.0) * before.inwards + std::min(second, 0.0) * after.inwards;
    const Vec3 shift =
        ((first - cosine * second) * before.inwards + (second - cosine * first) * after.inwards) / square;
    const double most = kLongest * std::max(std::abs(first), std::abs(second));
    const Vec3 middle = after.along - before.along;
    if (shift.norm() > most && middle.norm() > 0 && shift.dot(middle) < 0) {
      const Vec3 inwards = middle.normalized();
      ends_.push_back({inwards, inwards.dot(after.from) - most});
    }
    return shift;
  }

  /// Those between the faces at an inner edge.
  void add_facets(const FaceEdge& edge, const Vec3& normal) {
    const int count = edge.facets();
    for (int i = 1; i < count; ++i) {
      const Vec3 facing = Eigen::AngleAxisd(edge.turn * i / count, edge.along) * normal;
      const Vec3 half = depth_ * std::tan(edge.half_step()) * edge.along.cross(facing);
      const Vec3 from = edge.from - depth_ * facing;
      const Vec3 to = edge.to - depth_ * facing;
      add({from - half, to - half, to + half, from + half}, facing);
    }
  }

  void add_ended(ConvexPolygon polygon, const Vec3& normal) {
    for (const HalfPlane& end : ends_) polygon = clipped(polygon, end);
    add(polygon, normal);
  }

  void add(const ConvexPolygon& polygon, const Vec3& normal) {
    constexpr double kNoArea = 1e-12;  // mm^2
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      Triangle triangle{{polygon[0], polygon[i - 1], polygon[i]}};
      const double area = triangle.area_vector().dot(normal);
      if (!(std::abs(area) > kNoArea)) continue;
      if (area < 0) std::swap(triangle.corners[1], triangle.corners[2]);
      result_.push_back(triangle);
    }
  }

  std::span<const Triangle> faces_;
  EdgeNeighbors neighbors_;
  double depth_;
  std::vector<Vec3> normals_;
  std::vector<RimEnd> rims_;         ///< By their corners.
  std::vector<FaceCorner> corners_;  ///< By their corners.
  std::vector<HalfPlane> ends_;      ///< Where the present face ends at outer edges.
  std::vector<Triangle> result_;
};

}  // namespace

InnerSurface::InnerSurface(std::shared_ptr<const Mesh> whole, double depth) : whole_(std::move(whole)), depth_(depth) {
  std::vector<Triangle> faces = InnerFaces(whole_->triangles(), depth).make();
  if (!faces.empty()) faces_.emplace(std::move(faces));
}

namespace {

/// What is nearer than this to a face is looked at closely, mm.
constexpr double kNear = 0.025;

/// A point of a triangle that is within `within` of a convex core, if both have one: from one to the other and back.
template <class Core>
std::optional<Vec3> common_point(const Core& core, double within, const Triangle& triangle, Vec3 from) {
  constexpr int kRounds = 64;
  for (int i = 0; i < kRounds; ++i) {
    const Vec3 on_core = core.nearest(from);
    if ((on_core - from).norm() <= within + kRounding) return from;
    from = triangle.nearest(on_core);
  }
  return {};
}

std::vector<detail::PieceInPlace> pieces_of(const RevolvedBody& body, const AxisPlacement& at) {
  std::vector<detail::PieceInPlace> pieces;
  for (const BodyPiece& piece : body.pieces()) pieces.push_back(detail::placed(piece, at));
  return pieces;
}

/// What a body does at the faces of an inner surface that it is near to.
class NearFaces {
 public:
  NearFaces(const RevolvedBody& body, const AxisPlacement& at, const InnerSurface& inner)
      : body_(body), at_(at), inner_(inner), hull_(pieces_of(body, at)) {}

  /// `is_thorough`: where the body goes deeper, looks for its deepest point with care.
  Clearance clearance(bool is_thorough) {
    look();
    if (!is_deep()) detail::DeepPoints(inner_.whole(), deepest_).take(body_, at_);
    go_deeper();
    if (is_thorough && is_deep()) climb();
    const double beyond = deepest_.depth() - inner_.depth();
    if (beyond > -kRounding) {
      deepest_.lower = deepest_.upper = -std::max(beyond, 0.0);
      return deepest_;
    }
    if (nearest_.upper < kExact) return nearest_;
    // Only faces that are less deep: the body goes on at least by a part of what it is less deep than it may be.
    return detail::bounded_by(std::max(kNear, -beyond / 2));
  }

 private:
  static constexpr int kMaxFaces = 64;

  /// The deepest point of a body is the lowest one before the surface that is nearest to it: of all points, or, as on
  /// the side of a long cutter, of those beside one place on the axis.
  void go_deeper() {
    constexpr int kRounds = 4;
    for (int i = 0; i < kRounds; ++i) {
      const double depth = deepest_.depth();
      const Vec3 outwards = deepest_.on_obstacle - deepest_.on_body;
      if (!(depth > 0 && outwards.norm() > 0)) return;
      const Vec3 n = outwards.normalized();
      take(hull_.lowest_point(n));
      for (const BodyPiece& piece : body_.pieces()) take(point_beside(piece, n));
      if (!(deepest_.depth() > depth + kRounding)) return;
    }
  }

  void take(const Vec3& point) { detail::DeepPoints(inner_.whole(), deepest_).take_point(point, 0); }

  /// The point of a piece that lies lowest along `n` of those beside one place on the axis, that of the deepest point.
  Vec3 point_beside(const BodyPiece& piece, const Vec3& n) const {
    const solids::Frustum& core = piece.core;
    const double height = std::clamp(at_.axis.dot(deepest_.on_body - at_.origin), core.bottom, core.top);
    const double length = core.top - core.bottom;
    const double part = length > 0 ? (height - core.bottom) / length : 0;
    const double radius = core.bottom_radius + part * (core.top_radius - core.bottom_radius);
    const Vec3 across = n - n.dot(at_.axis) * at_.axis;
    const Vec3 beside = across.norm() > 0 ? Vec3(across.normalized()) : Vec3(Vec3::Zero());
    return at_.at(height) - radius * beside - piece.rounding * n;
  }

  /// Goes away from the nearest face in steps that become shorter: so it ends between the faces that are equally near,
  /// where the body is deepest.
  void climb() {
    constexpr int kSteps = 48;
    constexpr double kShorter = 0.87;
    const detail::PieceInPlace piece = piece_of(deepest_.on_body);
    Vec3 point = deepest_.on_body;
    double step = std::max(deepest_.depth(), body_.sphere_radius() / 50);
    for (int i = 0; i < kSteps; ++i, step *= kShorter) {
      const Vec3 on_surface = detail::nearest_on_surface(inner_.whole(), point);
      const Vec3 away = point - on_surface;
      const double distance = away.norm();
      const bool is_inside = inner_.whole().encloses(point);
      if (is_inside && distance > deepest_.depth())
        deepest_ = {.lower = -distance, .upper = -distance, .on_body = point, .on_obstacle = on_surface};
      if (!(distance > 0)) return;
      point = detail::PieceHull::nearest_of(piece, point + (is_inside ? step : -step) / distance * away);
    }
  }

  const detail::PieceInPlace& piece_of(const Vec3& point) const {
    const auto distance = [&](const detail::PieceInPlace& piece) {
      return (detail::PieceHull::nearest_of(piece, point) - point).norm();
    };
    return *std::min_element(hull_.pieces().begin(), hull_.pieces().end(),
                             [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  }

  /// Whether a point of the body is as deep as a face should be.
  bool is_deep() const { return deepest_.depth() > inner_.depth() - kRounding; }
  bool is_deep(const Vec3& point) const {
    Clearance found{.lower = 0, .upper = 0};
    detail::DeepPoints(inner_.whole(), found).take_point(point, 0);
    return found.depth() > inner_.depth() - kRounding;
  }

  /// Points of near faces, and points of the body that lie lowest before them.
  void look() {
    int left = kMaxFaces;
    for (const detail::PieceInPlace& piece : hull_.pieces()) {
      const auto grown = detail::rounded(piece.core, piece.rounding + kNear);
      detail::MeshSearch(*inner_.faces(), grown, 0).each_touching([&](const Triangle& face, const Clearance& found) {
        const Vec3 normal = face.area_vector().normalized();
        detail::DeepPoints deep(inner_.whole(), deepest_);
        // No point is farther from the surface than from the face below the surface, and that one from it.
        const Vec3 lowest = hull_.lowest_point(normal);
        if (inner_.depth() + (face.nearest(lowest) - lowest).norm() > deepest_.depth()) deep.take_point(lowest, 0);
        if (is_deep()) return --left > 0;
        if (const auto common = common_point(piece.core, piece.rounding, face, found.on_obstacle)) {
          deep.take_point(*common, 0);
        } else if (found.upper + kNear > 0 && is_deep(found.on_obstacle)) {
          Clearance apart = found;
          apart.lower += kNear;
          apart.upper += kNear;
          detail::include(nearest_, apart);
        }
        return --left > 0;
      });
    }
  }

  const RevolvedBody& body_;
  const AxisPlacement& at_;
  const InnerSurface& inner_;
  detail::PieceHull hull_;                        ///< Of the body, in place.
  Clearance deepest_ = {.lower = 0, .upper = 0};  ///< Of points of the body in the mesh.
  Clearance nearest_;                             ///< To faces that are as deep as they should be.
};

}  // namespace

Clearance clearance(const RevolvedBody& body, const AxisPlacement& at, const InnerSurface& inner, double sufficient) {
  if (!inner.faces()) return {};
  const double bound = detail::coarse_bound(body, at, inner.faces()->bounds());
  if (bound >= sufficient || !detail::is_usable(bound)) return detail::bounded_by(bound);
  Clearance nearest;
  for (const BodyPiece& piece : body.pieces()) {
    const detail::PieceInPlace in_place = detail::placed(piece, at);
    detail::MeshSearch(*inner.faces(), in_place, sufficient).until_touch(nearest);
    if (!(nearest.upper > 0)) break;
  }
  const bool is_near = !(nearest.lower > kNear);
  if (!is_near && !inner.whole().encloses(at.at(body.pieces().front().core.bottom))) return nearest;
  const Clearance looked = NearFaces(body, at, inner).clearance(false);
  return is_near || looked.upper <= 0 ? looked : nearest;
}

Clearance deepest(const RevolvedBody& body, const AxisPlacement& at, const InnerSurface& inner) {
  return inner.faces() ? NearFaces(body, at, inner).clearance(true) : Clearance();
}

}  // namespace isocnc::solids
