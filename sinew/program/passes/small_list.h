// A list that needs no memory of its own as long as it is short. The passes keep hundreds of
// thousands of lists of two or three numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <type_traits>

#include "sinew/program/passes/pooled.h"

namespace sinew::program {

// `T` is a plain value; up to N of them lie in the list itself.
template <typename T, std::size_t N>
class SmallList {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  SmallList() {}
  SmallList(std::initializer_list<T> values) { append(values.begin(), values.end()); }
  SmallList(const SmallList& other) { append(other.begin(), other.end()); }
  SmallList(SmallList&& other) noexcept { take(other); }
  SmallList& operator=(const SmallList& other) {
    if (this == &other) return *this;
    size_ = 0;
    append(other.begin(), other.end());
    return *this;
  }
  SmallList& operator=(SmallList&& other) noexcept {
    if (this == &other) return *this;
    release();
    take(other);
    return *this;
  }
  ~SmallList() { release(); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* begin() { return room_ > N ? long_ : short_; }
  T* end() { return begin() + size_; }
  const T* begin() const { return room_ > N ? long_ : short_; }
  const T* end() const { return begin() + size_; }
  T& operator[](std::size_t i) { return begin()[i]; }
  const T& operator[](std::size_t i) const { return begin()[i]; }
  const T& front() const { return *begin(); }
  const T& back() const { return begin()[size_ - 1]; }

  void push_back(T value) {
    if (size_ == room_) grow();
    std::construct_at(begin() + size_++, value);
  }
  void pop_back() { --size_; }
  void clear() { size_ = 0; }
  void append(const T* first, const T* last) {
    for (; first != last; ++first) push_back(*first);
  }
  void erase(T* at) {
    std::copy(at + 1, end(), at);
    --size_;
  }

  friend bool operator==(const SmallList& a, const SmallList& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }
  friend bool operator<(const SmallList& a, const SmallList& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  void grow() {
    const std::uint32_t room = room_ * 2;
    T* const values = Pooled<T>().allocate(room);
    std::uninitialized_copy(begin(), end(), values);
    release();
    long_ = values;
    room_ = room;
  }
  // Gives its memory back; the size stays.
  void release() {
    if (room_ > N) Pooled<T>().deallocate(long_, room_);
    room_ = N;
  }
  // What the other one holds, which is empty afterwards. Precondition: no memory of its own.
  void take(SmallList& other) {
    size_ = other.size_;
    room_ = other.room_;
    if (room_ > N) {
      long_ = other.long_;
    } else {
      std::uninitialized_copy(other.begin(), other.end(), short_);
    }
    other.size_ = 0;
    other.room_ = N;
  }

  std::uint32_t size_ = 0;
  std::uint32_t room_ = N;
  union {
    T short_[N];
    T* long_;  // where there is room for more than N
  };
};

}  // namespace sinew::program
