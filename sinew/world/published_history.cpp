#include "sinew/world/published_history.h"

#include <algorithm>

namespace sinew::world {

std::shared_ptr<ReaderPlace> ReaderPlaces::add() {
  auto place = std::make_shared<ReaderPlace>();
  const std::lock_guard lock(mutex_);
  std::erase_if(places_, [](const auto& each) { return each.expired(); });
  places_.push_back(place);
  return place;
}

bool ReaderPlaces::is_looked_at(const History* version) {
  const std::lock_guard lock(mutex_);
  return std::any_of(places_.begin(), places_.end(), [version](const auto& each) {
    const auto place = each.lock();
    return place && place->looks_at.load(std::memory_order_seq_cst) == version;
  });
}

PublishedHistory::PublishedHistory(std::shared_ptr<ReaderPlaces> readers,
                                   std::shared_ptr<const History> first)
    : readers_(std::move(readers)), newest_(first.get()), holds_newest_(std::move(first)) {}

void PublishedHistory::publish(std::shared_ptr<const History> next) {
  newest_.store(next.get(), std::memory_order_seq_cst);
  old_.push_back(std::exchange(holds_newest_, std::move(next)));
  // A reader that says later that it looks at one of these finds that it is not the newest, and
  // does not look.
  std::erase_if(old_, [this](const auto& each) { return !readers_->is_looked_at(each.get()); });
}

}  // namespace sinew::world
