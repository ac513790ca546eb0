#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace isocnc::syntax {

/// A growing array of plain values that can be written in place. Unlike a vector it does not initialize new elements,
/// and allows writing beyond its size, as a parser of millions of words needs.
template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  Buffer() = default;
  Buffer(const Buffer& other) { append(other.data(), other.size()); }
  Buffer(Buffer&& other) noexcept = default;
  Buffer& operator=(Buffer other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }
  ~Buffer() = default;

  std::size_t size() const { return size_; }
  const T* data() const { return data_.get(); }
  T* data() { return data_.get(); }
  T& operator[](std::size_t index) { return data_[index]; }
  const T& operator[](std::size_t index) const { return data_[index]; }
  T& back() { return data_[size_ - 1]; }

  /// Returns the place for `count` more elements; add() makes them part of the array.
  [[gnu::always_inline]] T* reserve_for(std::size_t count) {
    if (size_ + count > capacity_) [[unlikely]]
      grow(count);
    return data_.get() + size_;
  }
  void add(std::size_t count) { size_ += count; }
  [[gnu::always_inline]] T& push_back(const T& value) {
    T* const place = reserve_for(1);
    *place = value;
    ++size_;
    return *place;
  }
  void append(const T* values, std::size_t count) {
    std::copy_n(values, count, reserve_for(count));
    size_ += count;
  }
  void pop_back() { --size_; }
  void clear() { size_ = 0; }

 private:
  [[gnu::noinline]] void grow(std::size_t count) {
    const std::size_t capacity = std::max(2 * capacity_, size_ + count);
    auto larger = std::make_unique_for_overwrite<T[]>(capacity);
    std::copy_n(data_.get(), size_, larger.get());
    data_ = std::move(larger);
    capacity_ = capacity;
  }

  std::unique_ptr<T[]> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace isocnc::syntax
