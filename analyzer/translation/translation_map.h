#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "interpreter/configuration/mistake.h"
#include "interpreter/geometry/vectors.h"

namespace isocnc::translation {

/// What a program of another control takes from its machine, and this dialect must be told. Lengths in mm.
struct TranslationMap {
  std::map<int, std::string> tools;          ///< Six digits, head, holder and tool, by the number of T.
  std::string start;                         ///< Six digits of the tool that is mounted at the start; empty: none.
  std::map<int, geometry::Vec3> zeros;       ///< Zero points in machine coordinates, by the G in tenths: 540 is G54.
  std::map<int, geometry::Vec3> references;  ///< Reference points likewise: 280 is G28.
  std::map<int, int> functions;              ///< M of the shop by the M of the program; 0: left out.
  std::optional<double> peck_clearance;      ///< How far pecks withdraw (G73) or stop before the last depth (G83).
  bool starts_in_inches = false;             ///< Until a G20 or G21.
  std::optional<bool> counts_thousandths;    ///< Of Fanuc: what a number without a decimal point counts.
  int length_offset = 0;                     ///< What H of a tool is larger than its T.
  int radius_offset = 0;                     ///< What D of a tool is larger than its T.
};

/// The map, or all mistakes of its text in their order.
std::variant<TranslationMap, std::vector<configuration::Mistake>> read_translation_map(std::string_view text);

/// The map in a file, or the messages of what is wrong with it, one a line.
std::variant<TranslationMap, std::string> load_translation_map(const std::filesystem::path& file,
                                                               dialect::Language language);

/// A zero point as an option gives it, `G54=350,220,-185.5`; nothing if it is none.
std::optional<std::pair<int, geometry::Vec3>> read_zero_option(std::string_view text);

}  // namespace isocnc::translation
