// How the parts of a task are read; the parts themselves are in read_*.cpp.
#pragma once

#include <cmath>
#include <string_view>

#include "sinew/model/graph_reader.h"
#include "sinew/task/task.h"

namespace sinew::task {

// Sizes of gains, references, bounds and periods in SI units, where they are not zero: what a
// controller makes of them and of what a robot measures stays finite.
constexpr double kSmallestQuantity = 1e-30, kLargestQuantity = 1e30;

inline bool has_good_size(double number) {
  const double size = std::abs(number);
  return size == 0 || (size >= kSmallestQuantity && size <= kLargestQuantity);
}

struct Reader {
  model::GraphReader graph;
  graph::Store& store;
  Task task = {};

  Id iri(std::string_view text) { return store.terms().iri(text); }
  bool is_a(Id node, std::string_view type) { return graph.is_a(node, iri(type)); }
  // Null where there is none; two are an error.
  Id optional(Id node, std::string_view property);
  // Null and an error where there is not exactly one; `what` names it.
  Id required(Id node, std::string_view property, std::string_view what);
  std::vector<Id> objects(Id node, std::string_view property) {
    return graph.objects(node, iri(property));
  }

  // A number that must be stated: its quantity is read. Null and an error where there is none.
  Id number(Id node, std::string_view property, std::string_view what);
  Id optional_number(Id node, std::string_view property, std::string_view what);
  // Reads a quantity with its unit; false and an error where it has none.
  bool read_quantity(Id node, std::string_view what);

  void error(Id node, std::string_view property, std::string what, std::string remedy) {
    graph.error(node, property.empty() ? Id{} : iri(property), std::move(what), std::move(remedy));
  }
};

// read_spatial.cpp: views, and the spatial and joint coordinates that they are of
void read_views(Reader& reader);
bool read_spatial(Reader& reader, Id coordinates);
std::optional<JointKind> read_joint_kind(Reader& reader, Id coordinates);

// read_control.cpp
void read_constraints(Reader& reader);
void read_monitors(Reader& reader);
void read_controllers(Reader& reader);
void read_handlers(Reader& reader);

// read_solver.cpp
void read_solver(Reader& reader);

// read_constraints.cpp: what hybrid dynamics imposes
void read_acceleration_constraints(Reader& reader, Id drivers, Solver& solver);
std::optional<Singular> read_singular(Reader& reader, Id solver);
void check_constraints(Reader& reader, const Solver& solver);

// check_task.cpp: dimensions, and that every number has one origin
void check_task(Reader& reader);

}  // namespace sinew::task
