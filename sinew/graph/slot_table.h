// A hash table of 32-bit numbers that stand for keys which lie elsewhere. A slot is one 64-bit
// word, the key's 32-bit hash and the number, so that it is read and written atomically: one thread
// may insert while others look up. Nothing is ever erased. Tables that were outgrown stay until the
// end, because a reader may still be in one; together they are no larger than the present one.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "sinew/graph/pages.h"

namespace sinew::graph {

class SlotTable {
 public:
  SlotTable() {
    install(kFirstMask);
    publish();
  }

  // The number whose key has this hash and for which `is_key(number)` holds, or 0.
  template <typename IsKey>
  std::uint32_t find(std::uint32_t hash, IsKey&& is_key) const {
    const Table* table = table_.load(std::memory_order_acquire);
    for (std::uint32_t at = hash & table->mask;; at = (at + 1) & table->mask) {
      const std::uint64_t slot = table->slots[at].load(std::memory_order_acquire);
      if (slot == 0) return 0;
      const auto number = static_cast<std::uint32_t>(slot);
      if (static_cast<std::uint32_t>(slot >> 32) == hash && is_key(number)) return number;
    }
  }

  // Precondition: number > 0, and its key is not in the table. Writer only.
  void insert(std::uint32_t hash, std::uint32_t number) {
    if (used_ >= limit_) grow();
    place(*table_.load(std::memory_order_relaxed), std::uint64_t{hash} << 32 | number);
    ++used_;
  }

  // Precondition: this one is new.
  void copy_from(const SlotTable& other) {
    const Table* source = other.table_.load(std::memory_order_acquire);
    install(source->mask);
    std::memcpy(static_cast<void*>(tables_.back()->slots), source->slots, source->bytes());
    publish();
    used_ = other.used_;
  }

 private:
  static constexpr std::uint32_t kFirstMask = 255;
  struct Table {
    explicit Table(std::uint32_t last)
        : mask(last), slots(static_cast<std::atomic<std::uint64_t>*>(allocate_zeroed(bytes()))) {}
    ~Table() { release_zeroed(slots, bytes()); }
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;
    std::size_t bytes() const { return (std::size_t{mask} + 1) * sizeof(std::uint64_t); }

    std::uint32_t mask;
    std::atomic<std::uint64_t>* slots;
  };

  static void place(Table& table, std::uint64_t slot) {
    std::uint32_t at = static_cast<std::uint32_t>(slot >> 32) & table.mask;
    while (table.slots[at].load(std::memory_order_relaxed) != 0) at = (at + 1) & table.mask;
    table.slots[at].store(slot, std::memory_order_release);
  }
  void install(std::uint32_t mask) {
    tables_.push_back(std::make_unique<Table>(mask));
    // Five eighths full at most, and nearly full only when there are no more numbers.
    limit_ = mask == UINT32_MAX ? UINT32_MAX - 1 : mask / 8 * 5;
  }
  void publish() { table_.store(tables_.back().get(), std::memory_order_release); }
  void grow() {
    const Table* old = table_.load(std::memory_order_relaxed);
    install(old->mask * 2 + 1);
    for (std::size_t at = 0; at <= old->mask; ++at) {
      const std::uint64_t slot = old->slots[at].load(std::memory_order_relaxed);
      if (slot != 0) place(*tables_.back(), slot);
    }
    publish();
  }

  std::atomic<Table*> table_ = nullptr;
  std::uint32_t used_ = 0;
  std::uint32_t limit_ = 0;
  std::vector<std::unique_ptr<Table>> tables_;
};

// A 32-bit hash of two ids.
inline std::uint32_t hash_pair(std::uint32_t first, std::uint32_t second) {
  std::uint64_t mixed = (std::uint64_t{first} << 32 | second) * 0x9E3779B97F4A7C15ull;
  mixed ^= mixed >> 32;
  return static_cast<std::uint32_t>(mixed * 0xD6E8FEB86659FD93ull >> 32);
}

}  // namespace sinew::graph
