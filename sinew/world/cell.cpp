#include "sinew/world/cell.h"

#include <algorithm>

namespace sinew::world {

Ring::Ring(std::uint32_t capacity, std::uint32_t stride)
    : size(static_cast<std::size_t>(capacity) * stride) {
  lines = std::make_unique<Line[]>((size + 7) / 8);
}

namespace {

// The words of one ring into another of the same cell, while nobody writes either.
void copy(const Ring& from, Ring& to) {
  for (std::size_t i = 0; i < from.size; ++i) {
    to.words()[i].store(from.words()[i].load(std::memory_order_relaxed), std::memory_order_release);
  }
}

}  // namespace

Cell::Cell(std::uint32_t values, std::uint32_t capacity, std::uint64_t owner, Epoch epoch,
           std::shared_ptr<ChangeBoard> board)
    : capacity_(std::bit_ceil(std::max(capacity, kMinimumCapacity))),
      stride_(values + 1),
      mask_(capacity_ - 1),
      owner_(owner),
      changes_(board ? board->add() : &own_changes_),
      board_(std::move(board)) {
  rings_.push_back(std::make_unique<Ring>(capacity_, stride_));
  rings_.back()->since = epoch;
  current_.store(rings_.back().get(), std::memory_order_release);
}

Cell::Cell(const Cell& other, Epoch as_of, std::uint64_t owner, Epoch epoch,
           std::shared_ptr<ChangeBoard> board)
    : Cell(other.values(), other.capacity(), owner, epoch, std::move(board)) {
  View from = other.view(as_of);
  while (!from.settled) from = other.view(as_of);
  copy(*from.ring, *rings_.back());
  head_.store(from.count << Head::kCountShift, std::memory_order_release);
}

std::uint64_t Cell::find(const View& view, Stamp at) const {
  std::uint64_t low = oldest(view);
  std::uint64_t high = view.count - 1;
  const Stamp last = stamp(view, high);
  if (last <= at) return high;
  const Stamp first = stamp(view, low);
  if (first > at) return low;  // overwritten while it was read: the caller will notice
  // stamp(low) <= at < stamp(high)
  if (high - low > 2) {
    const double share =
        static_cast<double>((at - first).count()) / static_cast<double>((last - first).count());
    const std::uint64_t guess = std::clamp(
        low + static_cast<std::uint64_t>(share * static_cast<double>(high - low)), low, high - 1);
    if (stamp(view, guess) <= at) {
      if (at < stamp(view, guess + 1)) return guess;
      low = guess + 1;
    } else {
      high = guess;
    }
  }
  while (high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (stamp(view, middle) <= at) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return low;
}

Ring* Cell::writable(Epoch epoch, Ring*& spare) {
  Ring* const ring = current_.load(std::memory_order_relaxed);
  if (ring->since == epoch) return ring;
  Ring* const fresh = spare;
  spare = nullptr;
  copy(*ring, *fresh);
  fresh->since = epoch;
  fresh->previous.store(ring, std::memory_order_release);
  ring->frozen.store(Head::count(head_.load(std::memory_order_relaxed)), std::memory_order_release);
  current_.store(fresh, std::memory_order_release);
  return fresh;
}

void Cell::store(Ring& ring, std::uint64_t entry, Stamp stamp, const double* values) {
  std::atomic<std::uint64_t>* const to = ring.words() + (entry & mask_) * stride_;
  to[0].store(static_cast<std::uint64_t>(ns_of(stamp)), std::memory_order_release);
  for (std::uint32_t i = 1; i < stride_; ++i) {
    to[i].store(std::bit_cast<std::uint64_t>(values[i - 1]), std::memory_order_release);
  }
}

void Cell::append(Stamp stamp, const double* values, Epoch epoch, Ring*& spare) {
  Ring* const ring = writable(epoch, spare);
  const std::uint64_t head = head_.load(std::memory_order_relaxed);
  store(*ring, Head::count(head), stamp, values);
  head_.store(Head::next(head), std::memory_order_release);
  count_change();
}

void Cell::prepare(Stamp stamp, const double* values, Epoch epoch, Ring*& spare) {
  Ring* const ring = writable(epoch, spare);
  const std::uint64_t head = head_.load(std::memory_order_relaxed);
  store(*ring, Head::count(head), stamp, values);
  head_.store(head | Head::kPending, std::memory_order_release);
}

void Cell::finish() {
  head_.store(Head::next(head_.load(std::memory_order_relaxed)), std::memory_order_release);
  count_change();
}

bool Cell::correct(Stamp at, const double* values, Epoch epoch, Ring*& spare) {
  Ring* const ring = writable(epoch, spare);
  const std::uint64_t head = head_.load(std::memory_order_relaxed);
  const View view = {ring, Head::count(head), head, true};
  const std::uint64_t count = view.count;
  const std::uint64_t first = oldest(view);
  std::uint64_t place = count;  // where it goes: before the first entry that is later
  while (place > first && stamp(view, place - 1) > at) --place;
  const bool replaces = place > first && stamp(view, place - 1) == at;
  if (!replaces && place == first && first > 0) return false;

  const std::uint64_t corrections = (head + (1ull << Head::kCorrectionShift)) & Head::kCorrections;
  const std::uint64_t counted = count << Head::kCountShift;
  head_.store(counted | corrections | Head::kCorrecting, std::memory_order_release);
  if (replaces) {
    store(*ring, place - 1, at, values);
    head_.store(counted | corrections, std::memory_order_release);
    count_change();
    return true;
  }
  for (std::uint64_t entry = count; entry > place; --entry) {
    const auto* const from = ring->words() + ((entry - 1) & mask_) * stride_;
    auto* const to = ring->words() + (entry & mask_) * stride_;
    for (std::uint32_t i = 0; i < stride_; ++i) {
      to[i].store(from[i].load(std::memory_order_relaxed), std::memory_order_release);
    }
  }
  store(*ring, place, at, values);
  head_.store((count + 1) << Head::kCountShift | corrections, std::memory_order_release);
  count_change();
  return true;
}

void Cell::begin_replacing(Epoch epoch, Ring*& spare) {
  writable(epoch, spare);
  const std::uint64_t head = head_.load(std::memory_order_relaxed);
  const std::uint64_t corrections = (head + (1ull << Head::kCorrectionShift)) & Head::kCorrections;
  head_.store(Head::count(head) << Head::kCountShift | corrections | Head::kCorrecting,
              std::memory_order_release);
}

void Cell::finish_replacing(Stamp stamp, const double* values) {
  const std::uint64_t head = head_.load(std::memory_order_relaxed);
  store(*current_.load(std::memory_order_relaxed), Head::count(head) - 1, stamp, values);
  head_.store(head & ~Head::kCorrecting, std::memory_order_release);
  count_change();
}

void Cell::join_batch(std::shared_ptr<const BatchState> batch) {
  batch_.store(batch.get(), std::memory_order_release);
  if (std::find(batches_.begin(), batches_.end(), batch) == batches_.end()) {
    batches_.push_back(std::move(batch));
  }
}

Ring* Cell::spare(Epoch needed) {
  // From the present back: the first ring that is old enough for the oldest clone is the last that
  // anybody reads.
  Ring* last = current_.load(std::memory_order_acquire);
  while (last->since > needed) {
    Ring* const previous = last->previous.load(std::memory_order_acquire);
    if (!previous) break;
    last = previous;
  }
  if (Ring* const free = last->previous.load(std::memory_order_acquire)) {
    Ring* before = last;
    // The oldest one; the others wait for their turn.
    Ring* oldest = free;
    while (Ring* const previous = oldest->previous.load(std::memory_order_acquire)) {
      before = oldest;
      oldest = previous;
    }
    before->previous.store(nullptr, std::memory_order_release);
    return oldest;
  }
  rings_.push_back(std::make_unique<Ring>(capacity_, stride_));
  return rings_.back().get();
}

}  // namespace sinew::world
