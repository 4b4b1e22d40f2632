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

namespace sinew::graph {

class SlotTable {
 public:
  SlotTable() { install(kFirstCapacity); }

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
    install(source->mask + 1);
    Table& target = *table_.load(std::memory_order_relaxed);
    for (std::uint32_t at = 0; at <= source->mask; ++at) {
      target.slots[at].store(source->slots[at].load(std::memory_order_relaxed),
                             std::memory_order_relaxed);
    }
    used_ = other.used_;
  }

 private:
  static constexpr std::uint32_t kFirstCapacity = 256;
  struct Table {
    std::uint32_t mask;
    std::unique_ptr<std::atomic<std::uint64_t>[]> slots;
  };

  static void place(Table& table, std::uint64_t slot) {
    std::uint32_t at = static_cast<std::uint32_t>(slot >> 32) & table.mask;
    while (table.slots[at].load(std::memory_order_relaxed) != 0) at = (at + 1) & table.mask;
    table.slots[at].store(slot, std::memory_order_release);
  }
  void install(std::uint32_t capacity) {
    auto table = std::make_unique<Table>();
    table->mask = capacity - 1;
    table->slots = std::make_unique<std::atomic<std::uint64_t>[]>(capacity);
    limit_ = capacity / 2;
    tables_.push_back(std::move(table));
    table_.store(tables_.back().get(), std::memory_order_release);
  }
  void grow() {
    const Table* old = table_.load(std::memory_order_relaxed);
    auto table = std::make_unique<Table>();
    table->mask = old->mask * 2 + 1;
    table->slots = std::make_unique<std::atomic<std::uint64_t>[]>(std::size_t{table->mask} + 1);
    for (std::size_t at = 0; at <= old->mask; ++at) {
      const std::uint64_t slot = old->slots[at].load(std::memory_order_relaxed);
      if (slot != 0) place(*table, slot);
    }
    // Half full at most: with a mask of 32 bits that is 2^31 keys, then nearly full tables.
    limit_ = table->mask == UINT32_MAX ? UINT32_MAX - 1 : (table->mask + 1) / 2;
    tables_.push_back(std::move(table));
    table_.store(tables_.back().get(), std::memory_order_release);
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
