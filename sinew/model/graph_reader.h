// Reading one node's properties from a model's graph, with every fault reported where it was
// written. All functions that return an optional have reported why when there is nothing in it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/data/units.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/model/ids.h"
#include "sinew/model/tree.h"

namespace sinew::model {

// The dimensions of what models state.
namespace dimension {
inline constexpr data::Dimension kNone = {};
inline constexpr data::Dimension kLength = {{1}};
inline constexpr data::Dimension kAngle = {{0, 0, 0, 0, 0, 0, 0, 1}};
inline constexpr data::Dimension kMass = {{0, 1}};
inline constexpr data::Dimension kFirstMoment = {{1, 1}};
inline constexpr data::Dimension kInertia = {{2, 1}};
inline constexpr data::Dimension kVelocity = {{1, 0, -1}};
inline constexpr data::Dimension kAngularVelocity = {{0, 0, -1, 0, 0, 0, 0, 1}};
inline constexpr data::Dimension kAcceleration = {{1, 0, -2}};
inline constexpr data::Dimension kAngularAcceleration = {{0, 0, -2, 0, 0, 0, 0, 1}};
inline constexpr data::Dimension kForce = {{1, 1, -2}};
inline constexpr data::Dimension kTorque = {{2, 1, -2}};
}  // namespace dimension

class GraphReader {
 public:
  GraphReader(graph::Store& store, const graph::Places& places, Report& report)
      : ids(store.terms()), view(store.view()), places_(places), report_(report) {}

  Ids ids;
  graph::View view;

  void error(Id node, Id property, std::string what, std::string remedy);
  void warning(Id node, Id property, std::string what, std::string remedy);
  std::string_view text(Id id) const { return view.terms().text(id); }

  bool is_a(Id node, Id type) const { return view.contains(node, ids.type, type); }
  // Every subject of that type, in order of appearance.
  std::vector<Id> all(Id type) const;
  std::vector<Id> objects(Id node, Id property) const;
  bool has(Id node, Id property) const { return bool(view.object(node, property)); }

  // Exactly one value; `what` names it in the error ("the pose that the coordinates are of").
  std::optional<Id> one(Id node, Id property, std::string_view what);
  // The value of a property that need not be there; null, and an error, when there are several.
  Id at_most_one(Id node, Id property, std::string_view what);
  std::optional<double> number(Id node, Id property);
  std::optional<Vector3> vector(Id node, Id x, Id y, Id z);
  // A list of three numbers.
  std::optional<Vector3> list_of_three(Id node, Id property);
  // In the unit that the node states for them.
  std::optional<Matrix3> direction_cosines(Id node);

  // What a number of that dimension is to be multiplied with to be in SI units: the scale of the
  // node's unit of that dimension. `quantity` names the number in the error ("the position").
  std::optional<double> scale(Id node, const data::Dimension& dimension, std::string_view quantity);

 private:
  struct Unit {
    data::Dimension dimension;
    double scale = 0;  // 0: no unit
  };
  const Unit& unit(Id node, Id iri);

  const graph::Places& places_;
  Report& report_;
  std::unordered_map<Id, Unit> units_;
};

}  // namespace sinew::model
