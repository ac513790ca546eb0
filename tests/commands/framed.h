#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace isocnc::commands {

/// A message as both protocols send it.
inline std::string frame(const std::string& body) {
  return "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

/// The messages that a program has written.
inline std::vector<nlohmann::json> messages_of(const std::string& out) {
  std::vector<nlohmann::json> messages;
  for (std::size_t at = 0; at < out.size();) {
    const std::size_t begin = out.find("\r\n\r\n", at) + 4;
    const std::size_t length = std::stoul(out.substr(at + std::string("Content-Length: ").size()));
    messages.push_back(nlohmann::json::parse(out.substr(begin, length)));
    at = begin + length;
  }
  return messages;
}

}  // namespace isocnc::commands
