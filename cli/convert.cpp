// sinew convert FILE SOURCE TARGET: how one data prototype becomes another: explained, as source
// code, or done on numbers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <set>

#include "options.h"
#include "output.h"
#include "sinew/base/error.h"
#include "sinew/blocks/elaborate.h"
#include "sinew/blocks/parser.h"
#include "sinew/data/emit.h"
#include "sinew/data/engine.h"
#include "sinew/data/plan.h"

namespace sinew::cli {
namespace {

struct ConvertOptions {
  std::string file, source, target;
  bool explain = false, allow_lossy = false;
  std::string emit, function_name, values, output;
  std::vector<std::string> types, given;
};

[[noreturn]] void fail(const data::Prototype& prototype, std::string what, std::string remedy) {
  throw Error(
      {prototype.place, prototype.name, std::move(what), std::move(remedy), Severity::kError, {}});
}

std::string list_prototypes(const data::Library& library) {
  std::string text;
  for (const data::Prototype& prototype : library.prototypes) {
    text += fmt::format(
        "{:<28} {} {} ({})\n", prototype.name, prototype.semantic,
        prototype.coordinates.empty() ? "composed" : prototype.coordinates,
        prototype.representation.context.empty() ? "struct" : prototype.representation.context);
  }
  return text;
}

// A value's memory with a name for each number: what --values reads and prints.
struct Value {
  std::vector<data::Accessor> paths;
  std::vector<data::Access> places;
  std::vector<char> memory;
};

Value value_of(const data::Prototype& prototype) {
  const data::Type& type = *prototype.representation.type;
  Value value;
  value.paths = data::list_accessors(type);
  for (const data::Accessor& path : value.paths) {
    // A lone number has no path of its own.
    const data::Accessor whole{false, {"value"}};
    std::string why;
    const auto access = data::find_access(type, path.steps.empty() ? whole : path, &why);
    if (!access || !access->in_memory || access->scalar != data::ScalarKind::kFloat64) {
      fail(prototype, "its values are not all doubles in fixed memory",
           "use --values with prototypes of doubles, --emit with others");
    }
    value.places.push_back(*access);
  }
  value.memory.resize(type.size);
  return value;
}

std::vector<double> parse_numbers(const std::string& option, const std::string& text) {
  std::vector<double> numbers;
  const char *at = text.data(), *end = text.data() + text.size();
  while (true) {
    double number = 0;
    const auto [next, status] = std::from_chars(at, end, number);
    if (status != std::errc{} || (next != end && *next != ',')) {
      throw Error({{},
                   option,
                   fmt::format("'{}' is no list of numbers", text),
                   "write 0.1,0.2,0.3",
                   Severity::kError,
                   {}});
    }
    numbers.push_back(number);
    if (next == end) return numbers;
    at = next + 1;
  }
}

void fill(const data::Prototype& prototype, Value& value, const std::string& option,
          const std::string& text) {
  const std::vector<double> numbers = parse_numbers(option, text);
  if (numbers.size() != value.places.size()) {
    fail(prototype,
         fmt::format("it has {} numbers, {} were given", value.places.size(), numbers.size()),
         "give them in the order of memory");
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::memcpy(value.memory.data() + value.places[i].offsets[0], &numbers[i], sizeof(double));
  }
}

// Refuses what is given --with but not read, or given twice: numbers that have no effect are a
// slip.
void check_given(const data::Library& library, const std::vector<data::Index>& needed,
                 const ConvertOptions& options) {
  std::set<std::string> names;
  for (const data::Index index : needed) names.insert(library.relations[index].name());
  const std::string remedy = names.empty() ? "leave it out: the conversion needs no relation"
                                           : fmt::format("give {}", fmt::join(names, " and "));
  std::set<std::string> seen;
  for (const std::string& given : options.given) {
    const std::string name = given.substr(0, given.find('='));
    const char* fault = given.find('=') == std::string::npos ? "no numbers follow its name"
                        : !names.contains(name)              ? "the conversion does not read it"
                        : !seen.insert(name).second          ? "it is given twice"
                                                             : nullptr;
    if (fault != nullptr)
      throw Error(
          {{}, {}, fmt::format("--with \"{}\": {}", name, fault), remedy, Severity::kError, {}});
  }
}

// "tool in base=0.1,0,…" among the --with options.
Value given_relation(const data::Library& library, const data::Relation& relation,
                     const ConvertOptions& options) {
  const data::Prototype& prototype = library.prototypes[relation.prototype];
  for (const std::string& given : options.given) {
    const std::size_t equals = given.find('=');
    if (equals == std::string::npos || given.substr(0, equals) != relation.name()) continue;
    Value value = value_of(prototype);
    fill(prototype, value, "--with", given.substr(equals + 1));
    return value;
  }
  throw Error({relation.place,
               relation.name(),
               "the conversion needs this relation",
               fmt::format("give it: --with \"{}=NUMBERS\", in the order of the memory of {}",
                           relation.name(), prototype.name),
               Severity::kError,
               {}});
}

std::string convert_values(const data::Library& library, const data::Plan& plan,
                           const ConvertOptions& options) {
  const data::Prototype& source = library.prototypes[library.prototypes[plan.source].owner];
  const data::Prototype& target = library.prototypes[library.prototypes[plan.target].owner];
  Value from = value_of(source), to = value_of(target);
  fill(source, from, "--values", options.values);
  std::vector<Value> relations;
  const std::vector<data::Index> needed = data::inputs_of(library, plan);
  check_given(library, needed, options);
  for (const data::Index index : needed) {
    relations.push_back(given_relation(library, library.relations[index], options));
  }
  std::vector<const void*> inputs;
  for (const Value& relation : relations) inputs.push_back(relation.memory.data());
  data::EngineOptions engine;
  engine.library_directories = {std::filesystem::path(options.file).parent_path().string()};
  data::make_converter(library, plan, engine).run(from.memory.data(), to.memory.data(), inputs);
  std::string text;
  for (std::size_t i = 0; i < to.places.size(); ++i) {
    double number = 0;
    std::memcpy(&number, to.memory.data() + to.places[i].offsets[0], sizeof number);
    text += fmt::format("{}{}", i > 0 ? "," : "", number);
  }
  return text + "\n";
}

// What a person has to know of a conversion that is taken without --explain.
void print_marks(const std::vector<data::Segment>& segments) {
  for (const data::Segment& segment : segments) {
    for (const std::string& loss : segment.losses) {
      std::cerr << fmt::format("note: {} -> {} loses {}\n", segment.from, segment.to, loss);
    }
    if (segment.one_way) {
      std::cerr << fmt::format("note: {} -> {} is one-way\n", segment.from, segment.to);
    }
    for (const auto& [member, inner] : segment.members) print_marks(inner);
  }
}

}  // namespace

int run_convert(Arguments arguments) {
  CLI::App app(
      "How one data prototype becomes another: explained, as source code, or done on numbers. "
      "Without SOURCE "
      "and TARGET, the prototypes of the file.",
      "sinew convert");
  ConvertOptions options;
  app.add_option("FILE", options.file, "A .blocks file")->required();
  auto* source = app.add_option("SOURCE", options.source,
                                "The prototype to convert; PROTOTYPE.MEMBER for a part");
  app.add_option("TARGET", options.target, "The prototype to convert to");
  app.add_flag("--explain", options.explain,
               "Each step, its type, what it costs and what it loses (the default)")
      ->needs(source);
  auto* emit = app.add_option("--emit", options.emit, "A header with one inline function")
                   ->check(CLI::IsMember({"c", "cpp"}))
                   ->needs(source);
  app.add_option("--name", options.function_name,
                 "The function's name; SOURCE_to_TARGET without it")
      ->needs(emit);
  auto* values = app.add_option("--values", options.values,
                                "Convert these numbers (in the order of memory), print the result")
                     ->needs(source);
  app.add_option("--with", options.given,
                 "A relation between frames that the conversion needs: \"tool in base=0.1,0,…\"")
      ->needs(values);
  app.add_flag("--allow-lossy", options.allow_lossy, "Take steps that lose something")
      ->needs(source);
  app.add_option("--types", options.types,
                 "Directories to look for .msg, .asn, .idl, .smdsd files in");
  app.add_option("-o,--output", options.output, "Write there instead of to standard output");
  if (const auto code = parse(app, std::move(arguments))) return *code;
  if (source->count() > 0 && options.target.empty()) {
    std::cerr << "sinew convert: TARGET is missing\n";
    return kBadUsage;
  }

  blocks::LoadOptions load;
  load.type_directories = options.types;
  const data::Library library =
      blocks::load_library(blocks::parse(read_input(options.file), options.file), load);
  for (const Problem& warning : library.warnings) std::cerr << to_string(warning) << "\n";
  if (options.source.empty()) {
    write_output(options.output, list_prototypes(library));
    return kOk;
  }
  data::PlanOptions plan_options;
  plan_options.allow_lossy = options.allow_lossy;
  const data::Plan plan = data::find_plan(library, options.source, options.target, plan_options);

  std::string text;
  if (options.explain || (options.emit.empty() && options.values.empty())) {
    text = data::explain(library, plan);
    // The explanation of an emitted conversion is for the person, the code for the file.
    if (!options.emit.empty()) {
      std::cerr << text;
      text.clear();
    }
  } else {
    print_marks(data::segments_of(library, plan));
  }
  if (!options.emit.empty()) {
    data::EmitOptions emit;
    emit.language = options.emit == "c" ? data::SourceLanguage::kC : data::SourceLanguage::kCpp;
    emit.function_name = options.function_name;
    emit.origin = std::filesystem::path(options.file).filename().string();
    text += data::emit(library, plan, emit);
  }
  if (!options.values.empty()) text += convert_values(library, plan, options);
  write_output(options.output, text);
  return kOk;
}

}  // namespace sinew::cli
