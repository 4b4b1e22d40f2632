#include "sinew/synthesis/step_models.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/sparql/prepared.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_passes.h"

namespace sinew::synthesis {
namespace {

// On one line, so that line numbers in messages are those of the text.
constexpr std::string_view kPrefixes =
    "PREFIX tree: <https://w3id.org/sinew/kinematic-tree#> "
    "PREFIX sa: <https://w3id.org/sinew/algorithm#> "
    "PREFIX so: <https://w3id.org/sinew/operators#> "
    "PREFIX slot: <https://w3id.org/sinew/slots#> "
    "PREFIX qudt: <http://qudt.org/schema/qudt/> "
    "PREFIX unit: <http://qudt.org/vocab/unit/> "
    "PREFIX op-geom: <https://comp-rob2b.github.io/metamodels/geometry/spatial-operators#> "
    "PREFIX op-dyn: "
    "<https://comp-rob2b.github.io/metamodels/newtonian-rigid-body-dynamics/operators#> ";

constexpr std::string_view kParameters[] = {"node", "parent", "algorithm"};

class Reader {
 public:
  Reader(graph::Store& store, const graph::View& view, const graph::Places* places, Report& report)
      : store_(store), view_(view), terms_(view.terms()), places_(places), report_(report) {}

  StepModels read() {
    StepModels models;
    std::vector<Id> nodes;
    const Id type = rdf("type"), wanted = word("Step");
    if (!type || !wanted) return models;
    view_.match({}, type, wanted, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
      nodes.push_back(quad.subject);
      return true;
    });
    std::sort(nodes.begin(), nodes.end(),
              [&](Id a, Id b) { return terms_.text(a) < terms_.text(b); });
    for (const Id node : nodes) {
      models.steps.push_back(read_step(node));
      for (const Id answer : objects(node, "answers"))
        models.answers.push_back(read_answer(answer, models.steps.back()));
    }
    return models;
  }

 private:
  Id word(std::string_view name) const {
    return terms_.find_iri(std::string(kStepModelNamespace) + std::string(name));
  }
  Id rdf(std::string_view name) const {
    return terms_.find_iri(std::string(graph::kRdf) + std::string(name));
  }

  Place place(Id node, std::string_view property) const {
    return places_ != nullptr ? places_->find(node, word(property)) : Place{};
  }

  void error(Id node, std::string_view property, std::string what, std::string remedy) {
    report_.error(place(node, property), std::string(terms_.text(node)), std::move(what),
                  std::move(remedy));
  }

  std::vector<Id> objects(Id node, std::string_view property) const {
    std::vector<Id> found;
    if (const Id predicate = word(property))
      view_.match(node, predicate, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
        found.push_back(quad.object);
        return true;
      });
    return found;
  }

  std::vector<std::string> texts(Id node, std::string_view property) const {
    std::vector<std::string> found;
    for (const Id object : objects(node, property)) found.emplace_back(terms_.text(object));
    std::sort(found.begin(), found.end());
    return found;
  }

  std::string text(Id node, std::string_view property, bool required) {
    const std::vector<std::string> found = texts(node, property);
    if (found.size() > 1)
      error(node, property, fmt::format("has two values of {}", property), "state one");
    else if (found.empty() && required)
      error(node, property, fmt::format("lacks {}", property), "state it");
    return found.empty() ? std::string() : found.front();
  }

  // One of some words; nothing when it is another one, which is reported.
  std::string choice(Id node, std::string_view property,
                     std::initializer_list<std::string_view> words) {
    const std::string found = text(node, property, true);
    for (const std::string_view one : words)
      if (found == std::string(kStepModelNamespace) + std::string(one)) return std::string(one);
    if (!found.empty())
      error(node, property, fmt::format("{} is {}", property, found),
            fmt::format("one of {}", fmt::join(words, ", ")));
    return {};
  }

  std::vector<Id> list(Id node, std::string_view property) {
    std::vector<Id> items;
    const Id first = rdf("first"), rest = rdf("rest"), nil = rdf("nil");
    for (const Id head : objects(node, property))
      for (Id at = head; at && at != nil; at = view_.object(at, rest)) {
        const Id item = view_.object(at, first);
        if (!item || items.size() == kMostVisitors) {
          error(node, property, fmt::format("a broken list of {}", property), "write a list");
          return items;
        }
        items.push_back(item);
      }
    return items;
  }

  // A query's faults, at the property that holds it.
  template <typename Prepare>
  void checked(Id node, std::string_view property, Prepare prepare) {
    try {
      prepare();
    } catch (const Error& fault) {
      for (const Problem& problem : fault.problems())
        error(node, property,
              fmt::format("{}, line {}: {}", property, std::max<std::size_t>(problem.place.line, 1),
                          problem.what),
              problem.remedy);
    }
  }

  std::string query(Id node, std::string_view property, const std::string& own, bool ask,
                    std::string_view needed_column) {
    const std::string full = std::string(kPrefixes) + own;
    checked(node, property, [&] {
      const auto prepared = rdf::sparql::prepare(store_, full, kParameters);
      if (prepared->is_ask() != ask)
        error(node, property, fmt::format("{} is no {} query", property, ask ? "ASK" : "SELECT"),
              "write one");
      const auto& columns = prepared->columns();
      if (!ask && std::find(columns.begin(), columns.end(), needed_column) == columns.end())
        error(node, property, fmt::format("{} does not select ?{}", property, needed_column),
              "select the node that it leads to from ?node");
    });
    return full;
  }

  // The expansions that steps share have names, so that they are run once for all.
  std::string expansion(Id node, bool required) {
    std::string own = text(node, "expansion", required);
    if (own.empty()) return own;
    if (own == "across-joints") return std::string(kAcrossJoints);
    if (own == "to-asked-frames") return std::string(kToAskedFrames);
    return query(node, "expansion", own, false, "child");
  }

  Pass pass(Id node, std::string_view property, const Step& step, const std::string& iri) {
    const std::string own = text(node, property, false);
    if (own.empty()) return {};
    std::shared_ptr<const rdf::sparql::PreparedInsert> prepared;
    checked(node, property, [&] {
      prepared = rdf::sparql::prepare_insert(store_, std::string(kPrefixes) + own, kParameters);
    });
    if (!prepared) return {};
    std::vector<std::string> slots = step.needs;
    slots.insert(slots.end(), step.may_use.begin(), step.may_use.end());
    slots.insert(slots.end(), step.gives.begin(), step.gives.end());
    return insert_pass({iri, place(node, property), std::move(slots), std::move(prepared)});
  }

  Visitor read_visitor(Id node, const Step& step, const std::string& iri) {
    Visitor visitor;
    visitor.where = choice(node, "where", {"node", "edge"}) == "node" ? Where::kNode : Where::kEdge;
    for (const std::string& condition : texts(node, "conditions"))
      visitor.conditions.push_back(query(node, "conditions", condition, true, ""));
    visitor.expansion = expansion(node, false);
    visitor.configure = pass(node, "configure", step, iri);
    visitor.compute = pass(node, "compute", step, iri);
    if (!visitor.configure && !visitor.compute)
      error(node, "configure", "a visitor that does nothing", "state configure, compute, or both");
    return visitor;
  }

  Step read_step(Id node) {
    Step step;
    const std::string iri(terms_.text(node));
    step.name = text(node, "name", true);
    step.purpose = text(node, "purpose", true);
    const std::string direction = choice(node, "direction", {"outward", "inward", "local"});
    step.direction = direction == "inward"  ? Direction::kInward
                     : direction == "local" ? Direction::kLocal
                                            : Direction::kOutward;
    step.expansion = expansion(node, true);
    step.needs = texts(node, "needs");
    step.may_use = texts(node, "may-use");
    step.gives = texts(node, "gives");
    if (step.gives.empty())
      error(node, "gives", "it gives nothing", "name the slots that it fills");
    if (find_step(step.name) != nullptr)
      error(node, "name", fmt::format("a step that comes with Sinew is named {}, too", step.name),
            "choose another name");
    const std::vector<Id> visitors = list(node, "visitors");
    if (visitors.empty()) error(node, "visitors", "it visits nothing", "list its visitors");
    for (const Id visitor : visitors) step.visitors.push_back(read_visitor(visitor, step, iri));
    return step;
  }

  AnsweredQuantity read_answer(Id node, const Step& step) {
    AnsweredQuantity answer;
    answer.name = text(node, "quantity", true);
    answer.slot = text(node, "slot", true);
    const std::string of = choice(node, "of", {"frame", "joint", "robot"});
    answer.element = of == "joint"   ? Element::kJoint
                     : of == "robot" ? Element::kRobot
                                     : Element::kFrame;
    answer.dynamic = text(node, "dynamic", false) == "true";
    if (std::find(step.gives.begin(), step.gives.end(), answer.slot) == step.gives.end())
      error(node, "slot",
            fmt::format("it answers with {}, which the step does not give", answer.slot),
            "name one of the slots that it gives");
    if (find_asked(answer.name) != nullptr)
      error(node, "quantity", fmt::format("{} can be asked already", answer.name),
            "choose another name");
    return answer;
  }

  static constexpr std::size_t kMostVisitors = 1000;

  graph::Store& store_;
  const graph::View& view_;
  const graph::Terms& terms_;
  const graph::Places* places_;
  Report& report_;
};

}  // namespace

StepModels read_step_models(graph::Store& store, const graph::View& view,
                            const graph::Places* places, Report& report) {
  return Reader(store, view, places, report).read();
}

}  // namespace sinew::synthesis
