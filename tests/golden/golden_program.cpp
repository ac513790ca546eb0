#include "golden_program.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "interpreter/kinematics/numbers.h"
#include "interpreter/solids/tool_shapes.h"

namespace isocnc::golden {

static std::size_t code_points(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

static std::map<char, double> read_axes(std::istringstream& words) {
  std::map<char, double> axes;
  for (;;) {
    const std::streampos before = words.tellg();
    std::string word;
    if (!(words >> word)) break;
    if (word.size() < 2 || std::string("XYZBC").find(word[0]) == std::string::npos) {
      words.clear();
      words.seekg(before);
      break;
    }
    axes[word[0]] = std::stod(word.substr(1));
  }
  return axes;
}

static ExpectedEffect read_effect(const std::string& text, std::size_t line) {
  ExpectedEffect effect{.line = line, .text = text};
  std::istringstream words(text);
  words >> effect.kind;
  for (std::string word; words >> word;) {
    double value = 0;
    if (word == "to") {
      effect.to = read_axes(words);
    } else if (word == "center") {
      effect.center = read_axes(words);
    } else if (words >> value; word == "length") {
      effect.length = value;
    } else if (word == "radius") {
      effect.radius = value;
    } else if (word == "sweep") {
      effect.sweep = value;
    } else {
      throw std::runtime_error("unknown effect: " + text);
    }
  }
  return effect;
}

static solids::RevolvedBody body_of(solids::BodyOrProblem made) {
  return std::get<solids::RevolvedBody>(std::move(made));
}

/// `fixture clamp-1 100 0 0 140 40 30` (two corners), `cutter T101001 radius 10 length 100`, `clearance 2`...
static void read_scene(Part& part, const std::string& key, std::istringstream& words) {
  using verification::BodyRole;
  static const std::map<std::string, BodyRole> kRoles = {{"fixture", BodyRole::Fixture},
                                                         {"spoilboard", BodyRole::Spoilboard},
                                                         {"target", BodyRole::Target},
                                                         {"stock", BodyRole::Stock},
                                                         {"machine", BodyRole::Machine}};
  if (!part.scene) part.scene.emplace();
  std::string name;
  double value = 0;
  if (const auto role = kRoles.find(key); role != kRoles.end()) {
    verification::SceneBody body{.name = {}, .role = role->second, .shape = {}, .described = {}};
    words >> body.name;
    solids::Cuboid box;
    for (geometry::Vec3* corner : {&box.minimum, &box.maximum})
      for (double& coordinate : *corner) words >> coordinate;
    if (!words) throw std::runtime_error("two corners are missing: " + body.name);
    body.shape = box;
    auto& bodies = body.role == BodyRole::Machine ? part.scene->machine : part.scene->setup;
    bodies.push_back(std::move(body));
  } else if (key == "cutter") {
    std::map<std::string, double> sizes;
    words >> name;
    for (std::string size; words >> size >> value;) sizes[size] = value;
    const execution::ToolCode code = execution::tool_code(std::stoi(name.substr(1)));
    part.machine.tool_lengths[code] = sizes["length"];
    verification::ToolBodies& tool = part.scene->tools[code];
    tool.length = sizes["length"];
    // `edge`: where a shank as thick begins; `holder`: where a holder of diameter 50 does.
    const double reach = sizes.contains("holder") ? sizes["holder"] : sizes["length"];
    const double edge = sizes.contains("edge") ? sizes["edge"] : reach;
    tool.cutter = body_of(solids::flat_body(sizes["radius"], edge));
    const solids::FormPoint shank[] = {{edge, sizes["radius"]}, {reach, sizes["radius"]}};
    if (edge < reach) tool.shank = body_of(solids::form_body(shank));
    const solids::StackRow holder{.height = sizes["length"] - reach, .lower_diameter = 50, .upper_diameter = 50};
    if (reach < sizes["length"]) tool.holder = body_of(solids::stacked_body({&holder, 1}, reach));
    if (sizes.contains("max-depth")) tool.max_depth = sizes["max-depth"];
  } else if (key == "nose") {
    words >> value;
    const solids::StackRow row{.height = 100, .lower_diameter = value, .upper_diameter = value};
    part.scene->nose = body_of(solids::stacked_body({&row, 1}, 0));
  } else if (key == "clearance") {
    words >> part.scene->clearance;
  } else if (key == "tolerance") {
    words >> part.scene->target_tolerance;
  } else {
    throw std::runtime_error("unknown directive of the scene: " + key);
  }
}

static void read_directive(Part& part, const std::string& what, const std::string& rest) {
  std::istringstream words(rest);
  std::string key;
  words >> key;
  if (what == "scene") {
    read_scene(part, key, words);
  } else if (what == "run" && key == "vgpl") {
    words >> part.vgpl;
  } else if (what == "rules") {
    for (; !key.empty(); key.clear(), words >> key) part.selected.push_back(key + "=warning");
  } else if (key == "travel") {
    std::string axis;
    execution::Travel travel;
    words >> axis >> travel.minimum >> travel.maximum;
    const std::size_t index = std::string("XYZBC").find(axis);
    part.setup.limits.travel.at(index) = travel;
    part.machine.motion.axes.at(index).minimum = travel.minimum;
    part.machine.motion.axes.at(index).maximum = travel.maximum;
  } else if (key == "max-feed") {
    words >> part.setup.limits.feed;
    part.machine.motion.feed_speed = part.setup.limits.feed / kinematics::kSecondsPerMinute;
  } else if (key == "max-rotary-speed") {
    words >> part.setup.limits.rotary_speed;
    part.machine.motion.feed_turn = part.setup.limits.rotary_speed / kinematics::kSecondsPerMinute;
  } else if (key == "max-spindle-speed") {
    words >> part.setup.limits.spindle_speed;
    part.machine.spindle_speed = part.setup.limits.spindle_speed;
  } else if (key == "clearance") {
    words >> part.setup.clearance.emplace();
  } else if (key == "functions") {
    part.setup.functions.emplace();
    for (std::string function; words >> function;) part.setup.functions->push_back(std::stoi(function.substr(1)));
  } else if (key == "arc-tolerance") {
    words >> part.setup.arc_tolerance;
  } else if (key == "home") {
    for (const auto& [axis, value] : read_axes(words)) {
      if (axis == 'B') part.setup.home.b = value;
      if (axis == 'C') part.setup.home.c = value;
      if (axis >= 'X') part.setup.home.tip[axis - 'X'] = value;
    }
  } else if (key == "tool") {
    std::string tool;
    words >> tool;
    const execution::ToolCode code = execution::tool_code(std::stoi(tool.substr(1)));
    for (std::string what_of_it; words >> what_of_it;)
      words >> (what_of_it == "radius" ? part.machine.tool_radii : part.machine.tool_lengths)[code];
  } else if (key == "head") {
    part.machine.motion.kinematics.kind = kinematics::MachineKind::Head;
    words >> part.machine.motion.kinematics.pivot;
  } else if (key == "tools") {
    part.setup.tools.emplace();
    for (std::string tool; words >> tool;) part.setup.tools->push_back(execution::tool_code(std::stoi(tool.substr(1))));
  } else {
    throw std::runtime_error("unknown directive: " + what + ": " + rest);
  }
}

std::vector<Part> read_golden(const std::filesystem::path& file) {
  static const std::regex kMarker(
      R"(^; *(\^+) +([A-Z]+[0-9]+)(?:/([a-z-]+))?(?: +and +([0-9]+) +more, +to +([0-9]+))?(?: +via +([0-9, ]+))? *$)");
  static const std::regex kEffect(R"(^; *-> +(.*)$)");
  static const std::regex kDirective(R"(^; (machine|run|rules|scene): (.*)$)");
  std::ifstream input(file, std::ios::binary);
  std::vector<Part> parts(1);
  std::size_t lines = 0;
  std::size_t file_line = 0;
  const auto name = [&] { return file.filename().string() + ":" + std::to_string(file_line + 1); };
  parts.back().name = name();
  for (std::string line; std::getline(input, line); ++file_line) {
    std::smatch match;
    if (line.starts_with("; ====")) {
      parts.emplace_back().name = name();
      lines = 0;
    } else if (std::regex_match(line, match, kMarker)) {
      ExpectedFinding finding{.line = lines - 1,
                              .begin = code_points(line.substr(0, static_cast<std::size_t>(match.position(1)))),
                              .end = 0,
                              .code = match[2]};
      finding.end = finding.begin + static_cast<std::size_t>(match.length(1));
      finding.cause = match[3];
      if (match[4].matched) finding.repeats = std::stoul(match[4]);
      if (match[5].matched) finding.last_line = std::stoul(match[5]);
      std::string via = match[6];
      std::replace(via.begin(), via.end(), ',', ' ');
      std::istringstream numbers(via);
      for (std::size_t number; numbers >> number;) finding.via.push_back(number);
      parts.back().findings.push_back(finding);
    } else if (std::regex_match(line, match, kEffect)) {
      parts.back().effects.push_back(read_effect(match[1], lines - 1));
    } else {
      if (std::regex_match(line, match, kDirective)) read_directive(parts.back(), match[1], match[2]);
      parts.back().program += line + '\n';
      ++lines;
    }
  }
  for (Part& part : parts) {
    part.is_run = file.parent_path().filename() == "runs";
    part.is_about_rules = part.is_run || file.parent_path().filename() == "rules";
    part.is_folded = part.is_run || file.stem() == "D66";
    part.machine.home = part.setup.home;
  }
  return parts;
}

std::vector<std::filesystem::path> golden_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ISOCNC_SOURCE_DIR "/tests/programs"))
    if (entry.path().extension() == ".iso") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace isocnc::golden
