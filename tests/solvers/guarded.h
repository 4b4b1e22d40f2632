// Memory that ends where a page begins that nobody may touch, and what a call leaves behind in the
// processor's floating-point flags.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cfenv>
#include <cstddef>
#include <stdexcept>

namespace sinew::test {

// `n` numbers at the end, or at the start, of pages of their own; the pages on both sides fault.
template <typename Number>
class Guarded {
 public:
  enum class At { kEnd, kStart };

  Guarded(std::size_t n, At at) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t inside = (n * sizeof(Number) + page - 1) / page * page;
    bytes_ = inside + 2 * page;
    memory_ =
        static_cast<char*>(mmap(nullptr, bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    if (memory_ == MAP_FAILED || mprotect(memory_ + page, inside, PROT_READ | PROT_WRITE) != 0) {
      throw std::runtime_error("no memory to guard");
    }
    numbers_ = reinterpret_cast<Number*>(memory_ + page +
                                         (at == At::kEnd ? inside - n * sizeof(Number) : 0));
  }
  ~Guarded() { munmap(memory_, bytes_); }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;

  Number* data() { return numbers_; }
  Number& operator[](std::size_t i) { return numbers_[i]; }

 private:
  char* memory_ = nullptr;
  std::size_t bytes_ = 0;
  Number* numbers_ = nullptr;
};

// The flags that a call raises, of those that no state of a robot should: something infinite, not a
// number, or too small for all its digits.
template <typename Call>
int flags_of(Call call) {
  std::feclearexcept(FE_ALL_EXCEPT);
  call();
  return std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW);
}

}  // namespace sinew::test
