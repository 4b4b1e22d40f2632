#include "sinew/data/program.h"

#include <fmt/format.h>

#include <map>
#include <optional>

namespace sinew::data {
namespace {

using Kind = PlanStep::Kind;
using Node = ScalarGraph::Node;

// A number in SI units, as scale * node + offset, not computed before it is needed.
struct Value {
  Node node = 0;
  double scale = 1, offset = 0;
};

class Lowering {
 public:
  Lowering(const Library& library, const Plan& plan) : library_(library) {
    program_.blocks = {{"source", library.prototypes[plan.source].owner},
                       {"target", library.prototypes[plan.target].owner}};
    for (const Index relation : inputs_of(library, plan)) {
      input_blocks_[relation] = program_.blocks.size();
      const Relation& it = library.relations[relation];
      program_.blocks.push_back({identifier(it.frame + "_in_" + it.reference), it.prototype});
      ++program_.inputs;
    }
    program_.stages.emplace_back();
    for (std::size_t i = 0; i < plan.relations.size(); ++i) {
      relation_plans_[plan.relations[i]] = &plan.relation_plans[i];
    }
    State state;
    state.block = 0;
    state.prototype = plan.source;
    run(plan, state, plan.target);
  }
  ConversionProgram take() { return std::move(program_); }

 private:
  // Where the value is: in a space, slot by slot, or in a block.
  struct State {
    std::vector<Value> values;
    std::optional<Index> space;
    Index block = 0;
    Index prototype = 0;
    const Relation* constant = nullptr;  // whose numbers are read, instead of a block
  };

  static std::string identifier(std::string name) {
    for (char& c : name) c = c == '.' || c == '-' ? '_' : c;
    return name;
  }

  void run(const Plan& plan, State& state, std::optional<Index> final_target) {
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      const PlanStep& step = plan.steps[i];
      const bool last = final_target && i + 1 == plan.steps.size();
      switch (step.kind) {
        case Kind::kRead:
          if (state.space != step.to) read(state, step.which);
          break;
        case Kind::kWrite: {
          // A function of coordinates works on the values; nothing has to be put into memory for
          // it.
          const bool for_coordinates =
              !last && i + 1 < plan.steps.size() && plan.steps[i + 1].kind == Kind::kFunction &&
              is_of_coordinates(plan.steps[i + 1]) &&
              library_.prototypes[step.to].bindings.front().space == step.from;
          if (!for_coordinates) write(state, step.to, step.which, last ? 1 : new_block(step.to));
          state.prototype = step.to;
          break;
        }
        case Kind::kFormula:
          apply_formula(state, step.which);
          break;
        case Kind::kMembers:
          run_members(state, step);
          break;
        case Kind::kApart:
          take_apart(state, step);
          break;
        case Kind::kTogether:
          put_together(state, step);
          break;
        case Kind::kChange:
          change(state, step);
          break;
        case Kind::kFunction:
          if (is_of_coordinates(step)) {
            apply_coordinates(state, step);
            if (last) write(state, step.to, 0, 1);
          } else {
            call(state, step, last ? 1 : new_block(step.to));
          }
          break;
      }
    }
  }

  bool is_of_coordinates(const PlanStep& step) const {
    return library_.functions[library_.function_edges[step.which].function].context ==
           "coordinates";
  }

  Index new_block(Index prototype) {
    const std::string name = identifier(library_.prototypes[prototype].name);
    program_.blocks.push_back({fmt::format("{}_{}", name, program_.blocks.size()), prototype});
    return program_.blocks.size() - 1;
  }

  void read(State& state, Index binding_index) {
    const Binding& binding = library_.prototypes[state.prototype].bindings[binding_index];
    const Space& space = library_.spaces[binding.space];
    state.values.assign(space.slots.size(), {});
    for (std::size_t i = 0; i < space.slots.size(); ++i) {
      if (space.slots[i].constant)
        state.values[i].node = program_.graph.constant(*space.slots[i].constant);
    }
    for (const SlotBinding& slot : binding.slots) {
      const Node number =
          state.constant ? program_.graph.constant(state.constant->values.at(slot.access.source))
                         : load(state.block, slot.access, space.slots[slot.slot].name);
      state.values[slot.slot] = {number, slot.scale, slot.offset};
    }
    state.space = binding.space;
  }

  Node load(Index block, const Access& access, const std::string& label) {
    for (std::size_t i = 0; i < program_.loads.size(); ++i) {
      const auto& known = program_.loads[i];
      if (known.block == block && known.access.source == access.source) {
        return program_.graph.input(static_cast<std::uint32_t>(i));
      }
    }
    program_.loads.push_back({block, access, label});
    return program_.graph.input(static_cast<std::uint32_t>(program_.loads.size() - 1));
  }

  Node affine(Node node, double scale, double offset) {
    auto& graph = program_.graph;
    node = graph.apply(ScalarOperation::kMultiply, node, graph.constant(scale));
    return graph.apply(ScalarOperation::kAdd, node, graph.constant(offset));
  }

  void write(State& state, Index prototype_index, Index binding_index, Index block) {
    const Prototype& prototype = library_.prototypes[prototype_index];
    const Binding& binding = prototype.bindings[binding_index];
    auto& stores = program_.stages.back().stores;
    for (const SlotBinding& slot : binding.slots) {
      const Value& value = state.values[slot.slot];
      stores.push_back({block, slot.access,
                        affine(value.node, value.scale / slot.scale,
                               (value.offset - slot.offset) / slot.scale)});
    }
    for (const ConstantWrite& constant : prototype.constants) {
      stores.push_back({block, constant.access, program_.graph.constant(constant.value)});
    }
    state.space.reset();
    state.block = block;
    state.prototype = prototype_index;
  }

  void apply_formula(State& state, Index edge_index) {
    const FormulaEdge& edge = library_.formula_edges[edge_index];
    const Formula& formula = library_.formulas[edge.formula].formula;
    std::vector<Node> inputs;
    for (const Value& value : state.values)
      inputs.push_back(affine(value.node, value.scale, value.offset));
    const Space& space = library_.spaces[edge.to];
    state.values.clear();
    for (const Node node : apply(formula, inputs, space.slots))
      state.values.push_back({node, 1, 0});
    state.space = edge.to;
  }

  void apply_coordinates(State& state, const PlanStep& step) {
    if (!state.space) read(state, 0);
    for (const Index edge : library_.function_edges[step.which].formulas)
      apply_formula(state, edge);
    state.prototype = step.to;
  }

  void run_members(State& state, const PlanStep& step) {
    const Space& from = library_.spaces[step.from];
    std::vector<Value> result;
    std::size_t first = 0;
    for (std::size_t m = 0; m < step.members.size(); ++m) {
      const std::size_t count = library_.spaces[from.members[m].second].slots.size();
      State part;
      part.values.assign(state.values.begin() + static_cast<std::ptrdiff_t>(first),
                         state.values.begin() + static_cast<std::ptrdiff_t>(first + count));
      part.space = from.members[m].second;
      run(step.members[m], part, std::nullopt);
      result.insert(result.end(), part.values.begin(), part.values.end());
      first += count;
    }
    state.values = std::move(result);
    state.space = step.to;
  }

  // ---- parts that functions reach ----

  void take_apart(State& state, const PlanStep& step) {
    const auto& members = library_.prototypes[step.from].members;
    std::vector<Value> result;
    for (std::size_t m = 0; m < step.members.size(); ++m) {
      State part;
      part.block = state.block;
      part.prototype = members[m].second;
      run(step.members[m], part, std::nullopt);
      result.insert(result.end(), part.values.begin(), part.values.end());
    }
    state.values = std::move(result);
    state.space = step.to;
  }

  void put_together(State& state, const PlanStep& step) {
    const Space& from = library_.spaces[step.from];
    const Prototype& whole = library_.prototypes[step.to];
    for (const ConstantWrite& constant : whole.constants) {
      program_.stages.back().stores.push_back(
          {1, constant.access, program_.graph.constant(constant.value)});
    }
    std::size_t first = 0;
    for (std::size_t m = 0; m < step.members.size(); ++m) {
      const std::size_t count = library_.spaces[from.members[m].second].slots.size();
      State part;
      part.values.assign(state.values.begin() + static_cast<std::ptrdiff_t>(first),
                         state.values.begin() + static_cast<std::ptrdiff_t>(first + count));
      part.space = from.members[m].second;
      run(step.members[m], part, whole.members[m].second);
      first += count;
    }
    state.space.reset();
    state.block = 1;
    state.prototype = step.to;
  }

  // ---- changes of conventions ----

  // A formula's results in the order of the slots, those that are constant among them.
  std::vector<Node> apply(const Formula& formula, const std::vector<Node>& inputs,
                          const std::vector<Space::Slot>& slots) {
    const std::vector<Node> places = program_.graph.append(formula.graph, inputs);
    std::vector<Node> results;
    std::size_t next = 0;
    for (const Space::Slot& slot : slots) {
      results.push_back(slot.constant ? program_.graph.constant(*slot.constant)
                                      : places[formula.outputs[next++]]);
    }
    return results;
  }

  const std::vector<Node>& relation(Index index) {
    const auto [known, added] = relation_nodes_.try_emplace(index);
    if (!added) return known->second;
    const Relation& it = library_.relations[index];
    State state;
    state.prototype = it.prototype;
    if (it.constant) {
      state.constant = &it;
    } else {
      state.block = input_blocks_.at(index);
    }
    run(*relation_plans_.at(index), state, std::nullopt);
    for (const Value& value : state.values) {
      known->second.push_back(affine(value.node, value.scale, value.offset));
    }
    return known->second;
  }

  // The relation of the chain's first frame to its last: X_AC = X_AB X_BC.
  std::vector<Node> chain(const RelationRule& rule, const std::vector<RelationLink>& links) {
    std::vector<Node> whole;
    for (const RelationLink& link : links) {
      std::vector<Node> next = relation(link.relation);
      if (link.inverse) next = apply(rule.inverse, next, rule.slots);
      if (!whole.empty()) {
        next.insert(next.end(), whole.begin(), whole.end());
        next = apply(rule.product, next, rule.slots);
      }
      whole = std::move(next);
    }
    return whole.empty() ? apply(rule.identity, {}, rule.slots) : whole;
  }

  void change(State& state, const PlanStep& step) {
    const Space& space = library_.spaces[step.from];
    for (const ConventionStep& it : step.changes) {
      const ConventionChange& change =
          library_.changes.at({space.domain, space.semantic, space.coordinates, it.convention});
      std::vector<Node> inputs;
      for (const Value& value : state.values) {
        inputs.push_back(affine(value.node, value.scale, value.offset));
      }
      for (const auto& links : it.inputs) {
        const auto nodes = chain(library_.relation_rules.at(space.domain), links);
        inputs.insert(inputs.end(), nodes.begin(), nodes.end());
      }
      state.values.clear();
      for (const Node node : apply(change.formula, inputs, space.slots)) {
        state.values.push_back({node, 1, 0});
      }
    }
    state.space = step.to;
  }

  void call(State& state, const PlanStep& step, Index target_block) {
    const FunctionEdge& edge = library_.function_edges[step.which];
    const Function& function = library_.functions[edge.function];
    ConversionProgram::Call call{edge.function, {}};
    for (const Function::Argument& argument : function.arguments) {
      call.blocks.push_back(argument.input ? state.block : target_block);
    }
    program_.stages.back().calls.push_back(std::move(call));
    program_.stages.emplace_back();
    state.space.reset();
    state.block = target_block;
    state.prototype = step.to;
  }

  const Library& library_;
  ConversionProgram program_;
  std::map<Index, Index> input_blocks_;          // by relation
  std::map<Index, const Plan*> relation_plans_;  // likewise
  std::map<Index, std::vector<Node>> relation_nodes_;
};

}  // namespace

int ConversionProgram::operations() const {
  std::vector<ScalarGraph::Node> needed;
  int count = 0;
  for (const Stage& stage : stages) {
    for (const Store& store : stage.stores) needed.push_back(store.value);
    count += static_cast<int>(stage.stores.size() + stage.calls.size());
  }
  const std::vector<bool> live = graph.live(needed);
  for (std::size_t i = 0; i < live.size(); ++i) {
    if (live[i] && graph.nodes()[i].operation != ScalarOperation::kConstant) ++count;
  }
  return count;
}

ConversionProgram lower(const Library& library, const Plan& plan) {
  return Lowering(library, plan).take();
}

}  // namespace sinew::data
