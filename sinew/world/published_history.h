// How a history (history.h) reaches real-time readers: one pointer to its newest version, and one
// place for each reader where it says which version it is looking at (hazard pointers, Michael
// 2004). A reader takes no lock, allocates nothing and is never waited for; whoever publishes a new
// version keeps the old ones until nobody looks at them.
//
// The ring and the history together have no gap: what is in the history no longer only is in it
// before it leaves the ring (write_log.h).
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "sinew/world/history.h"

namespace sinew::world {

// Attempts to get hold of a version while new ones are published.
inline constexpr int kHoldAttempts = 64;

// Of one reader, which is one thread at a time.
struct alignas(64) ReaderPlace {
  std::atomic<const History*> looks_at = nullptr;
};

// All readers of a world and of its clones.
class ReaderPlaces {
 public:
  std::shared_ptr<ReaderPlace> add();
  bool is_looked_at(const History* version);  // any thread but real-time ones

 private:
  std::mutex mutex_;
  std::vector<std::weak_ptr<ReaderPlace>> places_;
};

// The newest version of one measurement's history.
class PublishedHistory {
 public:
  PublishedHistory(std::shared_ptr<ReaderPlaces> readers, std::shared_ptr<const History> first);

  // One thread at a time (the world's `editing` is held).
  void publish(std::shared_ptr<const History> next);
  std::size_t versions() const { return old_.size() + 1; }  // that are kept

  // ---- real-time readers ----
  // Holds the newest version until `let_go`; null when publishers never paused.
  const History* hold(ReaderPlace& reader) const {
    for (int attempt = 0; attempt < kHoldAttempts; ++attempt) {
      const History* const version = newest_.load(std::memory_order_seq_cst);
      reader.looks_at.store(version, std::memory_order_seq_cst);
      if (newest_.load(std::memory_order_seq_cst) == version) return version;
    }
    let_go(reader);
    return nullptr;
  }
  static void let_go(ReaderPlace& reader) {
    reader.looks_at.store(nullptr, std::memory_order_release);
  }

 private:
  std::shared_ptr<ReaderPlaces> readers_;
  std::atomic<const History*> newest_;
  std::shared_ptr<const History> holds_newest_;
  std::vector<std::shared_ptr<const History>> old_;  // that somebody looked at, last time
};

// A reader's own place: copies have one each.
class OwnReaderPlace {
 public:
  OwnReaderPlace() = default;
  explicit OwnReaderPlace(std::shared_ptr<ReaderPlaces> all)
      : all_(std::move(all)), own_(all_->add()) {}
  OwnReaderPlace(const OwnReaderPlace& other)
      : all_(other.all_), own_(all_ ? all_->add() : nullptr) {}
  OwnReaderPlace(OwnReaderPlace&&) noexcept = default;
  OwnReaderPlace& operator=(OwnReaderPlace other) noexcept {
    std::swap(all_, other.all_);
    std::swap(own_, other.own_);
    return *this;
  }
  ReaderPlace* get() const { return own_.get(); }

 private:
  std::shared_ptr<ReaderPlaces> all_;
  std::shared_ptr<ReaderPlace> own_;
};

}  // namespace sinew::world
