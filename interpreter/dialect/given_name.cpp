#include "interpreter/dialect/given_name.h"

#include <deque>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <utility>

namespace isocnc::dialect {

namespace {

/// All names so far.
class NameTable {
 public:
  std::uint32_t number_of(Text name) {
    const std::unique_lock lock(mutex_);
    std::pair<std::string, std::string> key(name.en, name.it);
    const auto known = numbers_.find(key);
    if (known != numbers_.end()) return known->second;
    names_.push_back(key);
    const auto number = static_cast<std::uint32_t>(names_.size());
    numbers_.emplace(std::move(key), number);
    return number;
  }

  std::string_view text_of(std::uint32_t number, Language language) const {
    const std::shared_lock lock(mutex_);
    if (number == 0 || number > names_.size()) return {};
    const auto& [english, italian] = names_[number - 1];
    return language == Language::Italian ? italian : english;
  }

  static NameTable& instance() {
    static NameTable table;
    return table;
  }

 private:
  mutable std::shared_mutex mutex_;
  std::deque<std::pair<std::string, std::string>> names_;  // Texts stay where they are.
  std::map<std::pair<std::string, std::string>, std::uint32_t> numbers_;
};

}  // namespace

GivenName GivenName::of(Text name) { return {NameTable::instance().number_of(name)}; }

std::string_view GivenName::in(Language language) const { return NameTable::instance().text_of(number, language); }

}  // namespace isocnc::dialect
