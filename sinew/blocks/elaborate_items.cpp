#include "sinew/blocks/elaborate_items.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "sinew/base/spelling.h"

namespace sinew::blocks {
namespace {

// "{Position = cartesian, Orientation = rot_matrix}" or "cartesian".
data::FormulaSide formula_side(const std::string& text) {
  data::FormulaSide side;
  if (!text.starts_with("{")) {
    side.coordinates = text;
    return side;
  }
  std::string_view rest(text);
  rest = rest.substr(1, rest.size() - 2);
  while (!rest.empty()) {
    const std::string_view entry = rest.substr(0, rest.find(", "));
    rest.remove_prefix(std::min(rest.size(), entry.size() + 2));
    const std::size_t equals = entry.find(" = ");
    side.members.emplace_back(entry.substr(0, equals), entry.substr(equals + 3));
  }
  return side;
}

// "2us", "0.5 ms" in seconds; nothing for anything else.
std::optional<double> duration(std::string_view text) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || value < 0) return std::nullopt;
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  if (unit == "s") return value;
  if (unit == "ms") return value * 1e-3;
  if (unit == "us") return value * 1e-6;
  if (unit == "ns") return value * 1e-9;
  return std::nullopt;
}

}  // namespace

void ItemElaborator::error(const Place& place, std::string about, std::string what,
                           std::string remedy) {
  report_.error(place, std::move(about), std::move(what), std::move(remedy));
}

void ItemElaborator::run(const Node& node) {
  const std::string& kind = node.kind;
  const std::string name = full(node.text("name"));
  if (kind == "domain") {
    domain(node);
  } else if (kind == "algebraic") {
    declarations_.algebraics.push_back({name, form(node), node.place});
  } else if (kind == "ddr") {
    declarations_.representations.push_back(
        {name, node.text("context"), node.text("text"), node.place_of("text")});
  } else if (kind == "units") {
    declarations_.units.push_back(units(node, name));
  } else if (kind == "alias") {
    declarations_.aliases.push_back({resolve_("algebraic", node.text("left")),
                                     resolve_("algebraic", node.text("right")), entries(node),
                                     node.place});
  } else if (kind == "dproto") {
    prototype(node);
  } else if (kind == "view") {
    view(node);
  } else if (kind == "fproto") {
    function(node);
  } else if (kind == "conversion") {
    conversion(node);
  } else if (kind == "relation") {
    relation(node);
  }
}

data::Algebraic ItemElaborator::form(const Node& node) {
  data::Algebraic algebraic;
  const std::string& text = node.text("form");
  const std::size_t open = text.find('{');
  const std::string_view kind = std::string_view(text).substr(0, open);
  std::vector<std::string> parts(1);
  for (const char c : text.substr(open + 1, text.size() - open - 2)) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  if (kind == "Scalar") {
    algebraic.kind = data::Algebraic::Kind::kScalar;
    if (parts.front().empty()) parts.clear();
    algebraic.names = std::move(parts);
    return algebraic;
  }
  algebraic.kind =
      kind == "Vector" ? data::Algebraic::Kind::kVector : data::Algebraic::Kind::kMatrix;
  const auto rows = data::index_of(parts[0]);
  const auto columns = parts.size() > 1 ? data::index_of(parts[1]) : std::optional<std::size_t>(1);
  if (!rows || !columns || *rows > data::kMaximumElements || *columns > data::kMaximumElements) {
    error(node.place_of("form"), full(node.text("name")), fmt::format("'{}' is too large", text),
          fmt::format("a form has at most {} elements", data::kMaximumElements));
    algebraic.rows = 1;
    return algebraic;
  }
  algebraic.rows = *rows;
  algebraic.columns = *columns;
  return algebraic;
}

double ItemElaborator::number(const Node& node, std::string_view name) {
  const std::string& text = node.text(name);
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || end != text.data() + text.size()) {
    error(node.place_of(name), {}, fmt::format("'{}' is no number that fits", text),
          "write a finite number");
  }
  return value;
}

std::vector<data::MapEntry> ItemElaborator::entries(const Node& node) {
  std::vector<data::MapEntry> result;
  for (const Node& child : node.children) {
    data::MapEntry entry;
    entry.place = child.place;
    const auto accessor = [&](std::string_view name) {
      const auto parsed = data::parse_accessor(child.text(name));
      if (parsed) return *parsed;
      error(child.place, {}, fmt::format("'{}' is no accessor", child.text(name)),
            fmt::format("indices are at most {}", data::kMaximumIndex));
      return data::Accessor{false, {"0"}};
    };
    entry.left = accessor("left");
    entry.negative = child.has("sign");
    if (child.has("constant")) {
      entry.constant = number(child, "constant");
    } else {
      entry.right = accessor("right");
    }
    result.push_back(std::move(entry));
  }
  return result;
}

data::UnitsDeclaration ItemElaborator::units(const Node& node, const std::string& name) {
  data::UnitsDeclaration units{
      name, node.text("ontology"), resolve_("algebraic", node.text("algebraic")), {}, node.place};
  for (const Node& child : node.children) {
    const auto accessor = data::parse_accessor(child.text("accessor"));
    if (!accessor) {
      error(child.place, name, fmt::format("'{}' is no accessor", child.text("accessor")), "");
      continue;
    }
    units.entries.push_back({child.text("unit"), *accessor, child.place});
  }
  return units;
}

void ItemElaborator::domain(const Node& node) {
  data::DomainDeclaration domain;
  domain.name = full(node.text("name"));
  domain.place = node.place;
  for (const Node& child : node.children) {
    if (child.kind == "annotation") {
      domain.annotations.push_back(
          {child.text("name"), child.has("optional"), child.all("value"), child.place});
    } else if (child.kind == "composite") {
      domain.composites.push_back({child.text("name"), child.all("member"), child.place});
    } else if (child.kind == "convention") {
      domain.conventions.push_back(
          {child.text("name"), child.all("of"), child.has("optional"), child.place});
    } else if (child.kind == "rule") {
      domain.relation_rules.push_back(rule(child));
    } else if (child.kind == "change") {
      domain.changes.push_back(change(child));
    } else if (child.kind == "older") {
      domain.older_names.push_back(child.text("name"));
    } else if (child.kind == "formula") {
      formula(child, domain);
    } else if (child.kind == "coordinates") {
      data::CoordinatesDeclaration coordinates{
          child.text("name"), child.all("of"), {}, {}, child.place};
      if (child.has("form")) coordinates.shape = form(child);
      for (const Node& parameter : child.children) {
        data::ParameterDeclaration declaration{
            parameter.text("name"), parameter.text("unit"), {}, parameter.place};
        if (parameter.has("constant")) declaration.constant = number(parameter, "constant");
        coordinates.parameters.push_back(std::move(declaration));
      }
      domain.coordinates.push_back(std::move(coordinates));
    }
  }
  // Every formula's ends have to be coordinates of its meaning.
  std::set<std::pair<std::string, std::string>> known;
  std::vector<std::string> names;
  for (const auto& coordinates : domain.coordinates) {
    for (const std::string& semantic : coordinates.semantics)
      known.insert({semantic, coordinates.name});
    names.push_back(coordinates.name);
  }
  for (const data::FormulaDeclaration& formula : domain.formulas) {
    for (const data::FormulaSide* side : {&formula.from, &formula.to}) {
      auto parts = side->members;
      if (parts.empty()) parts.emplace_back(formula.semantic, side->coordinates);
      for (const auto& [semantic, coordinates] : parts) {
        if (known.count({semantic, coordinates})) continue;
        error(formula.place, domain.name,
              fmt::format("{} has no coordinates '{}'", semantic, coordinates),
              did_you_mean(coordinates, names, "declare them with 'coordinates'"));
      }
    }
  }
  declarations_.domains.push_back(std::move(domain));
}

void ItemElaborator::formula(const Node& node, data::DomainDeclaration& domain) {
  domain.formulas.push_back({formula_side(node.text("from")), formula_side(node.text("to")),
                             node.text("of"), node.text("loses"), node.text("text"), node.place,
                             node.place_of("text")});
}

data::RelationRuleDeclaration ItemElaborator::rule(const Node& node) {
  const auto text = [&](std::string_view name) {
    return data::FormulaText{node.text(name), node.place_of(name)};
  };
  return {node.text("name"), node.text("of"), text("identity"),
          text("inverse"),   text("product"), node.place};
}

data::ChangeDeclaration ItemElaborator::change(const Node& node) {
  data::ChangeDeclaration change;
  change.convention = node.text("convention");
  change.coordinates = node.text("name");
  change.semantics = node.all("of");
  change.needs = node.text("needs");
  change.formula = {node.text("text"), node.place_of("text")};
  change.place = node.place;
  for (const Node& input : node.children) {
    change.inputs.push_back({input.text("name"), input.text("of"), input.text("in"), input.place});
  }
  return change;
}

void ItemElaborator::relation(const Node& node) {
  data::RelationDeclaration relation;
  relation.frame = node.text("frame");
  relation.reference = node.text("reference");
  relation.prototype = resolve_("dproto", node.text("prototype"));
  relation.constant = node.has("constant");
  if (relation.constant) relation.entries = entries(node);
  relation.place = node.place;
  declarations_.relations.push_back(std::move(relation));
}

void ItemElaborator::prototype(const Node& node) {
  data::PrototypeDeclaration prototype;
  prototype.name = full(node.text("name"));
  prototype.place = node.place;
  prototype.domain = {resolve_("domain", node.text("domain")), node.place_of("domain")};
  std::set<std::string> seen;
  for (const Node& field : node.children) {
    const std::string kind = field.kind == "usingddr" ? "ddr" : field.kind;
    if (!seen.insert(kind).second) {
      error(field.place, prototype.name, fmt::format("field '{}' is there twice", field.kind),
            "leave one out");
      continue;
    }
    const Place place = field.place_of("value");
    if (kind == "semantic") {
      prototype.semantic = {field.text("value"), place};
    } else if (kind == "coord") {
      prototype.coordinates = {field.text("value"), place};
    } else if (kind == "algebraic") {
      if (field.has("form")) {
        const std::string name = prototype.name + "::algebraic";
        declarations_.algebraics.push_back({name, form(field), field.place});
        prototype.algebraic = {name, field.place};
      } else {
        prototype.algebraic = {resolve_("algebraic", field.text("value")), place};
      }
    } else if (kind == "ddr") {
      if (field.has("context")) {
        const std::string name = prototype.name + "::ddr";
        declarations_.representations.push_back(
            {name, field.text("context"), field.text("text"), field.place_of("text")});
        prototype.representation = {name, field.place};
      } else {
        prototype.representation = {resolve_("ddr", field.text("value")), place};
      }
    } else if (kind == "units") {
      if (field.has("ontology")) {
        const std::string name = prototype.name + "::units";
        declarations_.units.push_back(units(field, name));
        prototype.units = {name, field.place};
      } else {
        prototype.units = {resolve_("units", field.text("value")), place};
      }
    } else if (kind == "dr") {
      prototype.map = entries(field);
      prototype.has_map = true;
    } else {
      for (const Node& member : field.children) {
        const bool composes = kind == "composes";
        auto& list = composes ? prototype.members : prototype.convention;
        list.emplace_back(
            member.text("name"),
            data::Field{composes ? resolve_("dproto", member.text("value")) : member.text("value"),
                        member.place_of("value")});
      }
    }
  }
  declarations_.prototypes.push_back(std::move(prototype));
}

void ItemElaborator::view(const Node& node) {
  data::ViewDeclaration view;
  view.prototype = resolve_("dproto", node.text("prototype"));
  view.member = node.text("member");
  view.target = resolve_("dproto", node.text("target"));
  if (node.has("function")) view.function = resolve_("fproto", node.text("function"));
  view.entries = entries(node);
  view.place = node.place;
  declarations_.views.push_back(std::move(view));
}

void ItemElaborator::function(const Node& node) {
  static const std::vector<std::string> kSettings = {"library", "fname", "header", "args"};
  data::FunctionDeclaration function;
  function.name = full(node.text("name"));
  function.context = node.text("context");
  function.place = node.place;
  if (function.context.empty()) {
    error(node.place, function.name, "the function's language is not said",
          "write fproto NAME :: c99 { … }");
    function.context = "c99";
  }
  for (const Node& field : node.children) {
    if (field.kind == "setting") {
      const std::string& name = field.text("name");
      std::string* place = name == "library"  ? &function.library
                           : name == "fname"  ? &function.symbol
                           : name == "header" ? &function.header
                                              : nullptr;
      if (!place || !field.has("text")) {
        error(
            field.place, function.name,
            fmt::format("functions have no setting '{}' with this value", name),
            did_you_mean(name, kSettings, "write library, fname or header with a text in quotes"));
      } else {
        *place = field.text("text");
      }
      continue;
    }
    for (const Node& child : field.children) {
      data::ArgumentDeclaration argument;
      const auto position = data::index_of(child.text("position"));
      if (!position) {
        error(child.place, function.name,
              fmt::format("'{}' is no position", child.text("position")), "");
        continue;
      }
      argument.position = *position;
      const std::string& direction = child.text("direction");
      argument.input = direction != "=>";
      argument.output = direction != "<=";
      argument.place = child.place;
      const std::string& reference = child.text("prototype");
      if (function.context == "coordinates") {
        const std::size_t dot = reference.rfind('.');
        argument.prototype =
            dot == std::string::npos
                ? reference
                : resolve_("domain", reference.substr(0, dot)) + reference.substr(dot);
      } else {
        argument.prototype = resolve_("dproto", reference);
      }
      function.arguments.push_back(std::move(argument));
    }
  }
  declarations_.functions.push_back(std::move(function));
}

void ItemElaborator::conversion(const Node& node) {
  static const std::vector<std::string> kSettings = {"cost", "wcet", "loses"};
  data::ConversionDeclaration conversion;
  conversion.from = resolve_("dproto", node.text("from"));
  conversion.to = resolve_("dproto", node.text("to"));
  conversion.function = resolve_("fproto", node.text("function"));
  conversion.place = node.place;
  const std::string about = fmt::format("conversion {} -> {}", conversion.from, conversion.to);
  for (const Node& setting : node.children) {
    const std::string& name = setting.text("name");
    if (name == "cost" && setting.has("number")) {
      conversion.cost = number(setting, "number");
      if (*conversion.cost < 0 || *conversion.cost > 1e9) {
        error(setting.place, about, "the cost is out of range", "write additions, from 0 to 1e9");
        conversion.cost = 0;
      }
    } else if (name == "wcet" && setting.has("text") && duration(setting.text("text")) &&
               *duration(setting.text("text")) <= 1) {
      conversion.worst_case_s = duration(setting.text("text"));
    } else if (name == "loses" && setting.has("text")) {
      conversion.loses = setting.text("text");
    } else {
      error(setting.place, about,
            fmt::format("conversions have no setting '{}' with this value", name),
            did_you_mean(name, kSettings,
                         "write cost = NUMBER, wcet = \"2us\" (at most 1 s) or loses = \"…\""));
    }
  }
  declarations_.conversions.push_back(std::move(conversion));
}

}  // namespace sinew::blocks
