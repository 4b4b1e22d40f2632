#include "sinew/data/emit.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sinew/data/emit_types.h"

namespace sinew::data {
namespace {

using Op = ScalarOperation;
using Node = ScalarGraph::Node;

std::string identifier(std::string text) {
  for (char& c : text) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return text;
}

std::string number(double value) {
  if (value != value) return "(0.0 / 0.0)";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return value < 0 ? "(" + text + ")" : text;
}

class Emitter {
 public:
  Emitter(const Library& library, const Plan& plan, const EmitOptions& options)
      : library_(library), plan_(plan), options_(options), program_(lower(library, plan)) {}

  std::string run() {
    check_language();
    for (const auto& stage : program_.stages) {
      for (const auto& store : stage.stores) needed_.push_back(store.value);
    }
    live_ = program_.graph.live(needed_);
    count_uses();
    collect_guards();
    std::string body = emit_body();
    std::string text = emit_banner();
    text += emit_includes();
    text += emit_functions();
    text += emit_signature() + " {\n" + body + "}\n";
    text += "\n#endif\n";
    return text;
  }

 private:
  bool cpp() const { return options_.language == SourceLanguage::kCpp; }
  std::string name() const {
    if (!options_.function_name.empty()) return identifier(options_.function_name);
    return identifier(library_.prototypes[plan_.source].name) + "_to_" +
           identifier(library_.prototypes[plan_.target].name);
  }
  const Representation& representation(Index block) const {
    return library_.prototypes[program_.blocks[block].prototype].representation;
  }

  void check_language() const {
    for (Index block = 0; block < program_.blocks.size(); ++block) {
      if (cpp() || !representation(block).cpp_only) continue;
      const Prototype& prototype = library_.prototypes[program_.blocks[block].prototype];
      throw Error(Problem{
          prototype.place,
          prototype.name,
          fmt::format("{} types cannot be reached from C", prototype.representation.context),
          "emit C++ (--emit cpp)",
          Severity::kError,
          {}});
    }
    for (const auto& stage : program_.stages) {
      for (const auto& call : stage.calls) {
        const Function& function = library_.functions[call.function];
        if (cpp() || function.context == "c99" || function.symbol.starts_with(kMangledPrefix))
          continue;
        throw Error(Problem{function.place,
                            function.name,
                            "a C++ function cannot be called from C",
                            "emit C++ (--emit cpp)",
                            Severity::kError,
                            {}});
      }
    }
  }

  void count_uses() {
    const auto& nodes = program_.graph.nodes();
    uses_.assign(nodes.size(), 0);
    for (const Node node : needed_) ++uses_[node];
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!live_[i] || nodes[i].operation == Op::kInput) continue;
      const int operands = row(nodes[i].operation).operands;
      // An operand that the C form writes twice counts twice.
      const int times = nodes[i].operation == Op::kHypotenuse ? 2 : 1;
      if (operands > 0) uses_[nodes[i].a] += times;
      if (operands > 1) uses_[nodes[i].b] += times;
      if (operands > 2) uses_[nodes[i].c] += 1;
    }
  }

  std::string source_of(Index block, const std::string& pattern) const {
    const Type& type = *representation(block).type;
    std::string object = program_.blocks[block].name;
    const bool array = type.kind == Type::Kind::kArray && type.spelling.empty();
    if (!cpp() && program_.is_parameter(block) && !array) object = "(*" + object + ")";
    if (!cpp() && program_.is_parameter(block) && pattern.starts_with("$.")) {
      return program_.blocks[block].name + "->" + substitute(pattern.substr(2), object);
    }
    return substitute(pattern, object);
  }
  static std::string substitute(const std::string& pattern, const std::string& object) {
    std::string text;
    for (const char c : pattern) text += c == '$' ? object : std::string(1, c);
    return text;
  }

  void collect_guards() {
    const auto add = [&](Index block, const Access& access) {
      for (const Access::Guard& guard : access.guards) {
        const std::string container = source_of(block, guard.source);
        const std::string count = guard.kind == Type::Kind::kVector
                                      ? fmt::format("{}.size()", container)
                                      : fmt::format("{}.list.count", container);
        std::size_t& index = guards_[count];
        index = std::max(index, guard.index);
      }
    };
    for (const auto& load : program_.loads) add(load.block, load.access);
    for (const auto& stage : program_.stages) {
      for (const auto& store : stage.stores) add(store.block, store.access);
    }
  }

  // ---- expressions ----

  // What stands for a node where it is used: a local's name, a constant, or its expression in
  // place.
  std::string operand(Node node) {
    const ScalarNode& it = program_.graph.nodes()[node];
    if (it.operation == Op::kConstant) return number(it.value);
    if (!names_.count(node)) return "(" + expression(node) + ")";
    return names_[node];
  }

  std::string expression(Node node) {
    const ScalarNode& it = program_.graph.nodes()[node];
    const OperationRow& form = row(it.operation);
    std::string text;
    for (std::size_t i = 0; i < form.c_form.size(); ++i) {
      if (form.c_form[i] != '$') {
        text += form.c_form[i];
        continue;
      }
      const char which = form.c_form[++i];
      text += operand(which == 'a' ? it.a : which == 'b' ? it.b : it.c);
    }
    return text;
  }

  // Makes locals for everything that the node needs and that is used more than once.
  void prepare(Node node, std::string& text) {
    // Depth first by an explicit stack: graphs may be deep.
    std::vector<std::pair<Node, bool>> stack = {{node, false}};
    while (!stack.empty()) {
      const auto [at, ready] = stack.back();
      stack.pop_back();
      if (names_.count(at) || done_.count(at)) continue;
      const ScalarNode& it = program_.graph.nodes()[at];
      if (it.operation == Op::kConstant) continue;
      if (it.operation == Op::kInput) {
        const auto& load = program_.loads[it.a];
        const std::string local = fmt::format("in{}", names_.size());
        text += fmt::format("  const double {} = {};  // {}\n", local, load_expression(load),
                            load.label);
        names_[at] = local;
        continue;
      }
      if (!ready) {
        stack.emplace_back(at, true);
        const int operands = row(it.operation).operands;
        if (operands > 2) stack.emplace_back(it.c, false);
        if (operands > 1) stack.emplace_back(it.b, false);
        if (operands > 0) stack.emplace_back(it.a, false);
        continue;
      }
      if (uses_[at] > 1) {
        const std::string local = fmt::format("v{}", names_.size());
        text += fmt::format("  const double {} = {};\n", local, expression(at));
        names_[at] = local;
      } else {
        done_.insert(at);
      }
    }
  }

  std::string load_expression(const ConversionProgram::Load& load) const {
    std::string text = source_of(load.block, load.access.source);
    if (load.access.json) return text + ".get<double>()";
    if (load.access.scalar == ScalarKind::kFloat64) return text;
    return cpp() ? fmt::format("static_cast<double>({})", text) : fmt::format("(double){}", text);
  }

  std::string store_statement(const ConversionProgram::Store& store) {
    const Access& access = store.access;
    const ScalarNode& it = program_.graph.nodes()[store.value];
    std::string value = it.operation == Op::kConstant || names_.count(store.value)
                            ? operand(store.value)
                            : expression(store.value);
    if (!access.json && access.scalar == ScalarKind::kFloat32) {
      value =
          cpp() ? fmt::format("static_cast<float>({})", value) : fmt::format("(float)({})", value);
    } else if (!access.json && access.scalar != ScalarKind::kFloat64) {
      const std::string type = std::string(name_of(access.scalar));
      value = cpp() ? fmt::format("static_cast<{}>(llround({}))", type, value)
                    : fmt::format("({})llround({})", type, value);
    }
    return fmt::format("  {} = {};\n", source_of(store.block, access.source), value);
  }

  // ---- the parts of the file ----

  std::string emit_body() {
    std::string text;
    for (const auto& [count, index] : guards_) {
      text += fmt::format("  if ({} <= {}) return {};\n", count, index, cpp() ? "false" : "0");
    }
    for (Index block = 2 + program_.inputs; block < program_.blocks.size(); ++block) {
      text +=
          fmt::format("  {};\n", declare(*representation(block).type, program_.blocks[block].name,
                                         cpp() ? SourceLanguage::kCpp : SourceLanguage::kC));
    }
    for (const auto& stage : program_.stages) {
      for (const auto& store : stage.stores) prepare(store.value, text);
      for (const auto& store : stage.stores) text += store_statement(store);
      for (const auto& call : stage.calls) text += emit_call(call);
    }
    if (!guards_.empty()) text += fmt::format("  return {};\n", cpp() ? "true" : "1");
    return text;
  }

  static bool is_scalar(const Type& type) { return type.kind == Type::Kind::kScalar; }
  static bool is_array(const Type& type) {
    return type.kind == Type::Kind::kArray && type.spelling.empty();
  }

  std::string emit_call(const ConversionProgram::Call& call) {
    const Function& function = library_.functions[call.function];
    std::string result, arguments;
    for (std::size_t i = 0; i < call.blocks.size(); ++i) {
      const Index block = call.blocks[i];
      const Type& type = *representation(block).type;
      const std::string& object = program_.blocks[block].name;
      const bool pointer = !cpp() && program_.is_parameter(block);  // a parameter of the C function
      if (function.arguments[i].position == 0) {
        result = pointer ? fmt::format("*{} = ", object) : fmt::format("{} = ", object);
        continue;
      }
      if (!arguments.empty()) arguments += ", ";
      if (is_scalar(type) && function.arguments[i].input) {
        arguments += pointer ? "*" + object : object;
      } else {
        arguments += is_array(type) || pointer ? object : "&" + object;
      }
    }
    return fmt::format("  {}{}({});\n", result, function.symbol, arguments);
  }

  // Declarations of the functions that are called, unless a header has them.
  std::string emit_functions() {
    std::set<Index> functions;
    for (const auto& stage : program_.stages) {
      for (const auto& call : stage.calls) functions.insert(call.function);
    }
    std::string text;
    for (const Index index : functions) {
      const Function& function = library_.functions[index];
      if (!function.header.empty()) continue;
      std::string result = "void", parameters;
      for (const Function::Argument& argument : function.arguments) {
        const Type& type = *library_.prototypes[argument.prototype].representation.type;
        if (argument.position == 0) {
          result = type_name(type, options_.language);
          continue;
        }
        if (!parameters.empty()) parameters += ", ";
        const std::string constant = argument.input ? "const " : "";
        const std::string local = fmt::format("argument{}", argument.position);
        if (is_scalar(type) && argument.input) {
          parameters += type_name(type, options_.language) + " " + local;
        } else if (is_array(type)) {
          parameters += constant + declare(type, local, options_.language);
        } else {
          parameters +=
              fmt::format("{}{}* {}", constant, type_name(type, options_.language), local);
        }
      }
      const bool c_linkage =
          cpp() && (function.context == "c99" || function.symbol.starts_with(kMangledPrefix));
      text += fmt::format(
          "{}{} {}({});{}\n", c_linkage ? "extern \"C\" " : "", result, function.symbol, parameters,
          function.library.empty() ? "" : fmt::format("  // library {}", function.library));
    }
    return text.empty() ? text : text + "\n";
  }

  std::string emit_signature() const {
    std::string parameters;
    for (Index block = 0; program_.is_parameter(block); ++block) {
      const Type& type = *representation(block).type;
      const std::string constant = block == 1 ? "" : "const ";
      const std::string& object = program_.blocks[block].name;
      if (block > 0) parameters += ", ";
      if (is_array(type)) {
        parameters += constant + declare(type, cpp() ? fmt::format("(&{})", object) : object,
                                         options_.language);
      } else {
        parameters += fmt::format("{}{}{} {}", constant, type_name(type, options_.language),
                                  cpp() ? "&" : "*", object);
      }
    }
    return fmt::format("{}inline {} {}({})", cpp() ? "" : "static ",
                       guards_.empty() ? "void" : (cpp() ? "bool" : "int"), name(), parameters);
  }

  std::string emit_banner() const {
    std::string text = fmt::format("// {} -> {}", library_.prototypes[plan_.source].name,
                                   library_.prototypes[plan_.target].name);
    if (!options_.origin.empty()) text += fmt::format(", from {}", options_.origin);
    text += ". Made by sinew convert; do not edit.\n//\n";
    const std::string why = explain(library_, plan_);
    for (std::size_t begin = 0; begin < why.size();) {
      const std::size_t end = why.find('\n', begin);
      text += "// " + why.substr(begin, end - begin) + "\n";
      begin = end + 1;
    }
    text += fmt::format("// {} operations in all.\n", program_.operations());
    const std::string guard = "SINEW_" + name() + "_H";
    text += fmt::format("#ifndef {0}\n#define {0}\n\n", guard);
    return text;
  }

  std::string emit_includes() {
    std::set<std::string> functions_headers;
    for (const auto& stage : program_.stages) {
      for (const auto& call : stage.calls) {
        const Function& function = library_.functions[call.function];
        if (!function.header.empty()) functions_headers.insert(function.header);
      }
    }
    std::vector<const Representation*> used;
    for (Index block = 0; block < program_.blocks.size(); ++block)
      used.push_back(&representation(block));
    std::string text = "#include <math.h>\n#include <stdint.h>\n\n";
    text += emit_type_declarations(used, options_.language);
    for (const std::string& header : functions_headers)
      text += fmt::format("#include \"{}\"\n", header);
    if (!functions_headers.empty()) text += "\n";
    return text;
  }

  const Library& library_;
  const Plan& plan_;
  const EmitOptions& options_;
  ConversionProgram program_;
  std::vector<Node> needed_;
  std::vector<bool> live_;
  std::vector<int> uses_;
  std::map<Node, std::string> names_;
  std::set<Node> done_;
  std::map<std::string, std::size_t> guards_;  // count expression to largest index
};

}  // namespace

std::string emit(const Library& library, const Plan& plan, const EmitOptions& options) {
  return Emitter(library, plan, options).run();
}

}  // namespace sinew::data
