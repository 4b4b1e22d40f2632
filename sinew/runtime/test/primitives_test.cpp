#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "sinew/runtime/published.h"
#include "sinew/runtime/ring.h"
#include "sinew/runtime/statistics.h"
#include "sinew/runtime/storage.h"

namespace sinew::runtime {
namespace {

TEST(Ring, HandsOverInOrderAndRefusesWhenFull) {
  Ring<int> ring(3);  // rounded to 4
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(int(i)));
  EXPECT_FALSE(ring.push(4));
  int value = -1;
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(ring.pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.pop(value));
}

TEST(RowRing, HandsRowsFromOneThreadToAnotherWhole) {
  RowRing ring(3, 64);
  constexpr int kRows = 20000;
  std::thread producer([&] {
    for (int i = 0; i < kRows;) {
      const double row[] = {double(i), double(i) + 0.25, double(i) + 0.5};
      if (ring.push(row))
        ++i;
      else
        std::this_thread::yield();
    }
  });
  for (int i = 0; i < kRows;) {
    double row[3];
    if (!ring.pop(row)) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(row[0], i);
    ASSERT_EQ(row[1], i + 0.25);
    ASSERT_EQ(row[2], i + 0.5);
    ++i;
  }
  producer.join();
}

TEST(Published, AReaderSeesWholePublications) {
  Published numbers(8);
  std::array<double, 8> seen{};
  EXPECT_FALSE(numbers.read(seen)) << "nothing was published yet";
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (int i = 1; i <= 20000; ++i) {
      std::array<double, 8> row;
      row.fill(i);
      numbers.publish(row);
      if (i % 64 == 0) std::this_thread::yield();
    }
    done = true;
  });
  double last = 0;
  while (!done) {
    if (!numbers.read(seen)) continue;
    for (const double number : seen) ASSERT_EQ(number, seen[0]);
    ASSERT_GE(seen[0], last);
    last = seen[0];
  }
  writer.join();
  ASSERT_TRUE(numbers.read(seen));
  EXPECT_EQ(seen[7], 20000);
}

TEST(Histogram, GivesPercentilesWithinASixteenth) {
  Histogram histogram;
  for (Nanoseconds i = 1; i <= 100000; ++i) histogram.add(i);
  EXPECT_EQ(histogram.count(), 100000u);
  EXPECT_EQ(histogram.minimum(), 1);
  EXPECT_EQ(histogram.maximum(), 100000);
  for (const double share : {0.01, 0.5, 0.99, 0.999}) {
    const double exact = share * 100000;
    EXPECT_GE(static_cast<double>(histogram.percentile(share)), exact);
    EXPECT_LE(static_cast<double>(histogram.percentile(share)), exact * (1 + 1.0 / 16));
  }
  EXPECT_EQ(histogram.percentile(1), 100000);
}

TEST(Storage, PutsEveryBlockOnCacheLinesOfItsOwn) {
  std::vector<program::Variable> blocks(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    blocks[i].name = "block" + std::to_string(i);
    blocks[i].iri = "https://example.org/" + blocks[i].name;
    blocks[i].size = 1 + i * 9;
  }
  blocks[2].value.assign(19, 4.0);
  Storage storage(blocks);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(storage.numbers(i).data()) % kCacheLine, 0u);
    EXPECT_EQ(storage.find(blocks[i].iri), i);
    EXPECT_EQ(storage.find(blocks[i].name), i);
  }
  EXPECT_EQ(storage.find("nothing"), kNoBlock);
  EXPECT_EQ(storage.numbers(2)[18], 4.0);
  storage.numbers(2)[18] = 5.0;
  storage.reset();
  EXPECT_EQ(storage.numbers(2)[18], 4.0);
}

}  // namespace
}  // namespace sinew::runtime
