#pragma once

#include "bench/corpora/random.h"
#include "bench/corpora/writer.h"

namespace isocnc::bench {

/// Writes assignments and conditions, and keeps what it must know of the registers so that every condition can come out
/// both ways: an operation that no path reaches would be a finding.
class Registers {
 public:
  static constexpr int kCount = 30;

  Registers(Writer& out, Random random) : out_(out), random_(random) {}

  /// `V3 = 12.5` where every path comes by.
  void assign(int number);

  /// The same in a stretch that an IF on VGPL may skip: from then on a register that had one value has two.
  void assign_in_option(int number);

  /// The same in a stretch that an IF on a register may skip: which values can meet is no longer followed.
  void assign_in_dependent_option(int number);

  int any() { return random_.between(1, kCount); }
  bool one_in(int chances) { return random_.one_in(chances); }

  /// `VGPL >= 3`. Nothing is known of VGPL, so both ways are open.
  void write_machine_condition();

  /// `V3 <> 12.5`, on a register that has two values of which one makes it true.
  void write_condition();

 private:
  struct Register {
    int values = 0;  ///< How many it may have; 0 or more than 2: not known.
    int first = 0, second = 0;
  };

  static constexpr int kUnknown = 3;

  int write_assignment(int number);
  int pick_with_two_values();

  Writer& out_;
  Random random_;
  Register registers_[kCount + 1];
};

}  // namespace isocnc::bench
