// A cell holds what was measured of one thing: a ring of entries (a stamp and some numbers) that
// one writer at a time fills and any number of threads read.
//
// Writing is wait-free: the numbers go into the slot of the oldest entry, then one word, the
// *head*, makes them visible. Nobody is waited for, nothing is allocated. Reading copies entries
// and then looks at the head again: what has been overwritten meanwhile is read anew, a bounded
// number of times. Every word is an atomic, so that this is defined behaviour and a sanitizer can
// check it; on x86 the orders used are plain loads and stores.
//
// *Several cells at once.* The head counts entries and never goes back, so cells whose heads are
// the same before and after they were read were all in that state at one instant: a chain is read
// consistently without a version that all writers would have to fight for. A batch (several
// cells written as one) marks its heads as pending, publishes one word, and then sets the heads:
// readers that meet a pending head look at that word, so a batch is seen whole or not at all, and
// a writer that is preempted in between holds nobody up.
//
// *Clones.* A clone is made in O(1) and sees each cell as it was. The writer notices that a clone
// was made since its last write, by the epoch, and goes on in a copy of its ring (a spare, made
// beforehand); the clone keeps the old one. Rings are freed with their cell only, so a
// reader never holds freed memory.
#pragma once

#include <atomic>
#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sinew/world/change_board.h"
#include "sinew/world/clock.h"

namespace sinew::world {

// Entries that a ring can hold; one slot more is always under the writer's pen.
inline constexpr std::uint32_t kMinimumCapacity = 4;
inline constexpr std::uint32_t kMaximumCapacity = 1u << 16;
inline constexpr std::uint32_t kMaximumValues = 1024;  // numbers of one entry
// Attempts of one read before it gives up (kBusy): reached only when writers never pause.
inline constexpr int kReadAttempts = 64;

using Epoch = std::uint64_t;
inline constexpr Epoch kNow = UINT64_MAX;  // the present, whatever epoch that is

// The entries of one cell, or what a clone keeps of them.
struct Ring {
  Ring(std::uint32_t capacity, std::uint32_t stride);

  Epoch since = 0;                        // the first epoch of which entries were written here
  std::atomic<Ring*> previous = nullptr;  // what was written before a clone was made
  std::atomic<std::uint64_t> frozen = 0;  // entries that there were when it was replaced
  // capacity * stride words: of an entry its stamp, then its numbers. A pose fills one cache line.
  std::atomic<std::uint64_t>* words() const { return lines[0].words; }
  struct alignas(64) Line {
    std::atomic<std::uint64_t> words[8];
  };
  std::unique_ptr<Line[]> lines;
  std::size_t size;
};

// The word of a batch writer: odd from the instant at which its batch is committed to the next
// batch.
using BatchState = std::atomic<std::uint64_t>;
inline constexpr std::uint64_t kBatchIdle = 1;

// The head: entries written so far, and two marks.
struct Head {
  static constexpr std::uint64_t kPending = 1;     // one more, if the batch is committed
  static constexpr std::uint64_t kCorrecting = 2;  // entries are being moved
  static constexpr int kCorrectionShift = 2;       // counts corrections, so that each is noticed
  static constexpr int kCountShift = 24;
  static constexpr std::uint64_t kCorrections = (1ull << kCountShift) - (1ull << kCorrectionShift);
  static constexpr std::uint64_t count(std::uint64_t head) { return head >> kCountShift; }
  // The head after one more entry.
  static constexpr std::uint64_t next(std::uint64_t head) {
    return (head & ~(kPending | kCorrecting)) + (1ull << kCountShift);
  }
};

class alignas(64) Cell {
 public:
  // `owner` is the token of the world that may write it. Precondition: limits as above. Its
  // changes are counted on the board, where there is one.
  Cell(std::uint32_t values, std::uint32_t capacity, std::uint64_t owner, Epoch epoch,
       std::shared_ptr<ChangeBoard> board = nullptr);
  // A cell of another world's with the same entries, as they were at `as_of`.
  Cell(const Cell& other, Epoch as_of, std::uint64_t owner, Epoch epoch,
       std::shared_ptr<ChangeBoard> board = nullptr);
  Cell& operator=(const Cell&) = delete;

  std::uint32_t values() const { return stride_ - 1; }
  std::uint32_t capacity() const { return capacity_; }
  std::uint64_t owner() const { return owner_; }
  // Counts whatever is written, after it is visible.
  const ChangeCount& changes() const { return *changes_; }

  // ---- reading, any thread ----

  // The ring and how many entries had been written, at one instant. `settled` is false when a
  // writer was in the way: try again.
  struct View {
    const Ring* ring;
    std::uint64_t count;
    std::uint64_t head;  // what `unchanged` compares
    bool settled;
  };
  View view(Epoch as_of) const;
  // Whether nothing has been written since that view was taken.
  bool unchanged(const View& view, Epoch as_of) const;
  // Whether entry number `entry` was still whole when this is called, after it was read.
  bool intact(const View& view, std::uint64_t entry, Epoch as_of) const;
  // Number of the oldest entry that can be read.
  std::uint64_t oldest(const View& view) const {
    return view.count > capacity_ - 1 ? view.count - (capacity_ - 1) : 0;
  }
  Stamp stamp(const View& view, std::uint64_t entry) const {
    const auto word = words(view, entry)[0].load(std::memory_order_acquire);
    return stamp_of_ns(static_cast<std::int64_t>(word));
  }
  void read(const View& view, std::uint64_t entry, double* values, std::uint32_t count) const {
    const std::atomic<std::uint64_t>* const from = words(view, entry) + 1;
    for (std::uint32_t i = 0; i < count; ++i) {
      values[i] = std::bit_cast<double>(from[i].load(std::memory_order_acquire));
    }
  }
  // An entry where it lies: its stamp, then its numbers.
  const std::atomic<std::uint64_t>* words(const View& view, std::uint64_t entry) const {
    return view.ring->words() + (entry & mask_) * stride_;
  }
  // The last entry with a stamp of at most `at`, among oldest .. count - 1; precondition: there is
  // one. A guess by the mean rate comes first, so evenly spaced entries are found at once.
  std::uint64_t find(const View& view, Stamp at) const;

  // ---- writing, one thread at a time ----

  // Whether the next write goes on in a new ring.
  bool needs_spare(Epoch epoch) const {
    return current_.load(std::memory_order_relaxed)->since != epoch;
  }
  // Appends an entry; precondition: its stamp is later than the last one's. Uses up `spare` (and
  // sets it to null) when a clone was made since.
  void append(Stamp stamp, const double* values, Epoch epoch, Ring*& spare);
  // The same in two halves, for batches: between them the entry is seen if `batch` is odd.
  void prepare(Stamp stamp, const double* values, Epoch epoch, Ring*& spare);
  void finish();
  // Puts an entry in its place by time, or replaces the one with the same stamp. At most `capacity`
  // entries are moved. False when it is older than all that the full ring holds.
  bool correct(Stamp stamp, const double* values, Epoch epoch, Ring*& spare);
  // Replaces the last entry, in two halves: in between readers find the cell unsettled, so that
  // other cells can change together with it. Precondition: there is an entry, and no batch pending.
  void begin_replacing(Epoch epoch, Ring*& spare);
  void finish_replacing(Stamp stamp, const double* values);

  // ---- between writes, under the world's lock ----

  // A ring that no world needs any more, or a new one. `needed` is the oldest epoch of this owner
  // that a living clone still sees.
  Ring* spare(Epoch needed);
  std::size_t rings() const { return rings_.size(); }
  // Before the first `prepare` of that batch. The cell keeps the word, for readers that look at it.
  void join_batch(std::shared_ptr<const BatchState> batch);

  // Who has a real-time handle on this cell; empty: nobody.
  std::string claimed_by;

 private:
  void count_change() {
    changes_->store(changes_->load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }
  Ring* writable(Epoch epoch, Ring*& spare);
  void store(Ring& ring, std::uint64_t entry, Stamp stamp, const double* values);

  std::atomic<std::uint64_t> head_ = 0;
  std::atomic<Ring*> current_ = nullptr;
  std::atomic<const BatchState*> batch_ = nullptr;
  std::uint32_t capacity_;  // a power of two
  std::uint32_t stride_;    // words of an entry
  std::uint64_t mask_;
  std::uint64_t owner_;
  ChangeCount* changes_;
  ChangeCount own_changes_ = 0;  // where there is no board
  std::shared_ptr<ChangeBoard> board_;
  std::vector<std::unique_ptr<Ring>> rings_;
  std::vector<std::shared_ptr<const BatchState>> batches_;
};

// ---- implementation of what every read does ----

inline Cell::View Cell::view(Epoch as_of) const {
  if (as_of == kNow) [[likely]] {
    const std::uint64_t head = head_.load(std::memory_order_acquire);
    const Ring* const ring = current_.load(std::memory_order_acquire);
    if ((head & (Head::kPending | Head::kCorrecting)) == 0) [[likely]] {
      return {ring, Head::count(head), head, true};
    }
    if (head & Head::kCorrecting) return {ring, Head::count(head), head, false};
    const std::uint64_t committed =
        batch_.load(std::memory_order_acquire)->load(std::memory_order_acquire) & 1;
    return {ring, Head::count(head) + committed, head,
            head_.load(std::memory_order_acquire) == head};
  }
  for (int attempt = 0; attempt < kReadAttempts; ++attempt) {
    const Ring* ring = current_.load(std::memory_order_acquire);
    if (ring->since <= as_of) {
      // Nothing has been written since the clone was made, so nothing is under way.
      const std::uint64_t head = head_.load(std::memory_order_acquire);
      if (current_.load(std::memory_order_acquire) == ring)
        return {ring, Head::count(head), 0, true};
      continue;
    }
    while (ring->since > as_of) ring = ring->previous.load(std::memory_order_acquire);
    return {ring, ring->frozen.load(std::memory_order_acquire), 0, true};
  }
  return {nullptr, 0, 0, false};
}

inline bool Cell::unchanged(const View& view, Epoch as_of) const {
  if (as_of != kNow) return true;
  const std::uint64_t head = head_.load(std::memory_order_acquire);
  if (head == view.head && (head & Head::kPending) == 0) [[likely]]
    return true;
  if (((head ^ view.head) & Head::kCorrections) != 0) return false;
  const View again = this->view(as_of);
  return again.settled && again.count == view.count &&
         ((again.head ^ view.head) & Head::kCorrections) == 0;
}

inline bool Cell::intact(const View& view, std::uint64_t entry, Epoch as_of) const {
  if (as_of != kNow) return true;
  const std::uint64_t head = head_.load(std::memory_order_acquire);
  constexpr std::uint64_t kMoved = Head::kCorrecting | Head::kCorrections;
  return ((head ^ view.head) & kMoved) == 0 && Head::count(head) < entry + capacity_;
}

}  // namespace sinew::world
