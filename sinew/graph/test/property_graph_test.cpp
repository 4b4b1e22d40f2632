// Properties on nodes and edges, edges that become nodes and edges again, ports, connectors, what a
// domain wants; and that none of it asks for an order.
#include "sinew/graph/property_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "refusal.h"
#include "sinew/graph/domain.h"

namespace sinew::graph {
namespace {

struct Written {
  Id iri(const std::string& name) { return store.terms().iri("http://x/" + name); }
  Id text(const std::string& lexical) { return store.terms().literal(lexical); }
  std::vector<Property> sorted(std::vector<Property> properties) const {
    std::sort(properties.begin(), properties.end());
    return properties;
  }
  // All triples as text, so that stores with other numbers can be compared.
  std::set<std::string> facts() const {
    std::set<std::string> all;
    graph().match_in({}, {}, {}, {}, [&](const Quad& quad) {
      const Terms& t = store.terms();
      all.insert(t.to_string(quad.subject) + t.to_string(quad.predicate) +
                 t.to_string(quad.object));
      return true;
    });
    return all;
  }
  View graph() const { return transaction.view(); }
  std::vector<std::string> faults() const {
    Report report;
    pg.check(report);
    std::vector<std::string> found;
    for (const Problem& problem : report.problems()) found.push_back(to_string(problem));
    return found;
  }
  Store store;
  Transaction transaction = store.begin();
  PropertyGraph pg{transaction, store.terms()};
};

TEST(PropertyGraph, SeveralEdgesLinkTheSameNodesEachWithItsProperties) {
  Written w;
  const Id a = w.iri("a"), b = w.iri("b"), sees = w.iri("sees");
  w.pg.add_edge(w.iri("e1"), a, sees, b);
  w.pg.add_edge(w.iri("e2"), a, sees, b);
  w.pg.set(w.iri("e1"), w.iri("by"), w.text("camera"));
  w.pg.set(w.iri("e2"), w.iri("by"), w.text("radar"));
  w.pg.set(a, w.iri("colour"), w.text("red"));
  w.pg.set(a, w.iri("colour"), w.text("blue"));  // in place of the other
  EXPECT_EQ(w.pg.edges(a, sees, b).size(), 2u);
  EXPECT_EQ(w.pg.properties(w.iri("e1")), (std::vector<Property>{{w.iri("by"), w.text("camera")}}));
  EXPECT_EQ(w.pg.properties(a), (std::vector<Property>{{w.iri("colour"), w.text("blue")}}));
  // The triple stays until the last edge that stands for it goes.
  w.pg.remove_edge(w.iri("e1"));
  EXPECT_TRUE(w.graph().contains(a, sees, b));
  EXPECT_TRUE(w.pg.properties(w.iri("e1")).empty());
  w.pg.remove_edge(w.iri("e2"));
  EXPECT_FALSE(w.graph().contains(a, sees, b));
  EXPECT_NE(refusal([&] { w.pg.remove_edge(w.iri("e2")); }).find("it is no edge"),
            std::string::npos);
}

// The source's example: a relation measured-by becomes a measurement, to which provenance and a
// coordinate frame can be linked, and back.
TEST(PropertyGraph, AnEdgeBecomesANodeAndBackWithoutLosingAProperty) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 100; ++run) {
    Written w;
    const Promotion measuring{w.iri("measured-by"), w.iri("Measurement"), w.iri("of-relation"),
                              w.iri("value")};
    const Id position = w.iri("position"), data = w.iri("data"), edge = w.iri("edge");
    w.pg.add_edge(edge, position, measuring.label, data);
    if (run % 2) w.pg.add_edge(w.iri("another"), position, measuring.label, data);
    std::set<Property> expected;
    for (std::size_t i = 0; i < random() % 6; ++i) {
      const Property property{w.iri("key" + std::to_string(random() % 4)),
                              w.text("value" + std::to_string(i))};
      w.pg.add(edge, property.key, property.value);
      expected.insert(property);
    }
    const auto before = w.facts();
    const auto own = w.pg.properties(edge);
    EXPECT_EQ(std::set<Property>(own.begin(), own.end()), expected);

    w.pg.promote(edge, measuring);
    EXPECT_FALSE(w.pg.is_edge(edge));
    EXPECT_EQ(w.graph().contains(position, measuring.label, data), run % 2 == 1);
    EXPECT_TRUE(w.graph().contains(edge, measuring.source_role, position));
    EXPECT_TRUE(w.graph().contains(edge, measuring.target_role, data));
    EXPECT_EQ(w.pg.properties(edge, &measuring), own);
    // As a node it may take part in relations, and gets properties that it keeps as an edge.
    w.pg.add_edge(w.iri("told"), edge, w.iri("provenance"), w.iri("camera"));
    EXPECT_TRUE(w.faults().empty());
    w.pg.remove_edge(w.iri("told"));

    w.pg.demote(edge, measuring);
    EXPECT_EQ(w.facts(), before);
    EXPECT_EQ(w.pg.properties(edge), own);
    w.pg.promote(edge, measuring);
    w.pg.set(edge, w.iri("stamp"), w.text("now"));
    w.pg.demote(edge, measuring);
    EXPECT_EQ(w.pg.properties(edge).size(), own.size() + 1);
  }
}

TEST(PropertyGraph, WhatCannotBeTurnedIsRefused) {
  Written w;
  const Promotion pose{w.iri("placed"), w.iri("Pose"), w.iri("of"), w.iri("with-respect-to")};
  const Id e = w.iri("e");
  EXPECT_NE(refusal([&] { w.pg.promote(e, pose); }).find("it is no edge"), std::string::npos);
  w.pg.add_edge(e, w.iri("a"), w.iri("other-label"), w.iri("b"));
  EXPECT_NE(refusal([&] { w.pg.promote(e, pose); }).find("has not the label"), std::string::npos);
  w.pg.add_edge(w.iri("p"), w.iri("a"), pose.label, w.iri("b"));
  EXPECT_NE(refusal([&] { w.pg.demote(w.iri("p"), pose); }).find("it is no http://x/Pose"),
            std::string::npos);
  w.pg.promote(w.iri("p"), pose);
  const auto node = w.facts();
  // Somebody is linked to it.
  w.pg.add_edge(w.iri("m"), w.iri("camera"), w.iri("measures"), w.iri("p"));
  EXPECT_NE(refusal([&] { w.pg.demote(w.iri("p"), pose); }).find("edges cannot be linked to"),
            std::string::npos);
  w.pg.remove_edge(w.iri("m"));
  EXPECT_EQ(w.facts(), node);
  // It has a third argument.
  w.pg.add(w.iri("p"), pose.source_role, w.iri("c"));
  EXPECT_NE(refusal([&] { w.pg.demote(w.iri("p"), pose); }).find("it has 2 and 1 arguments"),
            std::string::npos);
}

TEST(PropertyGraph, APortIsAViewOnSomeOfABlocksProperties) {
  Written w;
  const Id motor = w.iri("motor"), speed = w.iri("speed"), torque = w.iri("torque"),
           serial = w.iri("serial");
  w.pg.set(motor, speed, w.text("3"));
  w.pg.set(motor, torque, w.text("1"));
  w.pg.set(motor, serial, w.text("A7"));
  const Id shown[] = {speed, torque};
  w.pg.add_port(w.iri("drive"), motor, shown);
  EXPECT_EQ(w.pg.read(w.iri("drive")),
            w.sorted({{speed, w.text("3")}, {torque, w.text("1")}}));  // no serial number
  // A view, not a copy: both ways.
  w.pg.set(motor, speed, w.text("4"));
  EXPECT_EQ(w.pg.read(w.iri("drive")), w.sorted({{speed, w.text("4")}, {torque, w.text("1")}}));
  w.pg.write(w.iri("drive"), torque, w.text("2"));
  EXPECT_EQ(w.pg.properties(motor),
            w.sorted({{speed, w.text("4")}, {torque, w.text("2")}, {serial, w.text("A7")}}));
  EXPECT_NE(refusal([&] {
              w.pg.write(w.iri("drive"), serial, w.text("B8"));
            }).find("does not show http://x/serial"),
            std::string::npos);
  EXPECT_NE(refusal([&] { w.pg.read(motor); }).find("no port"), std::string::npos);
}

TEST(PropertyGraph, ConnectorsLinkPortsAndHavePropertiesOfTheirOwn) {
  Written w;
  const Id key[] = {w.iri("speed")};
  for (const char* name : {"a", "b", "c"}) {
    w.pg.add_port(w.iri(name + std::string("-port")), w.iri(name), key);
  }
  const Id three[] = {w.iri("a-port"), w.iri("b-port"), w.iri("c-port")};
  w.pg.connect(w.iri("shaft"), three);
  w.pg.set(w.iri("shaft"), w.iri("ratio"), w.text("2"));
  EXPECT_EQ(w.pg.connected(w.iri("b-port")).size(), 2u);
  EXPECT_EQ(w.pg.properties(w.iri("shaft")),
            (std::vector<Property>{{w.iri("ratio"), w.text("2")}}));
  EXPECT_TRUE(w.faults().empty());
}

TEST(PropertyGraph, FaultsAreFoundAtTheEnd) {
  Written w;
  const Id key[] = {w.iri("speed")};
  w.pg.add_port(w.iri("p"), w.iri("a"), key);
  w.pg.add_port(w.iri("q"), w.iri("a"), {});
  w.pg.add(w.iri("p"), w.store.terms().iri(std::string(kPropertyGraph) + "of"), w.iri("b"));
  const Id lonely[] = {w.iri("p")}, strange[] = {w.iri("p"), w.iri("a")};
  w.pg.connect(w.iri("c1"), lonely);
  w.pg.connect(w.iri("c2"), strange);
  w.pg.add_edge(w.iri("e"), w.iri("a"), w.iri("l"), w.iri("b"));
  w.pg.remove(w.iri("a"), w.iri("l"), w.iri("b"));
  auto found = w.faults();
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found.size(), 5u);
  EXPECT_EQ(found[0], "http://x/c1: the connector links 1 ports; two or more");
  EXPECT_EQ(found[1], "http://x/c2: it links http://x/a, which is no port; a port of a block");
  EXPECT_EQ(found[2],
            "http://x/e: the triple that the edge stands for is not there; source label target");
  EXPECT_EQ(found[3], "http://x/p: the port is of 2 blocks; one block");
  EXPECT_EQ(found[4], "http://x/q: the port shows nothing; one property or more");
}

// ---- domains ----

Domain geometry(Written& w) {
  return {"geometry",
          {{w.iri("Point")},
           {w.iri("Frame")},
           {w.iri("Vector"), {{w.iri("start"), w.iri("Point")}, {w.iri("end"), w.iri("Point")}}},
           {w.iri("Pose"),
            {{w.iri("of"), w.iri("Frame")},
             {w.iri("with-respect-to"), w.iri("Frame")},
             {w.iri("measured-by"), {}, 0, 3}}}}};
}

std::vector<std::string> faults(Written& w) {
  Report report;
  check(w.graph(), geometry(w), {}, report);
  std::vector<std::string> found;
  for (const Problem& problem : report.problems()) found.push_back(to_string(problem));
  return found;
}

TEST(Domain, ArityAndTypesOfArgumentsAreChecked) {
  Written w;
  const Id type = w.store.terms().iri("http://www.w3.org/1999/02/22-rdf-syntax-ns#type");
  for (const char* name : {"f1", "f2"}) w.pg.add(w.iri(name), type, w.iri("Frame"));
  w.pg.add(w.iri("pose"), type, w.iri("Pose"));
  w.pg.add(w.iri("pose"), w.iri("of"), w.iri("f1"));
  EXPECT_EQ(faults(w), (std::vector<std::string>{"http://x/pose: a http://x/Pose has 0 of "
                                                 "http://x/with-respect-to in the domain geometry; "
                                                 "1"}));
  w.pg.add(w.iri("pose"), w.iri("with-respect-to"), w.iri("f2"));
  EXPECT_TRUE(faults(w).empty());
  w.pg.add(w.iri("pose"), w.iri("with-respect-to"), w.iri("f1"));
  EXPECT_EQ(faults(w).size(), 1u);  // two of one role
  w.pg.set(w.iri("pose"), w.iri("with-respect-to"), w.iri("table"));
  EXPECT_EQ(faults(w), (std::vector<std::string>{
                           "http://x/pose: http://x/with-respect-to leads to http://x/table, which "
                           "is no http://x/Frame; a node of that type"}));
  w.pg.set(w.iri("pose"), w.iri("with-respect-to"), w.iri("f2"));
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(faults(w).empty()) << i;
    w.pg.add(w.iri("pose"), w.iri("measured-by"), w.iri("m" + std::to_string(i)));
  }
  EXPECT_NE(faults(w).at(0).find("has 4 of http://x/measured-by in the domain geometry; 0 to 3"),
            std::string::npos);
}

// The same operations in any order make the same graph, with the same faults.
TEST(Domain, OperationsAskForNoOrder) {
  std::mt19937_64 random(2);
  std::set<std::string> first_facts;
  std::vector<std::string> first_faults;
  for (int run = 0; run < 60; ++run) {
    Written w;
    const Id type = w.store.terms().iri("http://www.w3.org/1999/02/22-rdf-syntax-ns#type");
    std::vector<std::function<void()>> operations;
    for (int i = 0; i < 6; ++i) {
      const std::string n = std::to_string(i);
      operations.push_back([&w, type, n] { w.pg.add(w.iri("f" + n), type, w.iri("Frame")); });
      operations.push_back([&w, n] { w.pg.set(w.iri("f" + n), w.iri("name"), w.text(n)); });
      const std::string next = std::to_string((i + 1) % 6);
      operations.push_back([&w, type, n] { w.pg.add(w.iri("pose" + n), type, w.iri("Pose")); });
      operations.push_back([&w, n] { w.pg.add(w.iri("pose" + n), w.iri("of"), w.iri("f" + n)); });
      if (i != 4) {  // that one stays without, in every order
        operations.push_back([&w, n, next] {
          w.pg.add(w.iri("pose" + n), w.iri("with-respect-to"), w.iri("f" + next));
        });
      }
      operations.push_back([&w, n, next] {
        w.pg.add_edge(w.iri("e" + n), w.iri("f" + n), w.iri("beside"), w.iri("f" + next));
      });
      operations.push_back([&w, n] { w.pg.set(w.iri("e" + n), w.iri("since"), w.text(n)); });
      operations.push_back([&w, n] {
        const Id key[] = {w.iri("name")};
        w.pg.add_port(w.iri("port" + n), w.iri("f" + n), key);
      });
      operations.push_back([&w, n, next] {
        const Id both[] = {w.iri("port" + n), w.iri("port" + next)};
        w.pg.connect(w.iri("c" + n), both);
      });
    }
    std::shuffle(operations.begin(), operations.end(), random);
    for (const auto& operation : operations) operation();
    // Turning edges into nodes is the last in every run, but in any order among themselves.
    std::vector<int> which = {0, 1, 2, 3, 4, 5};
    std::shuffle(which.begin(), which.end(), random);
    const Promotion standing{w.iri("beside"), w.iri("Neighbourhood"), w.iri("left"),
                             w.iri("right")};
    for (const int i : which) {
      if (i % 2) w.pg.promote(w.iri("e" + std::to_string(i)), standing);
    }
    if (run == 0) {
      first_facts = w.facts();
      first_faults = faults(w);
      EXPECT_EQ(first_faults.size(), 1u);
    }
    ASSERT_EQ(w.facts(), first_facts) << run;
    ASSERT_EQ(faults(w), first_faults) << run;
    EXPECT_TRUE(w.faults().empty());
  }
}

}  // namespace
}  // namespace sinew::graph
