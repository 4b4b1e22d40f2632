// From a plan's edges to the direct conversions that a person thinks in, and their description.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sinew/data/plan.h"

namespace sinew::data {
namespace {

using Kind = PlanStep::Kind;

// Coordinates by their short name, as in "quaternion"; composed spaces by their members' names.
std::string short_name(const Library& library, Index index) {
  const Space& space = library.spaces[index];
  if (!space.composed()) return space.coordinates.empty() ? space.key : space.coordinates;
  std::vector<std::string> members;
  for (const auto& [member, part] : space.members) {
    members.push_back(fmt::format("{} {}", member, short_name(library, part)));
  }
  return fmt::format("{{{}}}", fmt::join(members, ", "));
}

class Segmenter {
 public:
  explicit Segmenter(const Library& library) : library_(library) {}

  std::vector<Segment> run(const Plan& plan, bool between_spaces) {
    std::vector<Segment> result;
    std::string at =
        between_spaces ? short_name(library_, plan.source) : library_.prototypes[plan.source].name;
    std::optional<Index> at_prototype;
    if (!between_spaces) at_prototype = plan.source;
    int pending = 0;         // what reading cost
    bool converted = false;  // a formula or the members since the last stop
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
      const PlanStep& step = plan.steps[i];
      if (step.kind == Kind::kRead) {
        pending = step.cost;
        converted = false;
        continue;
      }
      Segment segment;
      segment.from = at;
      segment.cost = step.cost + pending;
      if (!step.loses.empty()) segment.losses.push_back(step.loses);
      switch (step.kind) {
        case Kind::kWrite:
          if (converted || (between_spaces && !at_prototype)) {
            // Writing belongs to the conversion before it, if there is one.
            if (converted) {
              result.back().to = library_.prototypes[step.to].name;
              result.back().cost += step.cost;
              result.back().losses.insert(result.back().losses.end(), segment.losses.begin(),
                                          segment.losses.end());
              at = result.back().to;
              at_prototype = step.to;
              pending = 0;
              converted = false;
              continue;
            }
            segment.type = ConversionType::kPlain;
          } else {
            direct(library_.prototypes[*at_prototype], library_.prototypes[step.to],
                   library_.spaces[step.from], segment);
          }
          segment.to = library_.prototypes[step.to].name;
          at_prototype = step.to;
          break;
        case Kind::kFormula: {
          segment.type = ConversionType::kFunction;
          segment.how = fmt::format("the domain's formula {} -> {}",
                                    short_name(library_, step.from), short_name(library_, step.to));
          segment.one_way = library_.formulas[library_.formula_edges[step.which].formula].one_way;
          segment.to = short_name(library_, step.to);
          converted = true;
          break;
        }
        case Kind::kMembers: {
          const Space& space = library_.spaces[step.from];
          segment.type = ConversionType::kComposite;
          for (std::size_t m = 0; m < step.members.size(); ++m) {
            auto inner = run(step.members[m], true);
            if (inner.size() > 1) segment.type = ConversionType::kIndirectComposite;
            segment.members.emplace_back(space.members[m].first, std::move(inner));
          }
          segment.to = short_name(library_, step.to);
          converted = true;
          break;
        }
        case Kind::kApart:
        case Kind::kTogether: {
          const bool apart = step.kind == Kind::kApart;
          segment.type = ConversionType::kComposite;
          segment.how = apart ? "part by part, read by functions" : "part by part, by functions";
          const Space& space = library_.spaces[apart ? step.to : step.from];
          for (std::size_t m = 0; m < step.members.size(); ++m) {
            segment.members.emplace_back(space.members[m].first, run(step.members[m], !apart));
          }
          segment.to = apart ? short_name(library_, step.to) : library_.prototypes[step.to].name;
          converted = apart;
          if (!apart) at_prototype = step.to;
          break;
        }
        case Kind::kChange:
          segment.type = ConversionType::kFunction;
          segment.how = changes(step);
          segment.to = short_name(library_, step.to);
          converted = true;
          break;
        case Kind::kFunction: {
          const FunctionEdge& edge = library_.function_edges[step.which];
          segment.type = ConversionType::kFunction;
          segment.how = fmt::format("the function {}", library_.functions[edge.function].name);
          segment.one_way = edge.one_way;
          segment.cost_known = edge.cost_known;
          segment.to = library_.prototypes[step.to].name;
          at_prototype = step.to;
          converted = false;
          break;
        }
        case Kind::kRead:
          break;
      }
      at = segment.to;
      pending = 0;
      result.push_back(std::move(segment));
    }
    return result;
  }

 private:
  // "change of expressed_in from tool to base, by tool in base"
  std::string changes(const PlanStep& step) const {
    std::vector<std::string> all;
    std::set<std::string> used;
    for (const ConventionStep& change : step.changes) {
      all.push_back(fmt::format("{} from {} to {}", change.convention, change.from, change.to));
      for (const auto& chain : change.inputs) {
        for (const RelationLink& link : chain) {
          const Relation& relation = library_.relations[link.relation];
          used.insert(relation.name() + (relation.constant ? " (constant)" : " (given)"));
        }
      }
    }
    return fmt::format("change of {}, by {}", fmt::join(all, " and of "), fmt::join(used, " and "));
  }

  // Same space: plain, by alias, or a composite member by member.
  void direct(const Prototype& from, const Prototype& to, const Space& space,
              Segment& segment) const {
    if (space.composed()) {
      segment.type = ConversionType::kComposite;
      return;
    }
    if (from.algebraic == to.algebraic) {
      segment.type = ConversionType::kPlain;
      return;
    }
    segment.type = ConversionType::kAlias;
    segment.how = fmt::format("{} <-> {}", from.algebraic, to.algebraic);
  }

  const Library& library_;
};

void print(const std::vector<Segment>& segments, const std::string& indent, std::string& text) {
  int number = 0;
  for (const Segment& segment : segments) {
    text += fmt::format("{}{}. {} -> {}: type {}, {}", indent, ++number, segment.from, segment.to,
                        int(segment.type), name_of(segment.type));
    if (!segment.how.empty()) text += fmt::format(" ({})", segment.how);
    text += segment.cost_known
                ? fmt::format("; cost {}", segment.cost)
                : fmt::format(
                      "; cost not bounded: the function declares neither cost nor wcet, {} is "
                      "taken",
                      segment.cost);
    text += segment.losses.empty() ? "; loses nothing"
                                   : fmt::format("; LOSES {}", fmt::join(segment.losses, ", "));
    if (segment.one_way) text += "; one-way";
    text += '\n';
    for (const auto& [member, inner] : segment.members) {
      text += fmt::format("{}   {}{}\n", indent, member, inner.empty() ? ": as it is" : ":");
      print(inner, indent + "     ", text);
    }
  }
}

}  // namespace

std::string_view name_of(ConversionType type) {
  switch (type) {
    case ConversionType::kPlain:
      return "direct plain conversion";
    case ConversionType::kAlias:
      return "direct conversion by alias";
    case ConversionType::kFunction:
      return "direct conversion by conversion";
    case ConversionType::kComposite:
      return "direct composite conversion";
    case ConversionType::kIndirect:
      return "indirect conversion";
    case ConversionType::kIndirectComposite:
      return "indirect composite conversion";
  }
  return {};
}

std::vector<Segment> segments_of(const Library& library, const Plan& plan) {
  return Segmenter(library).run(plan, false);
}

ConversionType type_of(const std::vector<Segment>& segments) {
  if (segments.size() == 1) return segments.front().type;
  for (const Segment& segment : segments) {
    if (segment.type == ConversionType::kIndirectComposite) return segment.type;
  }
  return ConversionType::kIndirect;
}

std::string explain(const Library& library, const Plan& plan) {
  const auto segments = segments_of(library, plan);
  const Prototype &source = library.prototypes[plan.source],
                  &target = library.prototypes[plan.target];
  const ConversionType type = type_of(segments);
  std::string text =
      fmt::format("{} -> {}: type {} ({}), distance {}, cost {} (in additions)\n", source.name,
                  target.name, int(type), name_of(type), segments.size(), plan.cost);
  text += fmt::format("  both mean {} in the domain {}\n", source.semantic, source.domain);
  print(segments, "  ", text);
  return text;
}

}  // namespace sinew::data
