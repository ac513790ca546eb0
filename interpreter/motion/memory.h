#pragma once

#include <cstddef>

namespace isocnc::motion {

/// Bytes of a container's elements, about.
template <class Container>
std::size_t bytes_of(const Container& container) {
  return container.size() * sizeof(typename Container::value_type);
}

}  // namespace isocnc::motion
