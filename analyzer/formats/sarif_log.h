#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace isocnc::formats {

/// The JSON on one line. What is no UTF-8 becomes U+FFFD.
std::string dumped(const nlohmann::ordered_json& json);

/// Writes the frame of a SARIF log around its results. Rules, results and artifacts are objects of JSON, each on a line
/// of its own.
class SarifLog {
 public:
  struct Header {
    std::string version;   ///< Of the program that has checked.
    std::string language;  ///< Of the messages: `en`, `it`.
    std::string shard;     ///< `2/8` if the log is of one part of the files (--shard), else empty.
    std::vector<std::string> rules;

    friend bool operator==(const Header&, const Header&) = default;
  };

  void begin(const Header& header, std::string& output);
  void add_result(std::string_view result, std::string& output);
  void end(const std::vector<std::string>& artifacts, std::string& output);

 private:
  bool has_results_ = false;
};

}  // namespace isocnc::formats
