// Pieces of work for several threads: design time only, where each piece takes milliseconds.
//
//   Workers workers(Workers::as_many_as_the_machine_has());
//   std::vector<std::future<Code>> codes;
//   for (const Program& program : programs)
//     codes.push_back(workers.add([&program] { return code_of(program); }));
//   workers.help();
//   for (std::future<Code>& code : codes) use(code.get());  // throws what the piece threw
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

// Of the pieces that wait, the largest begins first, of equal ones the one that was added first.
// They may not wait for each other.
class Workers {
 public:
  // At least 1, at most kMost.
  static unsigned as_many_as_the_machine_has();
  static constexpr unsigned kMost = 64;

  // The calling thread counts, so that 1 means: nothing is done but by help(). A thread starts with
  // the piece that would have to wait for those that are there.
  explicit Workers(unsigned threads);
  // Waits for the pieces that have begun; the others are never done, and their futures are broken.
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  // `size` compares pieces: of several, the long ones should not be left to the end.
  template <typename Do>
  std::future<std::invoke_result_t<Do&>> add(Do work, std::size_t size = 0) {
    // std::function has to be copied; what it calls need not be.
    auto task = std::make_shared<std::packaged_task<std::invoke_result_t<Do&>()>>(std::move(work));
    auto result = task->get_future();
    put({[task = std::move(task)] { (*task)(); }, size});
    return result;
  }

  // The calling thread works, too, until no piece is left that has not begun.
  void help();

 private:
  struct Piece {
    std::function<void()> work;
    std::size_t size;
  };

  void put(Piece piece);
  void do_next(std::unique_lock<std::mutex>& lock);
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Piece> waiting_;
  unsigned most_;      // threads beside the calling one
  unsigned idle_ = 0;  // of them
  bool ends_ = false;
  std::vector<std::jthread> threads_;  // the last member: they use the others
};

}  // namespace sinew
