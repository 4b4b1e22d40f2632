// Writing from real-time threads. A handle has its measurements for itself; `write` is wait-free:
// it allocates nothing, takes no lock, waits for nobody and always does the same bounded work
// (after a clone once more: the ring is copied into a spare that `clone` made).
//
// Of a measurement that keeps every entry, a write is refused with kNoRoom, and counted, when the
// collector is behind (collector.h); nothing is changed then. Where the rights have changed and no
// longer allow it, every write is kForbidden.
//
// A handle is used by one thread at a time. It keeps what it needs alive, so it may outlive its
// measurement: what is written then is seen by nobody.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sinew/world/answer.h"
#include "sinew/world/block_set.h"
#include "sinew/world/cell.h"
#include "sinew/world/ids.h"
#include "sinew/world/write_log.h"

namespace sinew::world {

struct WorldImpl;

// What a clone has to know of a handle: whether a write is under way, and its spares.
struct WriterState {
  struct Target {
    std::shared_ptr<Cell> cell;
    // Two: while a write uses one up, `clone` may already count on the next write's.
    std::atomic<Ring*> spares[2] = {nullptr, nullptr};
    bool is_pose = false;
    MeasurementId measurement;
    std::unique_ptr<WriteLog> log;                        // where every entry is kept
    std::shared_ptr<const BlockSet> blocks;               // of a measurement
    std::vector<std::unique_ptr<Target>> blocks_targets;  // a cell for each of them
  };
  std::atomic<std::uint64_t> active = 0;  // odd while a write is under way
  std::atomic<bool> forbidden = false;    // since the rights have changed
  std::string who;
  std::vector<std::unique_ptr<Target>> targets;
  std::shared_ptr<BatchState> batch;  // where one write changes several cells

  // Calls visit(Target&) for every cell.
  template <typename Visit>
  void each(Visit&& visit) {
    for (const auto& target : targets) {
      visit(*target);
      for (const auto& block : target->blocks_targets) visit(*block);
    }
  }
};

class Writer {
 public:
  Writer(Writer&&) noexcept;
  Writer& operator=(Writer&&) noexcept;
  ~Writer();

  // kOutOfOrder unless the stamp is later than the last one's; kNotANumber as World::write.
  Status write(Stamp stamp, const Pose& pose);
  Status write(Stamp stamp, std::span<const double> values);
  // Puts a value in its place among the past ones, or replaces the one with the same stamp; moves
  // at most as many entries as the ring holds.
  Status correct(Stamp stamp, std::span<const double> values);
  Status correct(Stamp stamp, const Pose& pose);
  // The value as one of the measurement's data blocks has it, `size` bytes; all blocks follow.
  // kReadOnly when the block is derived, kNotANumber when the size is wrong.
  Status write_block(std::size_t block, Stamp stamp, const void* value, std::size_t size);
  // The same for a past value, as `correct`. At the last stamp the measurement and all its blocks
  // change as one.
  Status correct_block(std::size_t block, Stamp stamp, const void* value, std::size_t size);

  std::uint64_t refused() const;  // writes for which there was no room; any thread

 private:
  friend class World;
  Writer(std::shared_ptr<WorldImpl> world, std::unique_ptr<WriterState> state);
  Status write_values(Stamp stamp, const double* values, bool correction);
  Status write_to_cell(Stamp stamp, const double* values, bool past);
  Status write_block(std::size_t block, Stamp stamp, const void* value, std::size_t size,
                     bool correction);
  std::shared_ptr<WorldImpl> world_;
  std::unique_ptr<WriterState> state_;
};

// Several measurements that change as one: the joint positions of a robot, a pose and its twist.
class BatchWriter {
 public:
  BatchWriter(BatchWriter&&) noexcept;
  BatchWriter& operator=(BatchWriter&&) noexcept;
  ~BatchWriter();

  // The numbers of all measurements one after the other, in the order in which they were claimed.
  Status write(Stamp stamp, std::span<const double> values);
  std::size_t size() const { return size_; }  // numbers of one write
  std::uint64_t refused() const;              // as Writer's

 private:
  friend class World;
  BatchWriter(std::shared_ptr<WorldImpl> world, std::unique_ptr<WriterState> state);
  std::shared_ptr<WorldImpl> world_;
  std::unique_ptr<WriterState> state_;
  std::size_t size_ = 0;
};

}  // namespace sinew::world
