#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <type_traits>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

/// What scripts/mutate puts into copies of the sources: which mutant of all is the program's own code, and which places
/// were reached.
namespace isocnc_mutation {

/// The mutant of ISOCNC_MUTANT; without it none.
inline int selected_mutant() {
  const char* const number = std::getenv("ISOCNC_MUTANT");
  return number ? std::atoi(number) : -1;
}

/// A byte for each mutant, in the file ISOCNC_REACHED, which exists and is long enough: all processes share it, also
/// those that crash. Without it null.
inline std::atomic<unsigned char>* reached_mutants() {
  const char* const path = std::getenv("ISOCNC_REACHED");
  const int file = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
  if (file < 0) return nullptr;
  const off_t size = lseek(file, 0, SEEK_END);
  void* const bytes = mmap(nullptr, static_cast<std::size_t>(size), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  return bytes == MAP_FAILED ? nullptr : static_cast<std::atomic<unsigned char>*>(bytes);
}

inline bool is_selected(int mutant) {
  static const int selected = selected_mutant();
  static std::atomic<unsigned char>* const reached = reached_mutants();
  if (reached) reached[mutant].store(1, std::memory_order_relaxed);
  return mutant == selected;
}

/// Never in an expression that the compiler evaluates.
constexpr bool is_on(int mutant) { return !std::is_constant_evaluated() && is_selected(mutant); }

}  // namespace isocnc_mutation
