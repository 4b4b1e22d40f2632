// From the straight-line program to operations and registers.
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "sinew/data/engine.h"
#include "sinew/data/engine_code.h"

namespace sinew::data {

class ConverterBuilder {
 public:
  ConverterBuilder(const Library& library, const Plan& plan, const EngineOptions& options)
      : library_(library), plan_(plan), options_(options) {
    program_ = lower(library, plan, [&](Index formula) { return find_kernel(formula) != nullptr; });
  }

  Converter build() {
    place_blocks();
    number_constants();
    add_guards();
    for (const auto& stage : program_.stages) {
      // Everything is computed before anything is stored: source and target may be the same memory.
      for (const auto& store : stage.stores) {
        if (!moves_directly(store)) compute(store.value);
      }
      for (const auto& store : stage.stores) {
        if (!stored_.count(&store)) add_store(store);
      }
      for (const auto& call : stage.calls) add_call(call);
    }
    add({Code::kEnd, 0, 0, 0, 0, 0, 0});
    gather(Code::kLoadDouble, Code::kLoadDoubles);
    gather(Code::kStoreDouble, Code::kStoreDoubles);
    return std::move(result_);
  }

 private:
  using Code = Converter::Code;
  using Operation = Converter::Operation;
  using Node = ScalarGraph::Node;
  using Op = ScalarOperation;

  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    const Prototype& prototype = library_.prototypes[plan_.source];
    throw Error(Problem{prototype.place, prototype.name, what, remedy, Severity::kError, {}});
  }

  Kernel find_kernel(Index formula) const {
    if (options_.kernels.empty()) return nullptr;
    const std::uint64_t wanted = fingerprint(library_.formulas[formula].formula);
    for (const KernelEntry& entry : options_.kernels) {
      if (entry.fingerprint == wanted) return entry.function;
    }
    return nullptr;
  }

  const Type& type_of(Index block) const {
    return *library_.prototypes[program_.blocks[block].prototype].representation.type;
  }

  void place_blocks() {
    if (program_.blocks.size() > kMaximumBlocks) {
      fail(fmt::format("the conversion needs {} blocks of memory", program_.blocks.size()),
           fmt::format("at most {} are possible", kMaximumBlocks));
    }
    std::size_t used = 0;
    for (Index block = 2; block < program_.blocks.size(); ++block) {
      const std::size_t alignment = std::max<std::size_t>(type_of(block).alignment, 16);
      used = (used + alignment - 1) / alignment * alignment;
      result_.scratch_.push_back(used);
      used += type_of(block).size;
    }
    if (used > kMaximumScratch) {
      fail(fmt::format("the conversion needs {} bytes for intermediate values", used),
           fmt::format("at most {} are possible", kMaximumScratch));
    }
    for (Index block = 0; block < program_.blocks.size(); ++block) {
      const Prototype& prototype = library_.prototypes[program_.blocks[block].prototype];
      if (prototype.representation.context != "JSON") continue;
      fail(fmt::format("'{}' is JSON, which has no fixed place in memory", prototype.name),
           "emit source code (--emit cpp)");
    }
  }

  std::uint16_t new_register(std::size_t count = 1) {
    if (next_register_ + count > kMaximumRegisters) {
      fail(fmt::format("the conversion needs more than {} numbers at once", kMaximumRegisters),
           "emit source code instead");
    }
    const auto first = static_cast<std::uint16_t>(next_register_);
    next_register_ += count;
    return first;
  }

  void number_constants() {
    const auto& nodes = program_.graph.nodes();
    std::vector<Node> needed;
    for (const auto& stage : program_.stages) {
      for (const auto& store : stage.stores) needed.push_back(store.value);
    }
    for (const auto& use : program_.formula_uses) {
      needed.insert(needed.end(), use.inputs.begin(), use.inputs.end());
    }
    const std::vector<bool> live = program_.graph.live(needed);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].operation != Op::kConstant || !live[i]) continue;
      registers_[static_cast<Node>(i)] = new_register();
      result_.constants_.push_back(nodes[i].value);
    }
  }

  void add(const Operation& operation) { result_.operations_.push_back(operation); }

  void add_guards() {
    const auto guard = [&](Index block, const Access& access) {
      for (const Access::Guard& it : access.guards) {
        const bool known =
            std::any_of(result_.guards_.begin(), result_.guards_.end(), [&](const auto& other) {
              return other.block == block && other.offsets == it.offsets && other.index >= it.index;
            });
        if (known) continue;
        result_.guards_.push_back(
            {block, it.kind == Type::Kind::kList, it.offsets, it.element_size, it.index});
        add({Code::kGuard, 0, 0, 0, 0, static_cast<std::uint32_t>(result_.guards_.size() - 1), 0});
      }
    };
    for (const auto& load : program_.loads) {
      if (load.block != ConversionProgram::Load::kOfFormula) guard(load.block, load.access);
    }
    for (const auto& stage : program_.stages) {
      for (const auto& store : stage.stores) guard(store.block, store.access);
    }
  }

  // What lies behind one step from the block's begin, as a number of bytes.
  static bool is_direct(const Access& access) { return access.offsets.size() == 1; }
  std::uint32_t path(const Access& access) {
    result_.paths_.push_back({access.offsets});
    return static_cast<std::uint32_t>(result_.paths_.size() - 1);
  }

  // A double that is only copied, between different blocks, is one operation.
  bool moves_directly(const ConversionProgram::Store& store) const {
    const ScalarNode& node = program_.graph.nodes()[store.value];
    if (node.operation != Op::kInput) return false;
    const auto& load = program_.loads[node.a];
    return load.block != ConversionProgram::Load::kOfFormula && load.block != store.block &&
           is_direct(load.access) && is_direct(store.access) &&
           load.access.scalar == ScalarKind::kFloat64 &&
           store.access.scalar == ScalarKind::kFloat64 && plan_.source != plan_.target;
  }

  void compute(Node wanted) {
    std::vector<std::pair<Node, bool>> stack = {{wanted, false}};
    while (!stack.empty()) {
      const auto [at, ready] = stack.back();
      stack.pop_back();
      if (registers_.count(at)) continue;
      const ScalarNode& node = program_.graph.nodes()[at];
      if (node.operation == Op::kInput) {
        add_load(at, program_.loads[node.a], stack, ready);
        continue;
      }
      if (!ready) {
        stack.push_back({at, true});
        const int operands = row(node.operation).operands;
        if (operands > 2) stack.push_back({node.c, false});
        if (operands > 1) stack.push_back({node.b, false});
        stack.push_back({node.a, false});
        continue;
      }
      add_arithmetic(at, node);
    }
  }

  void add_load(Node at, const ConversionProgram::Load& load,
                std::vector<std::pair<Node, bool>>& stack, bool ready) {
    if (load.block == ConversionProgram::Load::kOfFormula) {
      const auto& use = program_.formula_uses[load.formula_use];
      const auto done = formula_results_.find(load.formula_use);
      if (done == formula_results_.end() && !ready) {
        stack.push_back({at, true});
        for (const Node input : use.inputs) {
          if (!shared_block(use.inputs)) stack.push_back({input, false});
        }
        return;
      }
      if (done == formula_results_.end()) add_kernel(load.formula_use, use);
      registers_[at] = static_cast<std::uint16_t>(formula_results_[load.formula_use] + load.output);
      return;
    }
    const std::uint16_t result = new_register();
    registers_[at] = result;
    emit_load(load, result);
  }

  void emit_load(const ConversionProgram::Load& load, std::uint16_t result) {
    const auto kind = static_cast<std::uint8_t>(load.access.scalar);
    const auto block = static_cast<std::uint16_t>(load.block);
    if (!is_direct(load.access)) {
      add({Code::kLoadPath, kind, block, 0, result, path(load.access), 0});
    } else {
      add({load.access.scalar == ScalarKind::kFloat64 ? Code::kLoadDouble : Code::kLoad, kind,
           block, 0, result, static_cast<std::uint32_t>(load.access.offsets[0]), 0});
    }
  }

  bool in_memory(Node node) const {
    const ScalarNode& it = program_.graph.nodes()[node];
    return it.operation == Op::kInput &&
           program_.loads[it.a].block != ConversionProgram::Load::kOfFormula;
  }

  // Several loads (or stores) of one block in a row become one operation.
  void gather(Code one, Code several) {
    std::vector<Operation> result;
    auto& operations = result_.operations_;
    for (std::size_t i = 0; i < operations.size();) {
      std::size_t end = i;
      while (end < operations.size() && operations[end].code == one &&
             operations[end].a == operations[i].a)
        ++end;
      if (end - i < 2) {
        result.push_back(operations[i++]);
        continue;
      }
      const auto first = static_cast<std::uint32_t>(result_.places_.size());
      for (; i < end; ++i) result_.places_.push_back({operations[i].x, operations[i].c});
      result.push_back({several, 0, operations[end - 1].a, 0, 0, first,
                        static_cast<std::uint32_t>(result_.places_.size())});
    }
    operations = std::move(result);
  }

  // A kernel reads and writes a value's memory itself where its numbers are doubles there, all in
  // one block; otherwise registers.
  void add_kernel(Index use_index, const ConversionProgram::FormulaUse& use) {
    const Formula& formula = library_.formulas[use.formula].formula;
    Converter::KernelCall call;
    call.function = find_kernel(use.formula);
    call.from = result_.offsets_.size();
    const auto block = shared_block(use.inputs);
    for (const Node input : use.inputs) {
      if (block) {
        const auto& load = program_.loads[program_.graph.nodes()[input].a];
        result_.offsets_.push_back(static_cast<std::uint32_t>(load.access.offsets[0]));
        continue;
      }
      compute(input);
      result_.offsets_.push_back(static_cast<std::uint32_t>(registers_.at(input) * sizeof(double)));
    }
    if (block) call.inputs = *block;
    call.to = result_.offsets_.size();
    const auto stores = direct_stores(use_index, formula.outputs.size());
    if (stores.empty()) {
      const std::uint16_t first = new_register(formula.outputs.size());
      formula_results_[use_index] = first;
      for (std::size_t i = 0; i < formula.outputs.size(); ++i) {
        result_.offsets_.push_back(static_cast<std::uint32_t>((first + i) * sizeof(double)));
      }
    } else {
      call.outputs = stores.front()->block;
      formula_results_[use_index] = 0;  // nobody asks for its registers
      for (const auto* store : stores) {
        result_.offsets_.push_back(static_cast<std::uint32_t>(store->access.offsets[0]));
        stored_.insert(store);
      }
    }
    result_.kernels_.push_back(call);
    add({Code::kKernel, 0, 0, 0, 0, static_cast<std::uint32_t>(result_.kernels_.size() - 1), 0});
  }

  static bool is_plain_double(const Access& access) {
    return is_direct(access) && access.scalar == ScalarKind::kFloat64;
  }

  // The block where all of these lie as doubles; nothing where they do not, or have registers
  // already.
  std::optional<Index> shared_block(const std::vector<Node>& inputs) const {
    std::optional<Index> block;
    for (const Node input : inputs) {
      if (!in_memory(input)) return std::nullopt;
      const auto& load = program_.loads[program_.graph.nodes()[input].a];
      if (!is_plain_double(load.access) || (block && *block != load.block)) return std::nullopt;
      block = load.block;
    }
    return block;
  }

  // Where every output of a formula does nothing but go to one place, as a double, all in one block
  // and one stage: these stores, by output. Otherwise none.
  std::vector<const ConversionProgram::Store*> direct_stores(Index use_index,
                                                             std::size_t outputs) const {
    const auto output_of = [&](Node node) -> std::optional<Index> {
      const ScalarNode& it = program_.graph.nodes()[node];
      if (it.operation != Op::kInput) return std::nullopt;
      const auto& load = program_.loads[it.a];
      if (load.block != ConversionProgram::Load::kOfFormula || load.formula_use != use_index)
        return std::nullopt;
      return load.output;
    };
    std::vector<const ConversionProgram::Store*> stores(outputs, nullptr);
    std::size_t found = 0;
    for (const auto& stage : program_.stages) {
      if (found > 0) break;
      for (const auto& store : stage.stores) {
        const auto output = output_of(store.value);
        if (!output) continue;
        if (stores[*output] || !is_plain_double(store.access)) return {};
        stores[*output] = &store;
        if (++found > 1 && store.block != stage.stores[first_of(stage, stores)].block) return {};
      }
    }
    if (found != outputs) return {};
    // No other operation, formula or later store may want the values.
    for (const ScalarNode& node : program_.graph.nodes()) {
      const int operands = node.operation == Op::kInput ? 0 : row(node.operation).operands;
      const Node all[3] = {node.a, node.b, node.c};
      for (int i = 0; i < operands; ++i) {
        if (output_of(all[i])) return {};
      }
    }
    for (const auto& use : program_.formula_uses) {
      for (const Node input : use.inputs) {
        if (output_of(input)) return {};
      }
    }
    std::size_t uses = 0;
    for (const auto& stage : program_.stages) {
      for (const auto& store : stage.stores) uses += output_of(store.value).has_value();
    }
    return uses == outputs ? stores : std::vector<const ConversionProgram::Store*>{};
  }

  static std::size_t first_of(const ConversionProgram::Stage& stage,
                              const std::vector<const ConversionProgram::Store*>& stores) {
    for (std::size_t i = 0; i < stage.stores.size(); ++i) {
      if (std::find(stores.begin(), stores.end(), &stage.stores[i]) != stores.end()) return i;
    }
    return 0;
  }

  void add_arithmetic(Node at, const ScalarNode& node) {
    const auto simple = [&]() -> std::optional<Code> {
      switch (node.operation) {
        case Op::kAdd:
          return Code::kAdd;
        case Op::kSubtract:
          return Code::kSubtract;
        case Op::kMultiply:
          return Code::kMultiply;
        case Op::kDivide:
          return Code::kDivide;
        case Op::kNegate:
          return Code::kNegate;
        case Op::kSquareRoot:
          return Code::kSquareRoot;
        case Op::kSelect:
          return Code::kSelect;
        default:
          return std::nullopt;
      }
    }();
    const int operands = row(node.operation).operands;
    const std::uint16_t a = registers_.at(node.a);
    const std::uint16_t b = operands > 1 ? registers_.at(node.b) : a;
    const std::uint32_t c = operands > 2 ? registers_.at(node.c) : 0;
    const std::uint16_t result = new_register();
    registers_[at] = result;
    add({simple.value_or(Code::kOther), static_cast<std::uint8_t>(node.operation), a, b, result, c,
         0});
  }

  void add_store(const ConversionProgram::Store& store) {
    const auto kind = static_cast<std::uint8_t>(store.access.scalar);
    const auto block = static_cast<std::uint16_t>(store.block);
    if (moves_directly(store)) {
      const auto& load = program_.loads[program_.graph.nodes()[store.value].a];
      add({Code::kMoveDouble, 0, static_cast<std::uint16_t>(load.block), block, 0,
           static_cast<std::uint32_t>(load.access.offsets[0]),
           static_cast<std::uint32_t>(store.access.offsets[0])});
      return;
    }
    const std::uint16_t value = registers_.at(store.value);
    if (!is_direct(store.access)) {
      add({Code::kStorePath, kind, block, 0, value, path(store.access), 0});
      return;
    }
    add({store.access.scalar == ScalarKind::kFloat64 ? Code::kStoreDouble : Code::kStore, kind,
         block, 0, value, static_cast<std::uint32_t>(store.access.offsets[0]), 0});
  }

  void add_call(const ConversionProgram::Call& call) {
    using Form = Converter::Call::Form;
    const Function& function = library_.functions[call.function];
    Converter::Call result;
    result.function = find_symbol(function);
    bool by_value = false, returns = false, output_first = false;
    for (std::size_t i = 0; i < call.blocks.size(); ++i) {
      const Function::Argument& argument = function.arguments[i];
      const Type& type = type_of(call.blocks[i]);
      const bool number = type.kind == Type::Kind::kScalar;
      (argument.input ? result.input : result.output) = call.blocks[i];
      if (argument.position == 0) returns = true;
      if (argument.input && number) by_value = true;
      if (!argument.input && argument.position == 1) output_first = true;
      if (number && type.scalar != ScalarKind::kFloat64 &&
          (argument.input || argument.position == 0)) {
        fail(fmt::format("the function '{}' passes a {} by value", function.name, type.spelling),
             "pass a double or a pointer, or emit source code");
      }
      if (argument.position == 0 && !number) {
        fail(fmt::format("the function '{}' returns a struct", function.name),
             "let it write into an argument, or emit source code");
      }
    }
    result.form = returns        ? (by_value ? Form::kReturnOfValue : Form::kReturnOfIn)
                  : output_first ? (by_value ? Form::kOutValue : Form::kOutIn)
                                 : (by_value ? Form::kValueOut : Form::kInOut);
    result_.calls_.push_back(result);
    add({Code::kCall, 0, 0, 0, 0, static_cast<std::uint32_t>(result_.calls_.size() - 1), 0});
  }

  void* find_symbol(const Function& function) {
    if (function.context != "c99") {
      fail(fmt::format("the function '{}' is of the kind {}", function.name, function.context),
           "only C functions can be called while a program runs; emit source code for others");
    }
    void* handle = nullptr;
    if (!function.library.empty()) {
      std::vector<std::string> names;
      for (const std::string& directory : options_.library_directories) {
        names.push_back(fmt::format("{}/lib{}.so", directory, function.library));
      }
      names.push_back(fmt::format("lib{}.so", function.library));
      names.push_back(function.library);
      for (const std::string& name : names) {
        if (!handle) handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
      }
      if (!handle) {
        fail(fmt::format("the library '{}' of the function '{}' is not found", function.library,
                         function.name),
             "put it where the loader looks, or name its directory");
      }
      result_.libraries_.push_back(
          std::shared_ptr<void>(handle, [](void* library) { dlclose(library); }));
    }
    void* symbol = dlsym(handle ? handle : RTLD_DEFAULT, function.symbol.c_str());
    if (!symbol) {
      fail(fmt::format("there is no symbol '{}' for the function '{}'", function.symbol,
                       function.name),
           "check fname and library");
    }
    return symbol;
  }

  const Library& library_;
  const Plan& plan_;
  const EngineOptions& options_;
  ConversionProgram program_;
  Converter result_;
  std::map<Node, std::uint16_t> registers_;
  std::map<Index, std::uint16_t> formula_results_;
  std::set<const ConversionProgram::Store*> stored_;  // by a kernel
  std::size_t next_register_ = 0;
};

Converter make_converter(const Library& library, const Plan& plan, const EngineOptions& options) {
  return ConverterBuilder(library, plan, options).build();
}

}  // namespace sinew::data
