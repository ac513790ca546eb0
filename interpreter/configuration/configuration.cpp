#include "interpreter/configuration/configuration.h"

#include <algorithm>

#include "interpreter/dialect/any_case.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::configuration {

bool is_program_name(std::string_view name, std::span<const std::string> extensions) {
  return std::any_of(extensions.begin(), extensions.end(), [&](const std::string& extension) {
    return name.size() > extension.size() && dialect::ends_with(name, extension);
  });
}

std::array<double, execution::kAxisCount> default_rapids() {
  const kinematics::Machine machine = kinematics::default_machine();
  std::array<double, execution::kAxisCount> rapids{};
  for (std::size_t i = 0; i < rapids.size(); ++i) rapids[i] = machine.axes[i].speed * kinematics::kSecondsPerMinute;
  return rapids;
}

const Tool* MachineConfiguration::find_tool(const execution::ToolCode& code) const {
  if (!tools) return nullptr;
  const auto found = std::find_if(tools->begin(), tools->end(), [&](const Tool& tool) { return tool.code == code; });
  return found == tools->end() ? nullptr : &*found;
}

const NamedFunction* MachineConfiguration::find_function(double number) const {
  if (!functions) return nullptr;
  const auto found = std::find_if(functions->begin(), functions->end(),
                                  [&](const NamedFunction& function) { return function.number == number; });
  return found == functions->end() ? nullptr : &*found;
}

}  // namespace isocnc::configuration
