#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "correct_programs.h"
#include "slip.h"

namespace isocnc::slips {

/// The maximum share of slips with more than one finding.
inline constexpr double kMaxShare = 0.02;

/// The codes of what isolint reports in a text by default, in the order of the lines. Where the same mistake is
/// reported line after line (D66), it counts once.
std::vector<std::string> codes_in(const std::string& text);

/// A slip in a program, and what is reported.
struct Catch {
  std::uint64_t seed = 0;
  std::string source;
  std::string program;
  std::string_view kind;
  Lines correct;
  Slip slip;
  std::vector<std::string> codes;

  bool has_several() const { return codes.size() > 1; }
  /// The codes without repetitions, such as `ISO011 ISO026`.
  std::string code_set() const;
};

/// Slips with several findings that have the kind and the codes in common.
struct Shape {
  std::size_t count = 0;
  Catch smallest;  ///< The slip in the shortest program.
};

/// The shapes by kind and codes.
using Shapes = std::map<std::pair<std::string, std::string>, Shape>;

/// Makes slips in correct programs and counts what gives more than one finding.
class Hunt {
 public:
  Hunt();

  /// Makes the slip of a seed, which is the same each time, and counts it.
  const Catch& make(std::uint64_t seed);

  std::size_t made() const { return made_; }
  std::size_t with_several() const { return with_several_; }
  double share() const { return static_cast<double>(with_several_) / static_cast<double>(made_); }
  const Shapes& shapes() const { return shapes_; }
  /// The slips made of each kind, and those with several findings.
  const std::map<std::string, std::pair<std::size_t, std::size_t>>& kinds() const { return kinds_; }

 private:
  void count(const Catch& caught);

  std::vector<ProgramSource> sources_;
  Catch last_;
  std::size_t made_ = 0;
  std::size_t with_several_ = 0;
  Shapes shapes_;
  std::map<std::string, std::pair<std::size_t, std::size_t>> kinds_;
};

/// The slip in as few lines as show the same codes.
Catch reduced(Catch caught);

/// The slip as a difference of lines, with its findings.
std::string shown(const Catch& caught);

}  // namespace isocnc::slips
