// Walking the graph step by step, in the manner of Gremlin (Apache TinkerPop): agents start at a
// node, every step moves, splits or drops them, and what arrives at the end is the result.
//
//   // The pose between a joint's frame and the frame of the body before the joint.
//   const auto pose = Traversal<>().as("joint").out(my_frame).in(target).as("pose")
//                         .out(reference).in(my_frame).in(predecessor).where(equals("joint"))
//                         .select("pose");
//   std::vector<Id> found = pose.ids(view, joint);
//
// A traversal is a value: made once, run on any view from any node, and used inside others
// (`where`, `repeat`). Domain commands are functions that return one, or run one. An agent may
// carry a value of type Carried that is composed along the way (say, a pose), see `carry`.
//
// Agents go depth first, in the order in which triples were added. There is no recursion; every
// agent's moves, also those of `where`, count against TraversalLimits, beyond which the run throws
// Error.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

#include "sinew/graph/traversal_trail.h"
#include "sinew/graph/view.h"

namespace sinew::graph {

inline constexpr std::uint32_t kMaxRepeats = 10'000;
inline constexpr std::uint64_t kMaxMoves = 10'000'000;

struct TraversalLimits {
  std::uint32_t repeats = kMaxRepeats;  // rounds of one `repeat`
  std::uint64_t moves = kMaxMoves;      // steps taken by all agents together
};

// For `where`: the agent is, or is not, at the node that was labelled.
struct Equals {
  std::string label;
};
struct Differs {
  std::string label;
};
inline Equals equals(std::string label) { return {std::move(label)}; }
inline Differs differs(std::string label) { return {std::move(label)}; }

template <typename Carried = std::monostate>
class Traversal {
 public:
  // What functions at a step see of the agent that is there. Valid during the call.
  class Agent {
   public:
    Id node() const { return state_.node; }
    const View& view() const { return view_; }
    // The node that was last labelled so; throws Error when none was.
    Id labelled(std::string_view label) const { return trail_.labelled(state_.labels, label); }
    // Every node on the way, from the start to here.
    std::vector<Id> path() const { return trail_.path(state_.path); }
    std::uint32_t repeats() const { return trail_.repeats(state_.loop); }
    Carried carried;

   private:
    friend class Traversal;
    Agent(const View& view, const TraversalTrail& trail, AgentState state, Carried value)
        : carried(std::move(value)), view_(view), trail_(trail), state_(state) {}
    const View& view_;
    const TraversalTrail& trail_;
    AgentState state_;
  };
  using Predicate = std::function<bool(const Agent&)>;

  // ---- moving: along the predicate, or any where it is 0 ----
  Traversal& out(Id predicate = {}) { return add({.op = Op::kOut, .predicate = predicate}); }
  Traversal& in(Id predicate = {}) { return add({.op = Op::kIn, .predicate = predicate}); }
  Traversal& both(Id predicate = {}) { return add({.op = Op::kBoth, .predicate = predicate}); }
  // Back to the node that was labelled.
  Traversal& select(std::string label) {
    return add({.op = Op::kSelect, .label = std::move(label)});
  }

  // ---- keeping or dropping ----
  Traversal& has(Id predicate, Id object = {}) {
    return add({.op = Op::kHas, .predicate = predicate, .object = object});
  }
  Traversal& has_not(Id predicate, Id object = {}) {
    return add({.op = Op::kHasNot, .predicate = predicate, .object = object});
  }
  Traversal& is(Id node) { return add({.op = Op::kIs, .object = node}); }
  Traversal& where(Equals at) { return add({.op = Op::kEquals, .label = std::move(at.label)}); }
  Traversal& where(Differs from) {
    return add({.op = Op::kDiffers, .label = std::move(from.label)});
  }
  // Keeps the agent if the other traversal, started from it, arrives anywhere.
  Traversal& where(Traversal other) { return add({.op = Op::kWhere, .inner = share(other)}); }
  Traversal& where_not(Traversal other) {
    return add({.op = Op::kWhereNot, .inner = share(other)});
  }
  Traversal& where(Predicate keep) { return add({.op = Op::kFilter, .keep = std::move(keep)}); }
  Traversal& simple_path() {
    return add({.op = Op::kSimplePath});
  }                                                       // drops who comes back to a node
  Traversal& dedup() { return add({.op = Op::kDedup}); }  // drops who comes to a node later

  // ---- remembering and computing ----
  Traversal& as(std::string label) { return add({.op = Op::kAs, .label = std::move(label)}); }
  Traversal& side_effect(std::function<void(const Agent&)> call) {
    return add({.op = Op::kCall, .call = [call = std::move(call)](Agent& agent) { call(agent); }});
  }
  // May change agent.carried.
  Traversal& carry(std::function<void(Agent&)> call) {
    return add({.op = Op::kCall, .call = std::move(call)});
  }

  // ---- repeating: the body at least once, then again until something says stop ----
  Traversal& repeat(Traversal body) {
    add({.op = Op::kLoopBegin});
    const auto begin = static_cast<std::uint32_t>(steps_.size());
    for (Step& step : body.steps_) {
      if (step.op == Op::kLoopEnd) step.begin += begin;
      add(std::move(step));
    }
    return add({.op = Op::kLoopEnd, .begin = begin});
  }
  // These three belong to the `repeat` just before; throw Error where there is none. Without
  // `until` and `times`, agents go on until they find no way on.
  Traversal& until(Predicate stop) { return loop_end().keep = std::move(stop), *this; }
  Traversal& until(Traversal stop) { return loop_end().inner = share(stop), *this; }
  Traversal& times(std::uint32_t rounds) { return loop_end().times = rounds, *this; }
  Traversal& emit() { return loop_end().emit = true, *this; }  // every round's end is a result, too

  // ---- running ----
  // Calls visit(const Agent&) for each agent that arrives, until it returns false. Returns false if
  // it was stopped.
  template <typename Visit>
  bool run(const View& view, std::span<const Id> starts, Visit&& visit, Carried carried = {},
           TraversalLimits limits = {}) const;
  template <typename Visit>
  bool run(const View& view, Id start, Visit&& visit, Carried carried = {},
           TraversalLimits limits = {}) const {
    return run(view, std::span<const Id>(&start, 1), visit, std::move(carried), limits);
  }
  std::vector<Id> ids(const View& view, Id start) const {
    std::vector<Id> found;
    run(view, start, [&](const Agent& agent) { return found.push_back(agent.node()), true; });
    return found;
  }
  Id first(const View& view, Id start) const {
    Id found;
    run(view, start, [&](const Agent& agent) { return found = agent.node(), false; });
    return found;
  }
  std::vector<std::vector<Id>> paths(const View& view, Id start) const {
    std::vector<std::vector<Id>> found;
    run(view, start, [&](const Agent& agent) { return found.push_back(agent.path()), true; });
    return found;
  }
  // combine(result so far, agent) for each agent that arrives.
  template <typename Result, typename Combine>
  Result fold(const View& view, Id start, Result result, Combine&& combine) const {
    run(view, start, [&](const Agent& agent) {
      result = combine(std::move(result), agent);
      return true;
    });
    return result;
  }

 private:
  enum class Op : std::uint8_t {
    kOut,
    kIn,
    kBoth,
    kSelect,
    kHas,
    kHasNot,
    kIs,
    kEquals,
    kDiffers,
    kWhere,
    kWhereNot,
    kFilter,
    kSimplePath,
    kDedup,
    kAs,
    kCall,
    kLoopBegin,
    kLoopEnd
  };
  struct Step {
    Op op;
    Id predicate = {}, object = {};
    std::string label = {};
    Predicate keep = {};
    std::function<void(Agent&)> call = {};
    std::shared_ptr<const Traversal> inner = {};
    std::uint32_t begin = 0, times = 0;  // of kLoopEnd; times 0 is any number
    bool emit = false;
  };
  struct Walker {
    AgentState state;
    Carried carried;
  };
  struct Run;

  Traversal& add(Step step) {
    steps_.push_back(std::move(step));
    return *this;
  }
  Step& loop_end() {
    if (steps_.empty() || steps_.back().op != Op::kLoopEnd) throw_no_repeat();
    return steps_.back();
  }
  static std::shared_ptr<const Traversal> share(Traversal& other) {
    return std::make_shared<const Traversal>(std::move(other));
  }

  std::vector<Step> steps_;
};

// ---- implementation ----

template <typename Carried>
struct Traversal<Carried>::Run {
  const View& view;
  TraversalLimits limits;
  TraversalTrail trail = {};
  std::uint64_t moves = 0;

  // Agents that wait, the next one last.
  using Waiting = std::vector<Walker>;

  template <typename Visit>
  bool run(const Traversal& traversal, Walker start, Visit&& visit) {
    std::vector<std::unordered_set<Id>> seen(traversal.steps_.size());
    Waiting waiting;
    waiting.push_back(std::move(start));
    while (!waiting.empty()) {
      Walker walker = std::move(waiting.back());
      waiting.pop_back();
      if (++moves > limits.moves) throw_too_many_moves(limits.moves);
      if (walker.state.step == traversal.steps_.size()) {
        if (!visit(agent(walker))) return false;
        continue;
      }
      const Step& step = traversal.steps_[walker.state.step++];
      take(step, walker, waiting, seen[walker.state.step - 1]);
    }
    return true;
  }

  Agent agent(const Walker& walker) const {
    return Agent(view, trail, walker.state, walker.carried);
  }

  bool arrives(const Traversal& other, const Walker& walker) {
    Walker start = walker;
    start.state.step = 0;
    return !run(other, std::move(start), [](const Agent&) { return false; });
  }

  void move(const Walker& walker, Id predicate, bool outward, Waiting& waiting) {
    const Id here = walker.state.node;
    view.match(outward ? here : Id{}, predicate, outward ? Id{} : here, Dataset::kUnion,
               [&](const Quad& quad) {
                 waiting.push_back(walker);
                 AgentState& state = waiting.back().state;
                 state.node = outward ? quad.object : quad.subject;
                 state.path = trail.extend(state.path, state.node);
                 return true;
               });
  }

  void take(const Step& step, Walker& walker, Waiting& waiting, std::unordered_set<Id>& seen) {
    AgentState& state = walker.state;
    const std::size_t before = waiting.size();
    const auto keep_if = [&](bool keep) {
      if (keep) waiting.push_back(std::move(walker));
    };
    switch (step.op) {
      case Op::kOut:
      case Op::kIn:
      case Op::kBoth:
        if (step.op != Op::kIn) move(walker, step.predicate, true, waiting);
        if (step.op != Op::kOut) move(walker, step.predicate, false, waiting);
        std::reverse(waiting.begin() + static_cast<std::ptrdiff_t>(before), waiting.end());
        break;
      case Op::kSelect:
        state.node = trail.labelled(state.labels, step.label);
        state.path = trail.extend(state.path, state.node);
        keep_if(true);
        break;
      case Op::kHas:
      case Op::kHasNot:
        keep_if(view.contains(state.node, step.predicate, step.object) == (step.op == Op::kHas));
        break;
      case Op::kIs:
        keep_if(state.node == step.object);
        break;
      case Op::kEquals:
      case Op::kDiffers:
        keep_if((trail.labelled(state.labels, step.label) == state.node) ==
                (step.op == Op::kEquals));
        break;
      case Op::kWhere:
      case Op::kWhereNot:
        keep_if(arrives(*step.inner, walker) == (step.op == Op::kWhere));
        break;
      case Op::kFilter:
        keep_if(step.keep(agent(walker)));
        break;
      case Op::kSimplePath:
        keep_if(trail.is_simple(state.path));
        break;
      case Op::kDedup:
        keep_if(seen.insert(state.node).second);
        break;
      case Op::kAs:
        state.labels = trail.label(state.labels, step.label, state.node);
        keep_if(true);
        break;
      case Op::kCall: {
        Agent here = agent(walker);
        step.call(here);
        walker.carried = std::move(here.carried);
        keep_if(true);
        break;
      }
      case Op::kLoopBegin:
        state.loop = trail.begin_loop(state.loop);
        keep_if(true);
        break;
      case Op::kLoopEnd:
        end_round(step, walker, waiting);
        break;
    }
  }

  void end_round(const Step& step, Walker& walker, Waiting& waiting) {
    const std::uint32_t round = trail.repeats(walker.state.loop) + 1;
    walker.state.loop = trail.next_round(walker.state.loop);
    const bool stop = (step.times > 0 && round >= step.times) ||
                      (step.keep && step.keep(agent(walker))) ||
                      (step.inner && arrives(*step.inner, walker));
    if (!stop) {
      if (round >= limits.repeats) throw_too_many_repeats(limits.repeats, view, walker.state.node);
      waiting.push_back(walker);
      waiting.back().state.step = step.begin;
    }
    if (stop || step.emit) {
      walker.state.loop = trail.end_loop(walker.state.loop);
      waiting.push_back(std::move(walker));
    }
  }
};

template <typename Carried>
template <typename Visit>
bool Traversal<Carried>::run(const View& view, std::span<const Id> starts, Visit&& visit,
                             Carried carried, TraversalLimits limits) const {
  Run run{view, limits};
  for (const Id start : starts) {
    AgentState state;
    state.node = start;
    state.path = run.trail.extend(0, start);
    if (!run.run(*this, {state, carried}, visit)) return false;
  }
  return true;
}

}  // namespace sinew::graph
