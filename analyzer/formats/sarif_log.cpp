#include "analyzer/formats/sarif_log.h"

#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace isocnc::formats {

std::string dumped(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Appends the objects of an array, after its opening bracket.
static void append_lines(const std::vector<std::string>& objects, std::string& output) {
  std::string_view separator = "\n";
  for (const std::string& object : objects) {
    output.append(separator).append(object);
    separator = ",\n";
  }
}

void SarifLog::begin(const Header& header, std::string& output) {
  fmt::format_to(std::back_inserter(output),
                 "{{\n"
                 "\"$schema\":\"https://json.schemastore.org/sarif-2.1.0.json\",\n"
                 "\"version\":\"2.1.0\",\n"
                 "\"runs\":[{{\n"
                 "\"tool\":{{\"driver\":{{\"name\":\"isolint\",\"version\":\"{}\",\"rules\":[",
                 header.version);
  append_lines(header.rules, output);
  fmt::format_to(std::back_inserter(output), "\n]}}}},\n\"language\":\"{}\",\n", header.language);
  if (!header.shard.empty())
    fmt::format_to(std::back_inserter(output), "\"properties\":{{\"shard\":\"{}\"}},\n", header.shard);
  output += "\"columnKind\":\"unicodeCodePoints\",\n\"results\":[";
}

void SarifLog::add_result(std::string_view result, std::string& output) {
  output.append(has_results_ ? ",\n" : "\n").append(result);
  has_results_ = true;
}

void SarifLog::end(const std::vector<std::string>& artifacts, std::string& output) {
  output += has_results_ ? "\n],\n\"artifacts\":[" : "],\n\"artifacts\":[";
  append_lines(artifacts, output);
  output += artifacts.empty() ? "]\n}]\n}\n" : "\n]\n}]\n}\n";
}

}  // namespace isocnc::formats
