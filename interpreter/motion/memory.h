#pragma once

#include <cstddef>

namespace isocnc::motion {

/// Returns the size of a container's elements in bytes, without the container's own overhead.
template <class Container>
std::size_t bytes_of(const Container& container) {
  return container.size() * sizeof(typename Container::value_type);
}

}  // namespace isocnc::motion
