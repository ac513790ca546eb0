#include "interpreter/dialect/given_name.h"

#include <deque>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <utility>

namespace isocnc::dialect {

namespace {

/// Values that are kept until the process ends, each once, and known by numbers from 1. All functions may be called by
/// any thread.
template <class Value>
class KeptValues {
 public:
  std::uint32_t number_of(const Value& value) {
    const std::unique_lock lock(mutex_);
    const auto [known, is_new] = numbers_.try_emplace(value, static_cast<std::uint32_t>(values_.size() + 1));
    if (is_new) values_.push_back(value);
    return known->second;
  }

  /// The value with this number, or an empty one.
  const Value& at(std::uint32_t number) const {
    static const Value kNone{};
    const std::shared_lock lock(mutex_);
    return number == 0 || number > values_.size() ? kNone : values_[number - 1];
  }

 private:
  mutable std::shared_mutex mutex_;
  std::deque<Value> values_;  // They stay where they are.
  std::map<Value, std::uint32_t> numbers_;
};

}  // namespace

/// In English and in Italian.
static KeptValues<std::pair<std::string, std::string>>& names() {
  static KeptValues<std::pair<std::string, std::string>> names;
  return names;
}

static KeptValues<FilePlace>& places() {
  static KeptValues<FilePlace> places;
  return places;
}

GivenName GivenName::of(Text name) { return {names().number_of({std::string(name.en), std::string(name.it)})}; }

std::string_view GivenName::in(Language language) const {
  const auto& [english, italian] = names().at(number);
  return language == Language::Italian ? italian : english;
}

GivenPlace GivenPlace::of(const FilePlace& place) { return {places().number_of(place)}; }

const FilePlace& GivenPlace::place() const { return places().at(number); }

}  // namespace isocnc::dialect
