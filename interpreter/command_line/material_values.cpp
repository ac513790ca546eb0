#include "interpreter/command_line/material_values.h"

#include <string_view>
#include <vector>

#include "interpreter/command_line/run_values.h"
#include "interpreter/dialect/format.h"
#include "interpreter/text/lists.h"

namespace isocnc::command_line {

using dialect::Text;

static constexpr Text kWrongResolution{"--resolution takes a plain number of mm from {1} to {2}, such as 0.5, not {0}",
                                       "--resolution vuole un numero semplice in mm, da {1} a {2}, come 0.5, non {0}"};
static constexpr Text kWrongWindow{
    "--window takes two corners in mm, the lower one first, such as 0,0,250,250, not {}",
    "--window vuole due spigoli in mm, prima quello inferiore, come 0,0,250,250, non {}"};

static std::optional<stock::Window> read_window(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view side : text::split_at_commas(text)) {
    const std::optional<double> number = read_decimal(side);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() != 4 || !(numbers[0] < numbers[2]) || !(numbers[1] < numbers[3])) return std::nullopt;
  return stock::Window(geometry::Vec2(numbers[0], numbers[1]), geometry::Vec2(numbers[2], numbers[3]));
}

MaterialProgramOptions add_material_values(ProgramApp& program, MaterialValues& values) {
  return {.resolution = program.add_option("--resolution", values.resolution, {"MM", "MM"},
                                           {"How fine the blank is cut; else as the setup says",
                                            "Quanto è fine il taglio del grezzo; altrimenti\ncome dice "
                                            "l'attrezzaggio"}),
          .window = program.add_option("--window", values.window, {"X0,Y0,X1,Y1", "X0,Y0,X1,Y1"},
                                       {"Cut this part of the blank alone (setup's frame)",
                                        "Taglia solo questa parte del grezzo, nel\nriferimento dell'attrezzaggio"})};
}

std::optional<std::string> set_material_values(const MaterialValues& values, dialect::Language language,
                                               verification::MaterialOptions& material) {
  using verification::kCoarsestResolution;
  using verification::kFinestResolution;
  if (values.resolution) {
    material.resolution = read_decimal(*values.resolution);
    if (!(material.resolution >= kFinestResolution && material.resolution <= kCoarsestResolution))
      return dialect::format(kWrongResolution, language, *values.resolution, kFinestResolution, kCoarsestResolution);
  }
  if (values.window) {
    material.window = read_window(*values.window);
    if (!material.window) return dialect::format(kWrongWindow, language, *values.window);
  }
  return std::nullopt;
}

}  // namespace isocnc::command_line
