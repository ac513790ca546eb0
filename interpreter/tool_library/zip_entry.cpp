#include "interpreter/tool_library/zip_entry.h"

#include <climits>
#include <cstdint>

// Of the library of pictures only what unpacks.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_SUPPORT_ZLIB
#define STBI_NO_STDIO
#define STBI_NO_JPEG
#define STBI_NO_PNG
#define STBI_NO_BMP
#define STBI_NO_PSD
#define STBI_NO_TGA
#define STBI_NO_GIF
#define STBI_NO_HDR
#define STBI_NO_PIC
#define STBI_NO_PNM
#define STBI_NO_LINEAR
#include <stb/stb_image.h>

namespace isocnc::tool_library {

/// Numbers of an archive stand with the lowest byte first; what is beyond its end counts as 0.
static std::uint32_t number_at(std::string_view archive, std::size_t at, std::size_t bytes) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < bytes && at + i < archive.size(); ++i)
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(archive[at + i])) << (8 * i);
  return number;
}

static bool has_signature(std::string_view archive, std::size_t at, std::string_view signature) {
  return at <= archive.size() && archive.substr(at).starts_with(signature);
}

/// The file whose entry in the directory of the archive starts at `entry`.
static std::optional<std::string> unpacked(std::string_view archive, std::size_t entry, std::size_t limit) {
  constexpr std::size_t kLocalHeader = 30;
  constexpr std::uint32_t kStored = 0;
  constexpr std::uint32_t kDeflated = 8;
  const bool is_encrypted = (number_at(archive, entry + 8, 2) & 1) != 0;
  const std::uint32_t method = number_at(archive, entry + 10, 2);
  const std::size_t packed_size = number_at(archive, entry + 20, 4);
  const std::size_t size = number_at(archive, entry + 24, 4);
  const std::size_t header = number_at(archive, entry + 42, 4);
  if (is_encrypted || size > limit || !has_signature(archive, header, "PK\x03\x04")) return std::nullopt;
  const std::size_t begin =
      header + kLocalHeader + number_at(archive, header + 26, 2) + number_at(archive, header + 28, 2);
  if (begin > archive.size() || packed_size > archive.size() - begin || packed_size > INT_MAX - 8 || size > INT_MAX)
    return std::nullopt;
  const std::string_view packed = archive.substr(begin, packed_size);
  if (method == kStored) return packed_size == size ? std::optional(std::string(packed)) : std::nullopt;
  if (method != kDeflated) return std::nullopt;
  std::string file(size, '\0');
  std::string input(packed);
  input.append(8, '\0');  // The decoder reads ahead.
  const int written = stbi_zlib_decode_noheader_buffer(file.data(), static_cast<int>(size), input.data(),
                                                       static_cast<int>(input.size()));
  return written >= 0 && static_cast<std::size_t>(written) == size ? std::optional(std::move(file)) : std::nullopt;
}

std::optional<std::string> zip_entry(std::string_view archive, std::string_view name, std::size_t limit) {
  constexpr std::size_t kEntry = 46;
  const std::size_t end = archive.rfind("PK\x05\x06");
  if (end == std::string_view::npos) return std::nullopt;
  const std::uint32_t count = number_at(archive, end + 10, 2);
  std::size_t at = number_at(archive, end + 16, 4);
  for (std::uint32_t i = 0; i < count && has_signature(archive, at, "PK\x01\x02"); ++i) {
    const std::size_t name_size = number_at(archive, at + 28, 2);
    if (archive.size() - at >= kEntry && archive.substr(at + kEntry, name_size) == name)
      return unpacked(archive, at, limit);
    at += kEntry + name_size + number_at(archive, at + 30, 2) + number_at(archive, at + 32, 2);
  }
  return std::nullopt;
}

}  // namespace isocnc::tool_library
