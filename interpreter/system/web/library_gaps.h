#pragma once

// What C++20 has and the standard library of Debian's Emscripten, libc++ 14, has not yet. Included by all sources of a
// build for WebAssembly.

#include <cstddef>
#include <memory>
#include <type_traits>
#include <version>

// NOLINTBEGIN(cert-dcl58-cpp)
namespace std {

#ifndef __cpp_lib_bit_cast
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> && is_trivially_copyable_v<From>);
  return __builtin_bit_cast(To, from);
}
#endif

#ifndef __cpp_lib_smart_ptr_for_overwrite
template <class Array>
unique_ptr<Array> make_unique_for_overwrite(size_t size) {
  static_assert(is_unbounded_array_v<Array>);
  return unique_ptr<Array>(new remove_extent_t<Array>[size]);
}
#endif

}  // namespace std
// NOLINTEND(cert-dcl58-cpp)
