// Writes a program of one kind for the benchmarks: the same bytes from the same arguments on every machine.

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "bench/corpora/corpora.h"

namespace isocnc::bench {

struct Kind {
  std::string_view name;
  void (*write)(Writer& out, Random& random, int lines);
};

static constexpr Kind kKinds[] = {
    {"short", write_short_moves},
    {"arcs", write_arcs},
    {"fiveaxis", write_five_axis},
    {"incremental", write_incremental},
    {"production", write_production},
    {"production-if", write_production_if},
    {"hostile-if", write_hostile_if},
    {"errors", write_errors},
    {"walk", write_walk},
    {"walk-narrow", write_narrow_walk},
    {"walk-five-axes", write_five_axis_walk},
    {"table", write_table},
};

static const Kind* find_kind(std::string_view name) {
  for (const Kind& kind : kKinds)
    if (kind.name == name) return &kind;
  return nullptr;
}

template <typename Number>
static bool parse(std::string_view text, Number& number) {
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && after == end;
}

static int usage() {
  std::fputs("usage: isocnc_corpus KIND LINES SEED > FILE\nKIND is one of:", stderr);
  for (const Kind& kind : kKinds) std::fprintf(stderr, " %.*s", static_cast<int>(kind.name.size()), kind.name.data());
  std::fputs("\nLINES is met within one in a hundred, from some 2000 lines on.\n", stderr);
  return 2;
}

static int run(int argc, char** argv) {
  int lines = 0;
  std::uint64_t seed = 0;
  if (argc != 4 || !parse(argv[2], lines) || lines < 1 || !parse(argv[3], seed)) return usage();
  const Kind* kind = find_kind(argv[1]);
  if (!kind) return usage();
  {
    Writer out;
    Random random(seed);
    kind->write(out, random, lines);
  }
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return 0;
  std::perror("isocnc_corpus");
  return 2;
}

}  // namespace isocnc::bench

int main(int argc, char** argv) { return isocnc::bench::run(argc, argv); }
