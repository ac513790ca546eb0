#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace isocnc::text {

/// What is between the commas, as views of `list`: at least one element, which may be empty.
inline std::vector<std::string_view> split_at_commas(std::string_view list) {
  std::vector<std::string_view> elements;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t comma = std::min(list.find(',', begin), list.size());
    elements.push_back(list.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return elements;
}

}  // namespace isocnc::text
