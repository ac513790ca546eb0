#pragma once

#include <cmath>

/// What loops take that are to become vectors.

/// Before a function with such loops: compiled twice, the second time for processors with vectors of 256 bits (AVX2),
/// which is chosen as the program starts. The results are the same to the last bit: no operations are put together, and
/// none change places.
#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ISOCNC_VECTOR_CLONES [[gnu::target_clones("avx2", "default")]]
#else
#define ISOCNC_VECTOR_CLONES
#endif

namespace isocnc::chords {

/// The square root, or 0 of what is not positive. Without a branch.
inline double square_root(double square) { return std::sqrt((square + std::abs(square)) / 2); }

/// A float that is not below, or above, a height; off by at most a relative 2^-23. Without a branch, too.
inline float float_above(double height) { return static_cast<float>(height + std::abs(height) * 6.0e-8); }
inline float float_below(double height) { return -float_above(-height); }

/// The value, or 0 of what is negative. Without a branch, too.
inline float positive(float value) { return (value + std::abs(value)) / 2; }

}  // namespace isocnc::chords
