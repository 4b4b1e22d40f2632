// A checked set of data prototypes and their relations, ready for conversions to be searched in.
//
// A *space* is one way to express one meaning, whatever the memory: "Orientation as a quaternion".
// Its slots are numbers in SI units. Every prototype is bound to at least one space: slot by slot
// to places in memory. Conversions go from prototype to space to prototype; formulas and functions
// lead between them. A composite meaning has *composed* spaces, whose slots are those of one space
// for each member.
//
// Everything is ordered by name, so that the order of the declarations never matters.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/data/declarations.h"
#include "sinew/data/formula.h"
#include "sinew/data/representation.h"
#include "sinew/data/units.h"

namespace sinew::data {

using Index = std::size_t;

struct Space {
  std::string key;  // unique: domain, meaning, coordinates, convention
  std::string domain, semantic, coordinates;
  std::string convention;  // "expressed_in=base, reference_point=tool"; may be empty
  struct Slot {
    std::string name;
    Dimension dimension;
    std::string unit;  // the SI unit, as the domain writes it
    std::optional<double> constant;
  };
  std::vector<Slot> slots;
  std::vector<std::pair<std::string, Index>> members;  // of a composed space: member and its space
  bool composed() const { return !members.empty(); }
};

// One number of a prototype in memory, and what it says: slot = scale * number + offset, which
// holds its unit and the signs of the maps on the way.
struct SlotBinding {
  Index slot = 0;
  Access access;
  double scale = 1, offset = 0;
  Unit unit;
};
struct Binding {
  Index space = 0;
  std::vector<SlotBinding> slots;
  bool writable =
      true;  // false where writing the slots would leave elements of the value undefined
};
struct ConstantWrite {
  Access access;
  double value = 0;
};

struct Prototype {
  std::string name;
  Place place;
  std::string domain, semantic, coordinates;
  std::string algebraic;  // its name; of an unnamed one its form
  Representation representation;
  Index owner =
      0;  // the prototype whose memory this is: itself, unless it is a part ("pose.Position")
  std::vector<Binding> bindings;
  std::vector<ConstantWrite> constants;
  std::vector<std::pair<std::string, Index>>
      members;  // composed or viewed: member and its prototype
  // Where some members are viewed by functions: the composed space of the parts that can be read
  // and, if each can also be written, of those. The other prototypes with members are bound to it.
  std::optional<Index> taken_apart, put_together;
};

// How the mangled names of C++ functions begin; such a symbol can be called like one of C.
constexpr std::string_view kMangledPrefix = "_Z";

struct Function {
  std::string name, context, library, symbol, header;
  struct Argument {
    std::size_t position = 0;
    bool input = false;     // false as well where the function changes what is there
    bool in_place = false;  // changes what is there
    Index prototype = 0;
  };
  std::vector<Argument> arguments;                       // by position
  std::string from_coordinates, to_coordinates, domain;  // context "coordinates"
  Place place;
};

// A formula between two spaces.
struct FormulaEdge {
  Index from = 0, to = 0;
  Index formula = 0;
  bool offered = true;  // false where a declared conversion replaces it
};
struct SpaceFormula {
  Formula formula;
  std::string loses;
  int cost = 0;
  bool one_way = false;  // there is no formula back
  Place place;
};

struct FunctionEdge {
  Index from = 0, to = 0;  // prototypes
  Index function = 0;
  int cost = 0;
  bool cost_known = false;
  bool one_way = false;
  std::string loses;
  Place place;
  std::vector<Index> formulas;  // context "coordinates": the formula edges that it stands for
};

// How one frame is related to another: the value of a prototype, in the coordinates in which the
// domain computes with relations.
struct Relation {
  std::string frame, reference;
  std::string domain;
  Index prototype = 0;
  Index space = 0;
  bool constant = false;
  std::map<std::string, double> values;  // of a constant, by the access's source
  Place place;
  std::string name() const { return frame + " in " + reference; }
};
struct RelationRule {
  std::string coordinates, semantic;
  std::vector<Space::Slot> slots;
  Formula identity, inverse, product;
};
// What a value becomes when one convention changes. The formula's inputs are the value's slots,
// then for each input the slots of its relation.
struct ConventionChange {
  std::string convention;
  Formula formula;
  std::vector<ChangeInput> inputs;
  std::string needs;  // what is missing where there is no formula
  int cost = 0;
};

struct Library {
  std::vector<Prototype> prototypes;
  std::vector<Space> spaces;
  std::vector<Function> functions;
  std::vector<SpaceFormula> formulas;
  std::vector<FormulaEdge> formula_edges;
  std::vector<FunctionEdge> function_edges;
  std::vector<Problem> warnings;

  std::map<std::string, RelationRule> relation_rules;  // by domain
  std::vector<Relation> relations;                     // ordered by frame, then reference
  // By domain, meaning, coordinates and convention.
  using ChangeKey = std::tuple<std::string, std::string, std::string, std::string>;
  std::map<ChangeKey, ConventionChange> changes;
  // Spaces that differ in their conventions alone.
  using CoordinatesKey = std::tuple<std::string, std::string, std::string>;
  std::map<CoordinatesKey, std::vector<Index>> alike;

  // For each space: the bindings that lead into it (prototype, its binding), ordered by prototype.
  std::vector<std::vector<std::pair<Index, Index>>> bound_to;
  std::vector<std::vector<Index>> formulas_from;   // edges by their start
  std::vector<std::vector<Index>> functions_from;  // edges by their start

  std::optional<Index> find_prototype(const std::string& name) const;
  std::optional<Index> find_space(const std::string& key) const;
};

// "expressed_in=base, reference_point=tool" by name, and back.
std::string join_convention(const std::map<std::string, std::string>& convention);
std::map<std::string, std::string> split_convention(const std::string& convention);
// Of a space; of a composed one that of its members together, where they agree.
struct Library;
std::string convention_of(const Library& library, Index space);

// The cost of one step whose function declares none, in additions.
constexpr int kUnknownFunctionCost = 1000;
// How a function's worst-case time (wcet) becomes a cost.
constexpr double kSecondsPerAddition = 1e-9;

// Checks everything; throws Error with all that is wrong.
Library make_library(const Declarations& declarations, const TypeSources& sources);

}  // namespace sinew::data
