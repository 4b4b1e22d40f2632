#include "sinew/graph/domain.h"

#include <algorithm>

#include "sinew/graph/standard_iris.h"

namespace sinew::graph {

void check(const View& view, const Domain& domain, const Places& places, Report& report) {
  const Terms& terms = view.terms();
  const Id type = terms.find_iri(kRdfType);
  if (!type) return;  // nothing has a type
  for (const DomainType& one : domain.types) {
    std::vector<Id> nodes;
    view.match({}, type, one.type, Dataset::kUnion, [&](const Quad& quad) {
      nodes.push_back(quad.subject);
      return true;
    });
    std::sort(nodes.begin(), nodes.end(),
              [&](Id a, Id b) { return terms.text(a) < terms.text(b); });
    for (const Id node : nodes) {
      const std::string name(terms.text(node));
      for (const Role& role : one.roles) {
        std::vector<Id> arguments;
        view.match(node, role.property, {}, Dataset::kUnion, [&](const Quad& quad) {
          arguments.push_back(quad.object);
          return true;
        });
        const std::string property(terms.text(role.property));
        if (arguments.size() < role.least || arguments.size() > role.most) {
          report.error(places.find(node, role.property), name,
                       "a " + std::string(terms.text(one.type)) + " has " +
                           std::to_string(arguments.size()) + " of " + property +
                           " in the domain " + domain.name,
                       role.least == role.most
                           ? std::to_string(role.least)
                           : std::to_string(role.least) + " to " + std::to_string(role.most));
        }
        std::sort(arguments.begin(), arguments.end(),
                  [&](Id a, Id b) { return terms.text(a) < terms.text(b); });
        for (const Id argument : arguments) {
          if (!role.filler || view.contains(argument, type, role.filler)) continue;
          report.error(places.find(node, role.property), name,
                       property + " leads to " + std::string(terms.text(argument)) +
                           ", which is no " + std::string(terms.text(role.filler)),
                       "a node of that type");
        }
      }
    }
  }
}

}  // namespace sinew::graph
