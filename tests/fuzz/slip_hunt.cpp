#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "tests/slips/hunt.h"

/// Makes slips in correct programs and lists what gives more than one finding, by shape: the kind of the slip and the
/// codes of its findings.
///
///   slip_hunt [--slips N | --seconds N] [--seed FIRST] [--show SEED]
///
/// Each slip is made from a number of its own, FIRST and up, so that `--show` shows it again. Fails where the share of
/// slips with several findings is above kMaxShare.
namespace isocnc::slips {
namespace {

struct Options {
  std::uint64_t slips = 20'000;
  std::uint64_t seconds = 0;
  std::uint64_t first = 1;
  std::uint64_t show = 0;
};

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view name = argv[i];
    std::uint64_t* const value = name == "--slips"     ? &options.slips
                                 : name == "--seconds" ? &options.seconds
                                 : name == "--seed"    ? &options.first
                                 : name == "--show"    ? &options.show
                                                       : nullptr;
    if (!value || ++i == argc) {
      fmt::print(stderr, "usage: slip_hunt [--slips N | --seconds N] [--seed FIRST] [--show SEED]\n");
      std::exit(2);
    }
    *value = std::strtoull(argv[i], nullptr, 10);
  }
  return options;
}

void print_kinds(const Hunt& hunt) {
  fmt::print("{:<22} {:>8} {:>8}\n", "slip", "made", "several");
  for (const auto& [kind, counts] : hunt.kinds())
    fmt::print("{:<22} {:>8} {:>8}  {:.2f} %\n", kind, counts.first, counts.second,
               100.0 * static_cast<double>(counts.second) / static_cast<double>(counts.first));
}

/// Prints the shapes, the most frequent first.
void print_shapes(const Hunt& hunt) {
  std::vector<const Shapes::value_type*> shapes;
  for (const auto& entry : hunt.shapes()) shapes.push_back(&entry);
  std::stable_sort(shapes.begin(), shapes.end(),
                   [](const auto* a, const auto* b) { return a->second.count > b->second.count; });
  for (const auto* entry : shapes) {
    const auto& [kind, codes] = entry->first;
    fmt::print("\n{} x {}: {}\n{}", entry->second.count, kind, codes, shown(reduced(entry->second.smallest)));
  }
}

int run(const Options& options) {
  using std::chrono::steady_clock;
  Hunt hunt;
  if (options.show != 0) {
    const Catch caught = hunt.make(options.show);
    fmt::print("{}\n{}", shown(caught), shown(reduced(caught)));
    return EXIT_SUCCESS;
  }
  const auto end = steady_clock::now() + std::chrono::seconds(options.seconds);
  for (std::uint64_t i = 0; options.seconds > 0 ? steady_clock::now() < end : i < options.slips; ++i)
    hunt.make(options.first + i);
  print_shapes(hunt);
  fmt::print("\n");
  print_kinds(hunt);
  fmt::print("Done {} slips from {}: {} with several findings, {:.2f} %; {} shapes\n", hunt.made(), options.first,
             hunt.with_several(), 100 * hunt.share(), hunt.shapes().size());
  return hunt.share() <= kMaxShare ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace isocnc::slips

int main(int argc, char** argv) { return isocnc::slips::run(isocnc::slips::read_options(argc, argv)); }
