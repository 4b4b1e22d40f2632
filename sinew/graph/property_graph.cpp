#include "sinew/graph/property_graph.h"

#include <algorithm>
#include <string>

#include "sinew/graph/standard_iris.h"

namespace sinew::graph {

PropertyGraph::PropertyGraph(Transaction& transaction, Terms& terms, Id graph)
    : transaction_(transaction),
      terms_(terms),
      graph_(graph),
      type_(terms.iri(kRdfType)),
      edge_(pg("Edge")),
      source_(pg("source")),
      label_(pg("label")),
      target_(pg("target")),
      port_(pg("Port")),
      of_(pg("of")),
      shows_(pg("shows")),
      connector_(pg("Connector")),
      links_(pg("links")) {}

Id PropertyGraph::pg(std::string_view term) const {
  return terms_.iri(std::string(kPropertyGraph) + std::string(term));
}

void PropertyGraph::put(Id subject, Id predicate, Id object) {
  transaction_.add({subject, predicate, object, graph_});
}

std::vector<Id> PropertyGraph::objects(Id subject, Id predicate) const {
  std::vector<Id> found;
  transaction_.view().match_in(subject, predicate, {}, graph_, [&](const Quad& quad) {
    found.push_back(quad.object);
    return true;
  });
  return found;
}

std::vector<Id> PropertyGraph::subjects(Id predicate, Id object) const {
  std::vector<Id> found;
  transaction_.view().match_in({}, predicate, object, graph_, [&](const Quad& quad) {
    found.push_back(quad.subject);
    return true;
  });
  return found;
}

void PropertyGraph::refuse(Id element, std::string what, std::string remedy) const {
  throw Error(Problem{{},
                      std::string(terms_.text(element)),
                      std::move(what),
                      std::move(remedy),
                      Severity::kError,
                      {}});
}

// ---- properties ----

void PropertyGraph::set(Id element, Id key, Id value) {
  for (const Id old : objects(element, key)) {
    if (old != value) transaction_.remove({element, key, old, graph_});
  }
  put(element, key, value);
}
void PropertyGraph::add(Id element, Id key, Id value) { put(element, key, value); }
bool PropertyGraph::remove(Id element, Id key, Id value) {
  return transaction_.remove({element, key, value, graph_});
}

std::vector<Property> PropertyGraph::properties(Id element, const Promotion* promotion) const {
  const Id structure[] = {type_, source_, label_, target_, of_, shows_, links_};
  std::vector<Property> found;
  transaction_.view().match_in(element, {}, {}, graph_, [&](const Quad& quad) {
    const bool structural = std::find(std::begin(structure), std::end(structure), quad.predicate) !=
                                std::end(structure) ||
                            (promotion && (quad.predicate == promotion->source_role ||
                                           quad.predicate == promotion->target_role));
    // A triple that an edge stands for is a link, not a property.
    if (!structural && edges(element, quad.predicate, quad.object).empty()) {
      found.push_back({quad.predicate, quad.object});
    }
    return true;
  });
  std::sort(found.begin(), found.end());
  return found;
}

// ---- edges ----

void PropertyGraph::add_edge(Id edge, Id source, Id label, Id target) {
  put(source, label, target);
  put(edge, type_, edge_);
  put(edge, source_, source);
  put(edge, label_, label);
  put(edge, target_, target);
}

bool PropertyGraph::is_edge(Id edge) const {
  return transaction_.view().contains_in({edge, type_, edge_, graph_});
}

std::vector<Id> PropertyGraph::edges(Id source, Id label, Id target) const {
  const View view = transaction_.view();
  const auto fits = [&](Id edge) {
    return (!source || view.contains_in({edge, source_, source, graph_})) &&
           (!label || view.contains_in({edge, label_, label, graph_})) &&
           (!target || view.contains_in({edge, target_, target, graph_}));
  };
  std::vector<Id> found = source   ? subjects(source_, source)
                          : target ? subjects(target_, target)
                          : label  ? subjects(label_, label)
                                   : subjects(type_, edge_);
  std::erase_if(found, [&](Id edge) { return !fits(edge); });
  std::sort(found.begin(), found.end());
  return found;
}

void PropertyGraph::drop_structure(Id edge) {
  if (!is_edge(edge)) refuse(edge, "it is no edge", "one that add_edge has made");
  const auto sources = objects(edge, source_), labels = objects(edge, label_),
             targets = objects(edge, target_);
  if (sources.size() != 1 || labels.size() != 1 || targets.size() != 1) {
    refuse(edge, "the edge has not one source, one label and one target", "one of each");
  }
  const Id source = sources[0], label = labels[0], target = targets[0];
  transaction_.remove({edge, type_, edge_, graph_});
  transaction_.remove({edge, source_, source, graph_});
  transaction_.remove({edge, label_, label, graph_});
  transaction_.remove({edge, target_, target, graph_});
  // Another edge may stand for the same triple.
  if (edges(source, label, target).empty()) {
    transaction_.remove({source, label, target, graph_});
  }
}

void PropertyGraph::remove_edge(Id edge) {
  drop_structure(edge);
  std::vector<Quad> rest;
  transaction_.view().match_in(edge, {}, {}, graph_, [&](const Quad& quad) {
    rest.push_back(quad);
    return true;
  });
  for (const Quad& quad : rest) transaction_.remove(quad);
}

void PropertyGraph::promote(Id edge, const Promotion& promotion) {
  if (!is_edge(edge)) refuse(edge, "it is no edge", "one that add_edge has made");
  const auto sources = objects(edge, source_), labels = objects(edge, label_),
             targets = objects(edge, target_);
  if (labels != std::vector{promotion.label}) {
    refuse(edge, "the edge has not the label " + std::string(terms_.text(promotion.label)),
           "an edge that is declared to become such a node");
  }
  drop_structure(edge);
  put(edge, type_, promotion.type);
  put(edge, promotion.source_role, sources.at(0));
  put(edge, promotion.target_role, targets.at(0));
}

void PropertyGraph::demote(Id node, const Promotion& promotion) {
  const std::string type(terms_.text(promotion.type));
  if (!transaction_.view().contains_in({node, type_, promotion.type, graph_})) {
    refuse(node, "it is no " + type, "a node of that type");
  }
  const auto sources = objects(node, promotion.source_role),
             targets = objects(node, promotion.target_role);
  if (sources.size() != 1 || targets.size() != 1) {
    refuse(node,
           "it has " + std::to_string(sources.size()) + " and " + std::to_string(targets.size()) +
               " arguments of the two roles that an edge can have",
           "one of each");
  }
  Id user;
  transaction_.view().match_in({}, {}, node, graph_, [&](const Quad& quad) {
    user = quad.subject;
    return false;
  });
  if (user) {
    refuse(node, std::string(terms_.text(user)) + " is linked to it, and edges cannot be linked to",
           "end that link first, or leave it a node");
  }
  transaction_.remove({node, type_, promotion.type, graph_});
  transaction_.remove({node, promotion.source_role, sources[0], graph_});
  transaction_.remove({node, promotion.target_role, targets[0], graph_});
  add_edge(node, sources[0], promotion.label, targets[0]);
}

// ---- ports and connectors ----

void PropertyGraph::add_port(Id port, Id block, std::span<const Id> keys) {
  put(port, type_, port_);
  put(port, of_, block);
  for (const Id key : keys) put(port, shows_, key);
}

std::vector<Property> PropertyGraph::read(Id port) const {
  const auto blocks = objects(port, of_);
  if (blocks.size() != 1) refuse(port, "it is no port of one block", "one that add_port has made");
  std::vector<Property> shown;
  for (const Id key : objects(port, shows_)) {
    for (const Id value : objects(blocks[0], key)) shown.push_back({key, value});
  }
  std::sort(shown.begin(), shown.end());
  return shown;
}

void PropertyGraph::write(Id port, Id key, Id value) {
  const auto blocks = objects(port, of_);
  if (blocks.size() != 1) refuse(port, "it is no port of one block", "one that add_port has made");
  if (!transaction_.view().contains_in({port, shows_, key, graph_})) {
    refuse(port, "the port does not show " + std::string(terms_.text(key)),
           "a property that it shows, or another port");
  }
  set(blocks[0], key, value);
}

void PropertyGraph::connect(Id connector, std::span<const Id> ports) {
  put(connector, type_, connector_);
  for (const Id port : ports) put(connector, links_, port);
}

std::vector<Id> PropertyGraph::connected(Id port) const {
  std::vector<Id> others;
  for (const Id connector : subjects(links_, port)) {
    for (const Id other : objects(connector, links_)) {
      if (other != port) others.push_back(other);
    }
  }
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  return others;
}

void PropertyGraph::check(Report& report) const {
  const auto error = [&](Id element, std::string what, std::string remedy) {
    report.error({}, std::string(terms_.text(element)), std::move(what), std::move(remedy));
  };
  for (const Id edge : subjects(type_, edge_)) {
    const auto sources = objects(edge, source_), labels = objects(edge, label_),
               targets = objects(edge, target_);
    if (sources.size() != 1 || labels.size() != 1 || targets.size() != 1) {
      error(edge, "the edge has not one source, one label and one target", "one of each");
    } else if (!transaction_.view().contains_in({sources[0], labels[0], targets[0], graph_})) {
      error(edge, "the triple that the edge stands for is not there", "source label target");
    }
  }
  for (const Id port : subjects(type_, port_)) {
    const std::size_t blocks = objects(port, of_).size();
    if (blocks != 1) {
      error(port, "the port is of " + std::to_string(blocks) + " blocks", "one block");
    }
    if (objects(port, shows_).empty())
      error(port, "the port shows nothing", "one property or more");
  }
  for (const Id connector : subjects(type_, connector_)) {
    const auto ports = objects(connector, links_);
    if (ports.size() < 2) {
      error(connector, "the connector links " + std::to_string(ports.size()) + " ports",
            "two or more");
    }
    for (const Id port : ports) {
      if (!transaction_.view().contains_in({port, type_, port_, graph_})) {
        error(connector, "it links " + std::string(terms_.text(port)) + ", which is no port",
              "a port of a block");
      }
    }
  }
}

}  // namespace sinew::graph
