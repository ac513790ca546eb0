#include "analyzer/check/registers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>

#include <fmt/format.h>

#include "tests/support/random.h"

namespace isocnc::check {
namespace {

using support::Random;
using syntax::Comparison;

bool holds(double value, Comparison comparison, double constant) {
  switch (comparison) {
    case Comparison::Equal:
      return value == constant;
    case Comparison::NotEqual:
      return value != constant;
    case Comparison::Less:
      return value < constant;
    case Comparison::LessEqual:
      return value <= constant;
    case Comparison::Greater:
      return value > constant;
    case Comparison::GreaterEqual:
      return value >= constant;
    case Comparison::Invalid:
      break;
  }
  return true;
}

constexpr Comparison kComparisons[] = {Comparison::Equal,     Comparison::NotEqual, Comparison::Less,
                                       Comparison::LessEqual, Comparison::Greater,  Comparison::GreaterEqual};

/// One value for each cell: the constants, and one below, between and above them.
std::vector<double> samples_of(const std::vector<double>& constants) {
  std::vector<double> samples;
  for (const double constant : constants) {
    samples.push_back(samples.empty() ? constant - 1 : (samples.back() + constant) / 2);
    samples.push_back(constant);
  }
  samples.push_back(constants.empty() ? 0 : constants.back() + 1);
  return samples;
}

TEST(ValueSet, SatisfyingHoldsThoseValuesThatDo) {
  const std::vector<double> constants{-2.5, 0, 3};
  for (const Comparison comparison : kComparisons)
    for (const double constant : constants) {
      const ValueSet set = ValueSet::satisfying(comparison, constant);
      for (const double value : samples_of(constants))
        EXPECT_EQ(!set.intersected(ValueSet::of(value, constants)).empty(), holds(value, comparison, constant))
            << value << " " << static_cast<int>(comparison) << " " << constant;
    }
}

TEST(ValueSet, OppositesShareNothingAndMakeEverything) {
  const auto set = [](Comparison comparison) { return ValueSet::satisfying(comparison, 2); };
  const std::pair<Comparison, Comparison> opposites[] = {{Comparison::Equal, Comparison::NotEqual},
                                                         {Comparison::Less, Comparison::GreaterEqual},
                                                         {Comparison::Greater, Comparison::LessEqual}};
  for (const auto& [a, b] : opposites) {
    EXPECT_TRUE(set(a).intersected(set(b)).empty());
    EXPECT_EQ(set(a).united(set(b)), ValueSet::everything());
  }
}

TEST(ValueSet, AnUnknownValueIsAnything) { EXPECT_EQ(ValueSet::of(std::nan(""), {1, 2}), ValueSet::everything()); }

constexpr std::array<int, 3> kRegisters{1, 4, 30};

syntax::Jump jump_on(int reg, Comparison comparison, double value) {
  syntax::Jump jump;
  jump.variable = static_cast<std::int8_t>(reg);
  jump.comparison = comparison;
  jump.value = value;
  jump.has_target = true;
  jump.target = 1;
  return jump;
}

/// All values that are possible together, as a plain list of samples.
using Sample = std::array<double, kRegisters.size()>;
using Model = std::set<Sample>;

Model everything(const JumpMap& jumps) {
  Model model;
  for (const double a : samples_of(jumps.constants(kRegisters[0])))
    for (const double b : samples_of(jumps.constants(kRegisters[1])))
      for (const double c : samples_of(jumps.constants(kRegisters[2]))) model.insert({a, b, c});
  return model;
}

/// Whether the valuations hold the sample: found out by conditions alone, as a check does.
bool contains(Valuations valuations, const Sample& sample, const JumpMap& jumps) {
  for (std::size_t i = 0; i < kRegisters.size(); ++i)
    for (const double constant : jumps.constants(kRegisters[i]))
      for (const Comparison comparison : {Comparison::Less, Comparison::Equal})
        valuations =
            valuations.where(jump_on(kRegisters[i], comparison, constant), holds(sample[i], comparison, constant));
  return valuations.possible();
}

/// The sample that stands for a value's cell.
double sample_of(double value, const std::vector<double>& constants) {
  for (const double sample : samples_of(constants)) {
    bool same = true;
    for (const double constant : constants)
      same &= (value < constant) == (sample < constant) && (value == constant) == (sample == constant);
    if (same) return sample;
  }
  return std::nan("");
}

Model assigned(const Model& model, std::size_t index, double value, const JumpMap& jumps) {
  Model result;
  for (Sample sample : model) {
    if (!std::isnan(value)) {
      sample[index] = sample_of(value, jumps.constants(kRegisters[index]));
      result.insert(sample);
      continue;
    }
    for (const double any : samples_of(jumps.constants(kRegisters[index]))) {
      sample[index] = any;
      result.insert(sample);
    }
  }
  return result;
}

/// What is known, kept both ways.
struct Both {
  Valuations valuations;
  Model model;
};

class RegisterWalk {
 public:
  explicit RegisterWalk(std::uint64_t seed) : random_(seed) {
    JumpCollector collector;
    for (const int reg : kRegisters)
      for (int i = random_.between(0, 3); i > 0; --i)
        collector.add(0, {.jump = jump_on(reg, Comparison::Equal, random_.between(-2, 2))});
    jumps_ = std::move(collector).finish();
    for (int i = 0; i < 3; ++i) all_.push_back({Valuations::unknown(), everything(jumps_)});
  }

  void step() {
    Both& one = all_[random_.below(all_.size())];
    const std::size_t index = random_.below(kRegisters.size());
    switch (random_.between(0, 3)) {
      case 0:
        assign(one, index);
        break;
      case 1:
      case 2:
        narrow(one, index);
        break;
      default:
        unite(one, all_[random_.below(all_.size())]);
        break;
    }
  }

  void expect_agreement(const std::string& which) const {
    const Model samples = everything(jumps_);
    for (const Both& one : all_) {
      EXPECT_EQ(one.valuations.possible(), !one.model.empty()) << which;
      for (const Sample& sample : samples)
        ASSERT_EQ(contains(one.valuations, sample, jumps_), one.model.contains(sample))
            << which << ": " << fmt::format("{} {} {}", sample[0], sample[1], sample[2]);
    }
  }

 private:
  void assign(Both& one, std::size_t index) {
    const double value = random_.one_in(4) ? std::nan("") : random_.between(-5, 5) / 2.0;
    one.valuations.assign(kRegisters[index], value, jumps_);
    one.model = assigned(one.model, index, value, jumps_);
  }

  void narrow(Both& one, std::size_t index) {
    const std::vector<double>& constants = jumps_.constants(kRegisters[index]);
    if (constants.empty()) return;
    const double constant = constants[random_.below(constants.size())];
    const Comparison comparison = kComparisons[random_.below(std::size(kComparisons))];
    const bool wanted = random_.one_in(2);
    one.valuations = one.valuations.where(jump_on(kRegisters[index], comparison, constant), wanted);
    std::erase_if(one.model,
                  [&](const Sample& sample) { return holds(sample[index], comparison, constant) != wanted; });
  }

  static void unite(Both& one, const Both& other) {
    one.valuations.unite(Valuations(other.valuations));
    one.model.insert(other.model.begin(), other.model.end());
  }

  Random random_;
  JumpMap jumps_;
  std::vector<Both> all_;
};

TEST(ValuationsProperty, LoseNothingAndAddNothing) {
  for (const std::uint64_t seed : support::seeds(150)) {
    RegisterWalk walk(seed);
    for (int i = 0; i < 12; ++i) {
      walk.step();
      walk.expect_agreement(fmt::format("seed {}, step {}", seed, i));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Valuations, KnowWhatRegistersHaveToDoWithEachOther) {
  const JumpMap jumps("IF V1=1 GOTO N9\nIF V2=3 GOTO N9\nN9\n");
  Valuations one = Valuations::unknown();
  one.assign(1, 1, jumps);
  one.assign(2, 3, jumps);
  Valuations other = Valuations::unknown();
  other.assign(1, 2, jumps);
  other.assign(2, 4, jumps);
  one.unite(other);
  const Valuations first = one.where(jumps.sites()[0].jump, true);
  EXPECT_TRUE(first.where(jumps.sites()[1].jump, true).possible());
  EXPECT_FALSE(first.where(jumps.sites()[1].jump, false).possible());
}

TEST(Valuations, ReducingAddsNothing) {
  const JumpMap jumps("IF V1=1 GOTO N9\nIF V2=3 GOTO N9\nN9\n");
  Valuations one = Valuations::unknown();
  one.assign(1, 1, jumps);
  one.assign(2, 3, jumps);
  Valuations other = Valuations::unknown();
  other.assign(1, 2, jumps);
  other.assign(2, 4, jumps);
  one.unite(other);
  one.reduce_to(1);
  EXPECT_EQ(one.size(), 1u);
  for (const bool holds : {false, true})
    EXPECT_FALSE(one.where(jumps.sites()[0].jump, holds).where(jumps.sites()[1].jump, !holds).possible());
}

TEST(Valuations, ForgetRegistersThatNoJumpWillRead) {
  const JumpMap jumps("IF V1=1 GOTO N9\nIF V2=3 GOTO N9\nN9\n");
  Valuations known = Valuations::unknown();
  known.assign(1, 1, jumps);
  known.assign(2, 3, jumps);
  known.keep_only(RegisterSet{1} << 2);
  EXPECT_TRUE(known.where(jumps.sites()[0].jump, false).possible());
  EXPECT_FALSE(known.where(jumps.sites()[1].jump, false).possible());
}

TEST(Valuations, JumpsOnTheGplVariableLimitNoRegister) {
  const JumpMap jumps("IF VGPL=1 GOTO N9\nIF V2=3 GOTO N9\nN9\n");
  const Valuations unknown = Valuations::unknown();
  EXPECT_EQ(unknown.where(jumps.sites()[0].jump, true), unknown);
  EXPECT_EQ(unknown.where(jumps.sites()[0].jump, false), unknown);
}

}  // namespace
}  // namespace isocnc::check
