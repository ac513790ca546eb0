#include "bench/corpora/registers.h"

#include <algorithm>

namespace isocnc::bench {

int Registers::write_assignment(int number) {
  const int value = random_.between(-20'000, 20'000);
  out_.word_of('V', number).text("=").number(value).end_line();
  return value;
}

void Registers::assign(int number) { registers_[number] = {.values = 1, .first = write_assignment(number)}; }

void Registers::assign_in_option(int number) {
  const int value = write_assignment(number);
  Register& assigned = registers_[number];
  if (assigned.values == 1 && assigned.first != value) {
    assigned.values = 2;
    assigned.second = value;
  } else {
    assigned.values = kUnknown;
  }
}

void Registers::assign_in_dependent_option(int number) {
  write_assignment(number);
  registers_[number].values = kUnknown;
}

void Registers::write_machine_condition() {
  static constexpr std::string_view kOperators[] = {"=", "<", ">", "<=", ">=", "<>"};
  out_.text("VGPL").text(kOperators[random_.between(0, 5)]).number(random_.between(0, 20'000));
}

int Registers::pick_with_two_values() {
  const int offset = any();
  for (int i = 0; i < kCount; ++i) {
    const int number = (offset + i) % kCount + 1;
    if (registers_[number].values == 2) return number;
  }
  return 0;
}

void Registers::write_condition() {
  const int number = pick_with_two_values();
  if (number == 0) return write_machine_condition();
  const auto [low, high] = std::minmax(registers_[number].first, registers_[number].second);
  const struct {
    std::string_view text;
    int value;
  } kConditions[] = {{"=", low},  {"=", high}, {"<>", low}, {"<>", high},
                     {"<", high}, {">", low},  {"<=", low}, {">=", high}};
  const auto& condition = kConditions[random_.between(0, 7)];
  out_.word_of('V', number).text(condition.text).number(condition.value);
}

}  // namespace isocnc::bench
