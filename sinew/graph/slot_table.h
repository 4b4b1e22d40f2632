// A hash table of 32-bit numbers that stand for keys which lie elsewhere. A slot is one 64-bit
// word: a mark, 31 bits of the key's hash, and the number; so it is read and written atomically,
// and one thread may change the table while others look up. What the mark says about the number is
// up to the user. Tables that were outgrown stay until the end, because a reader may still be in
// one; together they are no larger than the present one.
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

  // What a slot holds. One word, so that looking up needs no memory.
  class Slot {
   public:
    explicit Slot(std::uint64_t word = 0) : word_(word) {}
    explicit operator bool() const { return word_ != 0; }
    std::uint32_t number() const { return static_cast<std::uint32_t>(word_); }
    bool marked() const { return word_ >> 63 != 0; }

   private:
    std::uint64_t word_;
  };
  // The number whose key has this hash and for which `is_key(Slot)` holds; false where there is
  // none. `at` is set to where it is, or to where it would be inserted; valid until the table
  // changes.
  template <typename IsKey>
  Slot find(std::uint32_t hash, IsKey&& is_key, std::uint32_t* at = nullptr) const {
    const Table* table = table_.load(std::memory_order_acquire);
    hash &= kHashBits;
    std::uint32_t stone = UINT32_MAX;
    for (std::uint32_t here = hash & table->mask;; here = (here + 1) & table->mask) {
      const std::uint64_t word = table->slots[here].load(std::memory_order_acquire);
      const Slot slot(word);
      if (word == 0) {
        if (at) *at = stone == UINT32_MAX ? here : stone;
        return slot;
      }
      if (at && word == kStone && stone == UINT32_MAX) stone = here;
      if ((static_cast<std::uint32_t>(word >> 32) & kHashBits) != hash) continue;
      if (slot.number() == 0 || !is_key(slot)) continue;
      if (at) *at = here;
      return slot;
    }
  }

  // Asks for where a key of this hash is or would be, which will be written soon.
  void prefetch(std::uint32_t hash) const {
    const Table* table = table_.load(std::memory_order_acquire);
    __builtin_prefetch(&table->slots[hash & kHashBits & table->mask], 1);
  }

  // ---- writer only ----

  // Precondition: number > 0, its key is not in the table, and `at` is where `find` ended.
  void insert(std::uint32_t at, std::uint32_t hash, std::uint32_t number, bool marked = false) {
    const std::uint64_t slot = word(hash, number, marked);
    std::atomic<std::uint64_t>& free = present().slots[at];
    if (free.load(std::memory_order_relaxed) == 0) {
      if (used_ >= limit_) [[unlikely]] {
        grow_for(slot);
        return;
      }
      ++used_;
    }
    free.store(slot, std::memory_order_release);
  }
  // Precondition: `slot` was set by `find`, perhaps before the table grew.
  Slot at(std::uint32_t slot) const {
    return Slot(present().slots[slot].load(std::memory_order_relaxed));
  }
  // Gives the key in this slot another number.
  void replace(std::uint32_t slot, std::uint32_t number, bool marked) {
    std::atomic<std::uint64_t>& word = present().slots[slot];
    const auto hash = static_cast<std::uint32_t>(word.load(std::memory_order_relaxed) >> 32);
    word.store(this->word(hash, number, marked), std::memory_order_release);
  }
  // Takes the key in this slot out. What stands behind it may have been moved on by it, so a stone
  // takes its place until the next key comes by, unless nothing stands there: then the stones
  // before it go, too.
  void erase(std::uint32_t slot) {
    Table& table = present();
    const auto at = [&](std::uint32_t number) -> std::atomic<std::uint64_t>& {
      return table.slots[number & table.mask];
    };
    if (at(slot + 1).load(std::memory_order_relaxed) != 0) {
      at(slot).store(kStone, std::memory_order_release);
      return;
    }
    do {
      at(slot).store(0, std::memory_order_release);
      --used_;
      --slot;
    } while (at(slot).load(std::memory_order_relaxed) == kStone);
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
  static constexpr std::uint32_t kLargeMask = 0xFFFF;  // up to it, tables grow by four
  struct Table {
    explicit Table(std::uint32_t last)
        : mask(last), slots(static_cast<std::atomic<std::uint64_t>*>(allocate_zeroed(bytes()))) {}
    ~Table() { release_pages(slots, bytes()); }
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;
    std::size_t bytes() const { return (std::size_t{mask} + 1) * sizeof(std::uint64_t); }

    std::uint32_t mask;
    std::atomic<std::uint64_t>* slots;
  };

  static constexpr std::uint32_t kMark = 0x80000000u, kHashBits = 0x7FFFFFFFu;
  static constexpr std::uint64_t kStone = std::uint64_t{kHashBits} << 32;  // the number is 0

  static std::uint64_t word(std::uint32_t hash, std::uint32_t number, bool marked) {
    return std::uint64_t{(hash & kHashBits) | (marked ? kMark : 0)} << 32 | number;
  }
  static void place(Table& table, std::uint64_t slot) {
    std::uint32_t at = static_cast<std::uint32_t>(slot >> 32) & kHashBits & table.mask;
    while (table.slots[at].load(std::memory_order_relaxed) != 0) at = (at + 1) & table.mask;
    table.slots[at].store(slot, std::memory_order_release);
  }
  void install(std::uint32_t mask) {
    tables_.push_back(std::make_unique<Table>(mask));
    // Eleven sixteenths full at most, and nearly full only when there are no more numbers.
    limit_ = mask == UINT32_MAX ? UINT32_MAX - 1 : mask / 16 * 11;
  }
  Table& present() const { return *table_.load(std::memory_order_relaxed); }
  void publish() { table_.store(tables_.back().get(), std::memory_order_release); }
  [[gnu::noinline]] void grow_for(std::uint64_t slot) {
    grow();
    ++used_;
    place(present(), slot);
  }
  void grow() {
    const Table* old = table_.load(std::memory_order_relaxed);
    install(old->mask <= kLargeMask ? old->mask * 4 + 3 : old->mask * 2 + 1);
    Table& made = *tables_.back();
    used_ = 0;
    // Which slots are free can't be guessed, so the others are collected without a branch.
    std::uint64_t taken[kFirstMask + 1];
    for (std::size_t begin = 0; begin <= old->mask; begin += kFirstMask + 1) {
      std::uint32_t count = 0;
      for (std::size_t at = begin; at <= begin + kFirstMask; ++at) {
        taken[count] = old->slots[at].load(std::memory_order_relaxed);
        count += static_cast<std::uint32_t>(taken[count]) != 0;
      }
      for (std::uint32_t at = 0; at < count; ++at) place(made, taken[at]);
      used_ += count;
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
