#include "sinew/synthesis/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>

#include "sinew/synthesis/asked.h"

namespace sinew::synthesis {
namespace {

bool contains(std::span<const std::string> list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

class Planner {
 public:
  Planner(std::span<const Step> steps, std::span<const std::string> given)
      : steps_(steps), given_(given.begin(), given.end()) {}

  Plan plan(std::span<const Wish> wishes, Report& report) {
    for (const Wish& wish : wishes) {
      std::vector<std::string> missing;
      if (!obtain(wish.slot, "asked: " + wish.asked, missing)) refuse(wish, missing, report);
      in_progress_.clear();
      unknown_.clear();
    }
    use_what_is_there();
    return sort();
  }

 private:
  enum class State { kOpen, kTaken, kImpossible };

  void refuse(const Wish& wish, const std::vector<std::string>& missing, Report& report) const {
    for (const std::string& slot : unknown_)
      if (missing.empty() && slot != wish.slot)
        report.error(
            wish.origin.place, wish.origin.iri,
            fmt::format("{} cannot be computed without {}, which no step gives", wish.asked, slot),
            "add a step that gives it");
    if (missing.empty() && (unknown_.empty() || unknown_.contains(wish.slot))) {
      report.error(wish.origin.place, wish.origin.iri,
                   fmt::format("nothing computes {}", wish.asked),
                   "ask for a quantity that `sinew synth --help` lists");
      return;
    }
    for (auto at = missing.begin(); at != missing.end(); ++at) {
      if (std::find(missing.begin(), at, *at) != at) continue;
      const std::string& slot = *at;
      const GivenQuantity* driver = find_given_for(slot);
      const std::string name(driver ? driver->name : std::string_view(slot));
      report.error(wish.origin.place, wish.origin.iri,
                   fmt::format("{} cannot be computed without {}", wish.asked, name),
                   fmt::format("add {} to what the query gives", name));
    }
  }

  // Whether a slot can be had; takes the steps for it. `missing` collects what would have helped.
  bool obtain(const std::string& slot, const std::string& why, std::vector<std::string>& missing) {
    if (given_.contains(slot) || made_.contains(slot)) return true;
    if (!in_progress_.insert(slot).second) return false;  // it would need itself
    const bool asked = in_progress_.size() == 1;
    if (find_given_for(slot) == nullptr &&
        std::none_of(steps_.begin(), steps_.end(),
                     [&](const Step& step) { return contains(step.gives, slot); }))
      unknown_.insert(slot);
    const std::size_t mark = missing.size();
    bool found = false;
    for (const Step& step : steps_) {
      if (!contains(step.gives, slot)) continue;
      found = take(step, slot, why, missing);
      if (found) break;
    }
    // A driver on the way is what the user can add, whatever else would have led to it.
    const bool driver = !asked && find_given_for(slot) != nullptr;
    if (found || driver) missing.resize(mark);
    if (!found && driver) missing.push_back(slot);
    in_progress_.erase(slot);
    return found;
  }

  bool take(const Step& step, const std::string& slot, const std::string& why,
            std::vector<std::string>& missing) {
    const std::size_t mark = taken_.size();
    bool complete = true;  // all that is missing is to be named, so no need is left out
    for (const std::string& need : step.needs)
      complete &= obtain(need, "needed by " + step.name, missing);
    if (!complete) {
      while (taken_.size() > mark) {
        for (const std::string& gift : taken_.back()->gives) made_.erase(gift);
        why_.erase(taken_.back());
        taken_.pop_back();
      }
      return false;
    }
    taken_.push_back(&step);
    why_[&step] = fmt::format("{} ({}): {}", slot, why, step.purpose);
    for (const std::string& gift : step.gives) made_.insert(gift);
    return true;
  }

  // What a step may use and could be had without anything new belongs before it.
  void use_what_is_there() {
    for (const Step* step : taken_)
      for (const std::string& slot : step->may_use)
        if (made_.contains(slot)) used_[step].push_back(slot);
  }

  // The first sweep in which all that a step needs is there: the same one as its giver's if both go
  // the same way or one of them stays where it is, a later one otherwise.
  Plan sort() {
    std::vector<Sweep> sweeps;
    std::unordered_map<const Step*, std::size_t> sweep_of;
    for (const Step* step : givers_first()) {
      std::size_t at = 0;
      for (const Step* giver : givers(*step)) {
        const std::size_t after = sweep_of.at(giver);
        const bool once =
            step->direction == Direction::kOnce || sweeps[after].direction == Direction::kOnce;
        const bool same = !once && (step->direction == Direction::kLocal ||
                                    sweeps[after].direction == step->direction);
        at = std::max(at, same ? after : after + 1);
      }
      const Direction direction =
          step->direction == Direction::kLocal ? Direction::kOutward : step->direction;
      const auto fits = [&](const Sweep& sweep) {
        return step->direction == Direction::kLocal ? sweep.direction != Direction::kOnce
                                                    : sweep.direction == direction;
      };
      while (at < sweeps.size() && !fits(sweeps[at])) ++at;
      while (at >= sweeps.size()) sweeps.push_back({direction, {}});
      sweeps[at].steps.push_back(step);
      sweep_of[step] = at;
    }
    Plan plan;
    plan.sweeps = std::move(sweeps);
    for (const Sweep& sweep : plan.sweeps)
      for (const Step* step : sweep.steps)
        plan.why.push_back(fmt::format("sweep {} ({}): {} gives {}",
                                       &sweep - plan.sweeps.data() + 1, to_string(sweep.direction),
                                       step->name, why_.at(step)));
    return plan;
  }

  // The list's own order, but for steps whose givers come later in it.
  std::vector<const Step*> givers_first() {
    std::sort(taken_.begin(), taken_.end());
    std::vector<const Step*> sorted;
    std::unordered_set<const Step*> placed;
    while (sorted.size() < taken_.size()) {
      const auto next = std::find_if(taken_.begin(), taken_.end(), [&](const Step* step) {
        const std::vector<const Step*> before = givers(*step);
        return !placed.contains(step) &&
               std::all_of(before.begin(), before.end(),
                           [&](const Step* giver) { return placed.contains(giver); });
      });
      if (next == taken_.end())
        throw std::logic_error("the planner took steps that need each other");
      placed.insert(*next);
      sorted.push_back(*next);
    }
    return sorted;
  }

  std::vector<const Step*> givers(const Step& step) {
    std::vector<std::string> slots = step.needs;
    const std::vector<std::string>& used = used_[&step];
    slots.insert(slots.end(), used.begin(), used.end());
    std::vector<const Step*> found;
    for (const std::string& slot : slots)
      for (const Step* other : taken_)
        if (other != &step && !given_.contains(slot) && contains(other->gives, slot))
          found.push_back(other);
    return found;
  }

  std::span<const Step> steps_;
  std::unordered_set<std::string> given_, made_, in_progress_;
  std::set<std::string> unknown_;  // that no step and no driver gives
  std::vector<const Step*> taken_;
  std::unordered_map<const Step*, std::string> why_;
  std::unordered_map<const Step*, std::vector<std::string>> used_;
};

}  // namespace

Plan make_plan(std::span<const Step> steps, std::span<const Wish> wishes,
               std::span<const std::string> given, Report& report) {
  return Planner(steps, given).plan(wishes, report);
}

void check_sweeps(std::span<const Sweep> sweeps, std::span<const std::string> given,
                  std::string_view configuration, Report& report) {
  std::unordered_set<std::string> there(given.begin(), given.end());
  for (const Sweep& sweep : sweeps)
    for (const Step* step : sweep.steps) {
      if (step->direction != Direction::kLocal && step->direction != sweep.direction)
        report.error({}, std::string(configuration),
                     fmt::format("step {} goes {} in a sweep that goes {}", step->name,
                                 to_string(step->direction), to_string(sweep.direction)),
                     "put it into a sweep of its direction");
      for (const std::string& need : step->needs)
        if (!there.contains(need))
          report.error(
              {}, std::string(configuration),
              fmt::format("step {} needs {}, which nothing before it gives", step->name, need),
              "put a step that gives it before this one, or give it");
      there.insert(step->gives.begin(), step->gives.end());
    }
}

}  // namespace sinew::synthesis
