// A list that needs no memory of its own as long as it is short. The passes keep hundreds of
// thousands of lists of two or three numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace sinew::program {

// `T` is a plain value; up to N of them lie in the list itself.
template <typename T, std::size_t N>
class SmallList {
 public:
  SmallList() = default;
  SmallList(std::initializer_list<T> values) { append(values.begin(), values.end()); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* begin() { return size_ > N ? long_.data() : short_.data(); }
  T* end() { return begin() + size_; }
  const T* begin() const { return size_ > N ? long_.data() : short_.data(); }
  const T* end() const { return begin() + size_; }
  T& operator[](std::size_t i) { return begin()[i]; }
  const T& operator[](std::size_t i) const { return begin()[i]; }
  const T& front() const { return *begin(); }
  const T& back() const { return begin()[size_ - 1]; }

  void push_back(T value) {
    if (size_ == N) long_.assign(short_.begin(), short_.end());
    if (size_ >= N) {
      long_.push_back(value);
    } else {
      short_[size_] = value;
    }
    ++size_;
  }
  void pop_back() { erase(end() - 1); }
  void append(const T* first, const T* last) {
    for (; first != last; ++first) push_back(*first);
  }
  void erase(T* at) {
    if (size_ > N) {
      long_.erase(long_.begin() + (at - long_.data()));
      if (--size_ == N) std::copy(long_.begin(), long_.end(), short_.begin());
    } else {
      std::copy(at + 1, end(), at);
      --size_;
    }
  }

  friend bool operator==(const SmallList& a, const SmallList& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }
  friend bool operator<(const SmallList& a, const SmallList& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::size_t size_ = 0;
  std::array<T, N> short_{};
  std::vector<T> long_;  // everything, once it is more than N
};

}  // namespace sinew::program
