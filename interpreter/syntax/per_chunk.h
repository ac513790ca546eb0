#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "interpreter/syntax/document.h"

namespace isocnc::syntax {

/// Replacement of the chunks [first, first + removed) of a document by `inserted` new ones.
struct ChunkChange {
  std::size_t first = 0;
  std::size_t removed = 0;
  std::size_t inserted = 0;
};

/// A value for each chunk of a document. After edits, only the values of changed chunks are computed again.
template <class T>
class PerChunk {
 public:
  std::size_t size() const { return rows_.size(); }
  T& operator[](std::size_t chunk) { return rows_[chunk].value; }
  const T& operator[](std::size_t chunk) const { return rows_[chunk].value; }

  /// The change of the document since the last follow().
  ChunkChange change_to(const Document& document) const {
    const std::size_t count = document.chunk_count();
    const std::size_t common = std::min(count, rows_.size());
    std::size_t head = 0;
    while (head < common && rows_[head].version == document.chunk_version(head)) ++head;
    std::size_t tail = 0;
    while (tail < common - head && rows_[rows_.size() - 1 - tail].version == document.chunk_version(count - 1 - tail))
      ++tail;
    return {head, rows_.size() - tail - head, count - tail - head};
  }

  /// Applies the change: `make(chunk)` computes the value of each new chunk.
  template <class Make>
  void follow(const Document& document, const ChunkChange& change, Make make) {
    std::vector<Versioned> fresh;
    fresh.reserve(change.inserted);
    for (std::size_t i = change.first; i < change.first + change.inserted; ++i)
      fresh.push_back({document.chunk_version(i), make(i)});
    const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(change.first);
    const auto replaced = static_cast<std::ptrdiff_t>(std::min(change.removed, change.inserted));
    std::move(fresh.begin(), fresh.begin() + replaced, begin);
    rows_.erase(begin + replaced, begin + static_cast<std::ptrdiff_t>(change.removed));
    rows_.insert(rows_.begin() + static_cast<std::ptrdiff_t>(change.first) + replaced,
                 std::make_move_iterator(fresh.begin() + replaced), std::make_move_iterator(fresh.end()));
  }

  /// Calls change_to() and follow().
  template <class Make>
  ChunkChange update(const Document& document, Make make) {
    const ChunkChange change = change_to(document);
    follow(document, change, make);
    return change;
  }

 private:
  struct Versioned {
    std::uint64_t version = 0;
    T value;
  };

  std::vector<Versioned> rows_;
};

}  // namespace isocnc::syntax
