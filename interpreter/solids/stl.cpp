#include "interpreter/solids/stl.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include <fast_float/fast_float.h>

#include "interpreter/solids/clearance.h"

namespace isocnc::solids {

using geometry::Vec3;
using StlKind = StlProblem::Kind;

namespace {

constexpr std::size_t kHeaderSize = 84;
constexpr std::size_t kRecordSize = 50;
constexpr std::size_t kNormalSize = 12;

std::uint32_t read_number(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

void write_number(std::string& bytes, std::uint32_t number) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(number >> (8 * i) & 0xFF));
}

std::optional<StlKind> problem_of_coordinate(double coordinate) {
  if (!std::isfinite(coordinate)) return StlKind::NotFinite;
  if (std::abs(coordinate) > kMaxCoordinate) return StlKind::TooFar;
  return {};
}

bool is_binary(std::string_view bytes) {
  return bytes.size() >= kHeaderSize && (bytes.size() - kHeaderSize) / kRecordSize == read_number(bytes, 80) &&
         (bytes.size() - kHeaderSize) % kRecordSize == 0;
}

TrianglesOrProblem read_binary(std::string_view bytes) {
  if (bytes.size() < kHeaderSize) return StlProblem{.kind = StlKind::Truncated, .offset = bytes.size()};
  const std::uint32_t stated = read_number(bytes, 80);
  const std::size_t held = (bytes.size() - kHeaderSize) / kRecordSize;
  if (!is_binary(bytes)) {
    const StlKind kind = held < stated ? StlKind::Truncated : StlKind::TooLong;
    return StlProblem{.kind = kind, .offset = 80, .triangle = held, .stated = stated};
  }
  if (held > Mesh::kMaxTriangles) return StlProblem{.kind = StlKind::TooManyTriangles, .offset = 80, .stated = stated};
  std::vector<Triangle> triangles(held);
  for (std::size_t i = 0; i < 9 * held; ++i) {
    const std::size_t at = kHeaderSize + i / 9 * kRecordSize + kNormalSize + i % 9 * 4;
    const double value = std::bit_cast<float>(read_number(bytes, at));
    if (const auto kind = problem_of_coordinate(value))
      return StlProblem{.kind = *kind, .offset = at, .triangle = i / 9, .stated = stated};
    triangles[i / 9].corners[i / 3 % 3][static_cast<Eigen::Index>(i % 3)] = value;
  }
  if (triangles.empty()) return StlProblem{.kind = StlKind::Empty, .offset = 80};
  return triangles;
}

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_word(std::string_view word, std::string_view expected) {
  return std::equal(word.begin(), word.end(), expected.begin(), expected.end(),
                    [](char a, char b) { return lower(a) == b; });
}

/// Reads the text format: `solid NAME`, facets, `endsolid NAME`, once or several times. Words in any case, separated by
/// any blanks; a name goes on to the end of its line.
class StlText {
 public:
  explicit StlText(std::string_view text) : text_(text) {}

  TrianglesOrProblem read() {
    while (!problem_ && skip_blanks()) read_solid();
    if (!problem_ && triangles_.empty()) fail(StlKind::Empty);
    if (problem_) return *problem_;
    return std::move(triangles_);
  }

 private:
  void read_solid() {
    if (!expect("solid")) return;
    skip_name();
    for (std::string_view word = next_word(); !problem_; word = next_word()) {
      if (same_word(word, "endsolid")) {
        skip_name();
        return;
      }
      if (!same_word(word, "facet")) return fail_at(word);
      read_facet();
    }
  }

  /// After `facet`.
  void read_facet() {
    if (triangles_.size() == Mesh::kMaxTriangles) fail(StlKind::TooManyTriangles);
    if (problem_ || !expect("normal")) return;
    for (int i = 0; i < 3; ++i)
      if (next_word().empty()) return;
    if (!expect("outer") || !expect("loop")) return;
    Triangle triangle;
    for (Vec3& corner : triangle.corners)
      if (!expect("vertex") || !read_coordinates(corner)) return;
    if (!expect("endloop") || !expect("endfacet")) return;
    triangles_.push_back(triangle);
  }

  bool read_coordinates(Vec3& corner) {
    for (double& coordinate : corner) {
      std::string_view word = next_word();
      if (problem_) return false;
      if (word.starts_with('+')) word.remove_prefix(1);
      const auto [end, error] = fast_float::from_chars(word.data(), word.data() + word.size(), coordinate);
      if (end != word.data() + word.size() || word.empty() || error == std::errc::invalid_argument)
        return fail(StlKind::NotANumber);
      if (const auto kind = problem_of_coordinate(coordinate)) return fail(*kind);
    }
    return true;
  }

  /// Returns whether anything is left.
  bool skip_blanks() {
    for (; at_ < text_.size() && is_blank(text_[at_]); ++at_)
      if (ends_line()) ++line_;
    word_ = at_;
    return at_ < text_.size();
  }

  /// A line ends with LF, CR LF or CR.
  bool ends_line() const {
    return text_[at_] == '\n' || (text_[at_] == '\r' && !text_.substr(at_ + 1).starts_with('\n'));
  }

  void skip_name() { at_ = std::min(text_.find_first_of("\r\n", at_), text_.size()); }

  /// Empty, with a problem, at the end.
  std::string_view next_word() {
    if (!skip_blanks()) {
      fail(StlKind::Truncated);
      return {};
    }
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(word_, at_ - word_);
  }

  bool expect(std::string_view expected) {
    const std::string_view word = next_word();
    if (problem_) return false;
    return same_word(word, expected) || fail(StlKind::UnexpectedWord);
  }

  void fail_at(std::string_view word) {
    if (!word.empty()) fail(StlKind::UnexpectedWord);
  }

  bool fail(StlKind kind) {
    if (!problem_) problem_ = StlProblem{.kind = kind, .offset = word_, .line = line_, .triangle = triangles_.size()};
    return false;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t word_ = 0;  ///< Start of the last word.
  std::size_t line_ = 1;
  std::vector<Triangle> triangles_;
  std::optional<StlProblem> problem_;
};

/// A name that is cut off by a byte 0 belongs to a binary header.
bool starts_as_text(std::string_view bytes) {
  constexpr std::size_t kExamined = 512;
  if (bytes.substr(0, kExamined).find('\0') != std::string_view::npos) return false;
  const auto start = std::find_if_not(bytes.begin(), bytes.end(), is_blank);
  const std::string_view rest = bytes.substr(static_cast<std::size_t>(start - bytes.begin()));
  return same_word(rest.substr(0, 5), "solid");
}

}  // namespace

TrianglesOrProblem read_stl(std::string_view bytes) {
  if (bytes.empty()) return StlProblem{.kind = StlKind::Empty};
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string_view text = bytes;
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (!is_binary(bytes) && starts_as_text(text)) return StlText(text).read();
  return read_binary(bytes);
}

std::string write_stl(std::span<const Triangle> triangles) {
  std::string bytes(80, ' ');
  write_number(bytes, static_cast<std::uint32_t>(triangles.size()));
  const auto write_vector = [&](const Vec3& vector) {
    for (const double value : vector) write_number(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  };
  for (const Triangle& triangle : triangles) {
    const Vec3 normal = triangle.area_vector();
    write_vector(normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::Zero()));
    for (const Vec3& corner : triangle.corners) write_vector(corner);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace isocnc::solids
