#pragma once

#include <cstdint>
#include <string_view>

namespace isocnc::text {

/// 64-bit FNV-1a, continued from `hash`: the same on every machine, so that hashes can be kept in files. Bytes of which
/// one is another give another hash.
inline constexpr std::uint64_t kHashStart = 0xcbf29ce484222325ULL;

constexpr std::uint64_t hash_on(std::uint64_t hash, char c) {
  return (hash ^ static_cast<unsigned char>(c)) * 0x00000100000001b3ULL;
}
constexpr std::uint64_t hash_on(std::uint64_t hash, std::string_view bytes) {
  for (const char c : bytes) hash = hash_on(hash, c);
  return hash;
}

}  // namespace isocnc::text
