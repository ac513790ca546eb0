#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "interpreter/solids/obstacle.h"

namespace isocnc::solids {

/// Why bytes are no usable STL file. Files come from elsewhere, so a problem is an ordinary result.
struct StlProblem {
  enum class Kind : std::uint8_t {
    Empty,             ///< No triangle.
    Truncated,         ///< Ends before its end. Binary: shorter than the number of triangles that it states.
    TooLong,           ///< Binary: longer than the number of triangles that it states, so that one of both is wrong.
    UnexpectedWord,    ///< Text: not the word of the format that must stand here.
    NotANumber,        ///< Text: no number where a coordinate must stand.
    NotFinite,         ///< A coordinate that is NaN or infinite.
    TooFar,            ///< A coordinate beyond kMaxCoordinate.
    TooManyTriangles,  ///< More than Mesh::kMaxTriangles.
  };

  Kind kind = Kind::Empty;
  std::size_t offset = 0;    ///< First byte of what is wrong.
  std::size_t line = 0;      ///< Text: line, from 1; 0 in a binary file.
  std::size_t triangle = 0;  ///< Number of complete triangles before the problem.
  std::uint64_t stated = 0;  ///< Binary: number of triangles in the header.
};

using TrianglesOrProblem = std::variant<std::vector<Triangle>, StlProblem>;

/// Reads an STL file, text or binary, in its own unit and frame. A file whose length fits its binary header is binary,
/// whatever its first word; else one that starts with "solid", and has no byte 0 near its start, is text. Normals and
/// attributes are ignored, degenerate triangles are kept. Takes time and memory proportional to the bytes given: no
/// number in the file is trusted.
TrianglesOrProblem read_stl(std::string_view bytes);

/// Writes a binary STL file. Coordinates are rounded to float.
std::string write_stl(std::span<const Triangle> triangles);

}  // namespace isocnc::solids
