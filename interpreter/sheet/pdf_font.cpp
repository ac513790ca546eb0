#include "interpreter/sheet/pdf_font.h"

#include <array>
#include <cstdint>
#include <utility>

#include "interpreter/text/unicode.h"

namespace isocnc::sheet {

namespace {

/// Widths of Helvetica from the blank to the tilde, in thousandths of the size (Adobe's font metrics).
constexpr std::array<std::uint16_t, 95> kRegular = {
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333,  278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667,  611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278,  556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500,  500, 334, 260, 334, 584};
constexpr std::array<std::uint16_t, 95> kBold = {
    278, 333, 474, 556, 556, 889, 722, 238, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 333, 333, 584, 584, 584, 611, 975, 722, 722, 722, 722, 667,
    611, 778, 722, 278, 556, 722, 611, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 333, 278, 333, 584, 556, 333, 556, 611, 556, 611, 556, 333, 611, 611, 278, 278, 556,
    278, 889, 611, 611, 611, 611, 389, 556, 333, 611, 556, 778, 556, 556, 500, 389, 280, 389, 584};

/// Letters of the upper half without their accents, from U+00C0, by whose widths they are measured.
constexpr std::string_view kLetters = "AAAAAAWCEEEEIIIIDNOOOOO=OUUUUYPsaaaaaamceeeeiiiidnooooo=ouuuuyby";

/// Code points beyond Latin-1 that the encoding has, with their bytes and widths.
struct Special {
  std::uint32_t code_point = 0;
  unsigned char byte = 0;
  std::uint16_t width = 0;
};
constexpr Special kSpecials[] = {{0x20AC, 0x80, 556},  {0x2026, 0x85, 1000}, {0x2018, 0x91, 222},  {0x2019, 0x92, 222},
                                 {0x201C, 0x93, 333},  {0x201D, 0x94, 333},  {0x2022, 0x95, 350},  {0x2013, 0x96, 556},
                                 {0x2014, 0x97, 1000}, {0x2122, 0x99, 1000}, {0x0160, 0x8A, 667},  {0x0161, 0x9A, 500},
                                 {0x017D, 0x8E, 611},  {0x017E, 0x9E, 500},  {0x0152, 0x8C, 1000}, {0x0153, 0x9C, 944}};

constexpr std::uint32_t kLetterStart = 0xC0;

std::uint16_t width_of(unsigned char byte, PdfFont font) {
  const std::array<std::uint16_t, 95>& widths = font == PdfFont::Bold ? kBold : kRegular;
  if (byte >= 0x20 && byte <= 0x7E) return widths[byte - 0x20U];
  if (byte >= kLetterStart) return widths[static_cast<unsigned char>(kLetters[byte - kLetterStart]) - 0x20U];
  for (const Special& each : kSpecials)
    if (each.byte == byte) return each.width;
  if (byte == 0xB0) return 400;  // The sign of degrees.
  return byte == 0xB7 || byte == 0xA0 ? 278 : 556;
}

}  // namespace

std::string encoded(std::string_view utf8) {
  std::string bytes;
  while (!utf8.empty()) {
    const std::size_t length = text::sequence_length(utf8);
    const auto first = static_cast<unsigned char>(utf8[0]);
    if (length <= 1) {
      bytes += length == 1 && first >= 0x20 && first <= 0x7E ? utf8[0] : first == '\t' ? ' ' : '?';
      utf8.remove_prefix(1);
      continue;
    }
    std::uint32_t point = first & (0xFFU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) point = point << 6U | (static_cast<unsigned char>(utf8[i]) & 0x3FU);
    char byte = point >= 0xA0 && point <= 0xFF ? static_cast<char>(point) : '?';
    for (const Special& each : kSpecials)
      if (each.code_point == point) byte = static_cast<char>(each.byte);
    bytes += byte;
    utf8.remove_prefix(length);
  }
  return bytes;
}

double width_of(std::string_view encoded, PdfFont font, double size) {
  std::uint32_t width = 0;
  for (const char c : encoded) width += width_of(static_cast<unsigned char>(c), font);
  return width * size / 1000;
}

}  // namespace isocnc::sheet
