// The program: an algorithm model lowered from graph to tree. Variables, closures (an operator
// bound to variables), and the order in which to evaluate them. Everything a back end needs is in
// here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sinew::program {

enum class Role : std::uint8_t {
  kInput,     // written by the caller before each evaluation
  kConstant,  // known now; Variable::value holds it
  kInternal,  // written by one closure, read by later ones
  kState,     // kept from one evaluation to the next; Variable::value is its first value
};

struct Variable {
  std::string name;        // QUANTITY.ELEMENT, unique in the program: "position.joint1"
  std::string iri;         // of the data block in the algorithm model
  std::string represents;  // IRI of the model element that it belongs to (joint, frame, link)
  std::string quantity;    // "pose", "twist", "joint-position", ... (algorithm/quantities.h)
  std::string unit;        // SI, space separated for composite ("UNITLESS M")
  std::string frame;       // IRI of the frame in which its coordinates are seen; empty for scalars
  Role role = Role::kInternal;
  bool output = false;        // handed back to the caller after each evaluation
  std::uint32_t size = 0;     // numbers
  std::vector<double> value;  // kConstant, kState: `size` numbers; otherwise empty
  bool held = false;          // changes at a lower rate, as partial.h says of slow and held ones
};

struct Closure {
  std::string operation;                 // name in the operator catalogue: "compose-pose"
  std::string iri;                       // of the closure in the algorithm model
  std::string step;                      // IRI of the synthesis step that made it
  std::string about;                     // IRI of the model element that it was made for
  std::vector<std::uint32_t> arguments;  // variable indices, in the order of the operator's ports
};

// A partial derivative of one number by another, and the variable that hands it out.
struct DerivativeEntry {
  std::uint32_t variable = 0;           // an output of one number, written by no closure
  std::uint32_t of = 0, of_number = 0;  // an output, and which of its numbers
  std::uint32_t by = 0, by_number = 0;  // an input, and which of its numbers
};

// What was asked for with OUT/IN: the Jacobian of some outputs with respect to some inputs
// (derivatives.h). Entries that are zero in every state are left out.
struct Derivative {
  std::string name;                   // "force/position"
  std::vector<std::uint32_t> of, by;  // variables: the Jacobian's rows and columns, in this order
  std::vector<DerivativeEntry> entries;
};

struct Program {
  std::string name;
  std::string iri;  // of the algorithm model
  std::vector<Variable> variables;
  std::vector<Closure> closures;
  std::vector<std::uint32_t> schedule;  // closure indices
  std::vector<Derivative> derivatives;
};

}  // namespace sinew::program
