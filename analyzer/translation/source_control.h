#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace isocnc::translation {

/// A control whose programs can be translated.
enum class SourceControl : std::uint8_t { Fanuc, LinuxCnc, Grbl };

inline constexpr std::string_view kControlNames[] = {"fanuc", "linuxcnc", "grbl"};

constexpr std::optional<SourceControl> control_named(std::string_view name) {
  for (std::size_t i = 0; i < std::size(kControlNames); ++i)
    if (kControlNames[i] == name) return static_cast<SourceControl>(i);
  return std::nullopt;
}

}  // namespace isocnc::translation
