// The tables that stores are made of: hash tables of numbers, and the memory under them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <thread>
#include <unordered_map>
#include <vector>

#include "sinew/graph/pages.h"
#include "sinew/graph/slot_table.h"
#include "sinew/graph/stable_array.h"

namespace sinew::graph {
namespace {

// Keys whose hashes collide in full and in part, so that chains are long and overlap.
struct Keys {
  std::vector<std::uint32_t> hashes = {0};  // of number 1, 2, …
  SlotTable table;

  SlotTable::Slot find(std::uint32_t number, std::uint32_t* at = nullptr) const {
    return table.find(
        hashes[number], [&](SlotTable::Slot slot) { return slot.number() == number; }, at);
  }
};

TEST(SlotTable, HoldsWhatAnUnorderedMapHoldsWhateverIsTakenOut) {
  constexpr std::uint32_t kKeys = 3000;
  for (const std::uint32_t spread : {40u, 900u, 0x7FFFFFFFu}) {
    SCOPED_TRACE(spread);
    std::mt19937 random(spread);
    Keys keys;
    for (std::uint32_t i = 0; i < kKeys; ++i) keys.hashes.push_back(random() % spread);
    std::unordered_map<std::uint32_t, bool> model;  // number to mark
    for (int step = 0; step < 40'000; ++step) {
      // Few at first, so that slots are emptied and filled again before the table grows.
      const std::uint32_t among = step < 20'000 ? 150 : kKeys;
      const std::uint32_t number = 1 + random() % among;
      std::uint32_t at = 0;
      const SlotTable::Slot found = keys.find(number, &at);
      ASSERT_EQ(static_cast<bool>(found), model.contains(number));
      if (!found) {
        const bool mark = random() % 2 == 0;
        keys.table.insert(at, keys.hashes[number], number, mark);
        model[number] = mark;
      } else if (random() % 3 == 0) {
        keys.table.replace(at, number, !found.marked());
        model[number] = !found.marked();
      } else {
        keys.table.erase(at);
        model.erase(number);
      }
    }
    for (std::uint32_t number = 1; number <= kKeys; ++number) {
      const SlotTable::Slot found = keys.find(number);
      ASSERT_EQ(static_cast<bool>(found), model.contains(number)) << number;
      if (found) {
        EXPECT_EQ(found.marked(), model[number]) << number;
      }
    }
  }
}

TEST(SlotTable, DoesNotGrowWhileTheSameKeysComeAndGo) {
  Keys keys;
  for (std::uint32_t i = 0; i < 100; ++i) keys.hashes.push_back(i / 3);
  std::uint32_t highest = 0;
  for (int round = 0; round < 10'000; ++round) {
    for (std::uint32_t number = 1; number <= 100; ++number) {
      std::uint32_t at = 0;
      if (keys.find(number, &at)) {
        keys.table.erase(at);
      } else {
        keys.table.insert(at, keys.hashes[number], number);
      }
      highest = std::max(highest, at);
    }
  }
  // In a table of the first size, the chains of 34 neighbouring hashes end soon.
  EXPECT_LT(highest, 256u);
}

TEST(Pages, AreZeroWhateverWasInThemBefore) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{4096}, std::size_t{70'000},
                                 kHugePage / 2, kHugePage / 2 + 1, 3 * kHugePage}) {
    for (int round = 0; round < 3; ++round) {
      auto* const memory = static_cast<unsigned char*>(allocate_zeroed(size));
      EXPECT_EQ(std::count(memory, memory + size, 0), static_cast<std::ptrdiff_t>(size)) << size;
      std::memset(memory, 0xAB, size);
      release_pages(memory, size);
    }
  }
  release_pages(nullptr, 100);
}

TEST(Pages, NoTwoBlocksOverlapWhicheverThreadHasThem) {
  const auto work = [](unsigned char mark) {
    std::mt19937 random(mark);
    struct Block {
      unsigned char* memory;
      std::size_t size;
    };
    std::vector<Block> blocks;
    for (int step = 0; step < 2000; ++step) {
      if (blocks.size() < 20 || random() % 2 == 0) {
        const std::size_t size = 1 + random() % (std::size_t{1} << (6 + random() % 13));
        auto* const memory = static_cast<unsigned char*>(allocate_raw(size));
        std::memset(memory, mark, size);
        blocks.push_back({memory, size});
      } else {
        std::swap(blocks[random() % blocks.size()], blocks.back());
        const auto [memory, size] = blocks.back();
        ASSERT_EQ(std::count(memory, memory + size, mark), static_cast<std::ptrdiff_t>(size));
        release_pages(memory, size);
        blocks.pop_back();
      }
    }
    for (const auto& [memory, size] : blocks) release_pages(memory, size);
  };
  std::thread other(work, 1);
  work(2);
  other.join();
}

TEST(StableArray, ElementsStayWhereTheyAreAndStartAsZero) {
  StableArray<std::uint64_t> array;
  std::uint64_t* const first = &array.reserve(0);
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    ASSERT_EQ(array.reserve(i), 0u);
    array[i] = i + 1;
  }
  EXPECT_EQ(first, &array[0]);
  for (std::uint32_t i = 0; i < 100'000; ++i) ASSERT_EQ(array[i], i + 1);
  EXPECT_EQ(array.find(1u << 30), nullptr);
}

}  // namespace
}  // namespace sinew::graph
