// Functions, and conversions by them.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/spelling.h"
#include "sinew/data/library_builder.h"

namespace sinew::data {
namespace {

const std::vector<std::string> kContexts = {"c99", "coordinates", "cpp"};

}  // namespace

void LibraryBuilder::read_functions() {
  for (const FunctionDeclaration& declaration : declarations_.functions) {
    const std::string& about = declaration.name;
    if (functions_.count(about)) {
      error(declaration.place, about, "the function is declared twice", "rename one of them");
      continue;
    }
    Function function;
    function.name = about;
    function.context = declaration.context;
    function.library = declaration.library;
    function.symbol = declaration.symbol.empty() ? declaration.name : declaration.symbol;
    function.header = declaration.header;
    function.place = declaration.place;
    if (std::find(kContexts.begin(), kContexts.end(), function.context) == kContexts.end()) {
      error(declaration.place, about,
            fmt::format("functions of the kind '{}' cannot be called by conversions",
                        function.context),
            did_you_mean(function.context, kContexts,
                         fmt::format("use one of {}", fmt::join(kContexts, ", "))));
      continue;
    }
    std::map<std::size_t, const ArgumentDeclaration*> arguments;
    bool sound = true;
    const auto fail = [&](const Place& place, std::string what, std::string remedy) {
      error(place, about, std::move(what), std::move(remedy));
      sound = false;
    };
    for (const ArgumentDeclaration& argument : declaration.arguments) {
      if (!arguments.emplace(argument.position, &argument).second) {
        fail(argument.place, fmt::format("argument {} is there twice", argument.position),
             "number them 1, 2, …");
      }
      if (argument.position == 0 && (argument.input || !argument.output)) {
        fail(argument.place, "argument 0 is the return value, which is an output",
             "write 0 => PROTOTYPE");
      }
    }
    std::size_t expected = arguments.count(0) ? 0 : 1;
    for (const auto& [position, argument] : arguments) {
      if (position != expected && sound) {
        fail(argument->place, fmt::format("argument {} is missing", expected),
             "number them without a gap");
      }
      expected = position + 1;
      if (function.context == "coordinates") {
        const std::size_t dot = argument->prototype.rfind('.');
        const std::string domain =
            dot == std::string::npos ? "" : argument->prototype.substr(0, dot);
        const std::string coordinates =
            dot == std::string::npos ? argument->prototype : argument->prototype.substr(dot + 1);
        if (!domains_.count(domain)) {
          fail(argument->place, fmt::format("there is no domain '{}'", domain),
               "write DOMAIN.COORDINATES, as in geometry.quaternion");
          continue;
        }
        function.domain = domain;
        std::vector<std::string> names;
        for (const auto& [key, ignored] : domains_.at(domain).coordinates)
          names.push_back(key.second);
        if (std::find(names.begin(), names.end(), coordinates) == names.end()) {
          fail(argument->place,
               fmt::format("the domain '{}' has no coordinates '{}'", domain, coordinates),
               did_you_mean(coordinates, names, ""));
          continue;
        }
        (argument->input ? function.from_coordinates : function.to_coordinates) = coordinates;
        continue;
      }
      const auto prototype = prototypes_.find(argument->prototype);
      if (prototype == prototypes_.end()) {
        if (unsound_prototypes_.count(argument->prototype)) {
          sound = false;  // reported where it was read
        } else {
          fail(argument->place, fmt::format("there is no prototype '{}'", argument->prototype),
               did_you_mean(argument->prototype, names_of(prototype_declarations_),
                            "declare it with 'dproto'"));
        }
        continue;
      }
      const bool in_place = argument->input && argument->output;
      function.arguments.push_back(
          {position, argument->input && !in_place, in_place, prototype->second});
    }
    if (!sound) continue;
    library_.functions.push_back(std::move(function));
    functions_[about] = library_.functions.size() - 1;
  }
}

void LibraryBuilder::read_conversions() {
  std::set<std::tuple<std::string, std::string, std::string>> seen;
  for (const ConversionDeclaration& declaration : declarations_.conversions) {
    const std::string about = fmt::format("conversion {} -> {}", declaration.from, declaration.to);
    const auto fail = [&](std::string what, std::string remedy) {
      error(declaration.place, about, std::move(what), std::move(remedy));
    };
    bool sound = true;
    for (const std::string& name : {declaration.from, declaration.to}) {
      if (prototypes_.count(name)) continue;
      sound = false;
      if (!unsound_prototypes_.count(name)) {
        fail(fmt::format("there is no prototype '{}'", name),
             did_you_mean(name, names_of(prototype_declarations_), "declare it with 'dproto'"));
      }
    }
    const auto found = functions_.find(declaration.function);
    if (found == functions_.end()) {
      std::vector<std::string> declared;
      for (const FunctionDeclaration& function : declarations_.functions)
        declared.push_back(function.name);
      if (std::find(declared.begin(), declared.end(), declaration.function) == declared.end()) {
        fail(fmt::format("there is no function '{}'", declaration.function),
             did_you_mean(declaration.function, declared, "declare it with 'fproto'"));
      }
      continue;
    }
    if (!sound) continue;
    if (!seen.insert({declaration.from, declaration.to, declaration.function}).second) {
      fail("the conversion is declared twice", "leave one out");
      continue;
    }
    const Index from = prototypes_.at(declaration.from), to = prototypes_.at(declaration.to);
    const Prototype &source = library_.prototypes[from], &target = library_.prototypes[to];
    if (source.domain != target.domain || source.semantic != target.semantic) {
      fail(fmt::format("'{}' means {}, '{}' means {}", declaration.from, source.semantic,
                       declaration.to, target.semantic),
           "conversions are between prototypes of the same meaning");
      continue;
    }
    const Function& function = library_.functions[found->second];
    if (function.context == "coordinates") {
      if (function.from_coordinates != source.coordinates ||
          function.to_coordinates != target.coordinates) {
        fail(fmt::format("'{}' leads from {} to {}, the prototypes have {} and {}", function.name,
                         function.from_coordinates, function.to_coordinates, source.coordinates,
                         target.coordinates),
             "use the function of their coordinates");
        continue;
      }
    } else {
      const bool fits =
          function.arguments.size() == 2 &&
          std::any_of(function.arguments.begin(), function.arguments.end(),
                      [&](const auto& a) { return a.input && a.prototype == from; }) &&
          std::any_of(function.arguments.begin(), function.arguments.end(),
                      [&](const auto& a) { return !a.input && !a.in_place && a.prototype == to; });
      if (!fits) {
        fail(fmt::format("the function '{}' does not take '{}' and give '{}'", function.name,
                         declaration.from, declaration.to),
             "a conversion's function has these two arguments and no others");
        continue;
      }
    }
    FunctionEdge edge{from,  to,    found->second,     kUnknownFunctionCost,
                      false, false, declaration.loses, declaration.place,
                      {}};
    if (declaration.cost) {
      edge.cost = static_cast<int>(*declaration.cost);
      edge.cost_known = true;
    } else if (declaration.worst_case_s) {
      edge.cost = std::max(1, static_cast<int>(*declaration.worst_case_s / kSecondsPerAddition));
      edge.cost_known = true;
    }
    library_.function_edges.push_back(std::move(edge));
  }
}

}  // namespace sinew::data
