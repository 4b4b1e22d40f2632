// The operator catalogue: every pure function that an algorithm may call, as one table. A row gives
// the ports in the order of the kernel's arguments and the frame rules, which the builder checks
// whenever a closure is made and the validator whenever an algorithm comes from elsewhere. The
// numeric function of a row is found by its name in sinew/program/kernels.cpp; a new operator is a
// new row and a new kernel.
//
// An *external* operator is no function of its arguments: it speaks to the world (a robot, a log, a
// clock) and is carried out by the host around the pure program (program/host_plan.h). Its closures
// stand in the schedule like any other, so that a query finds them and an update weaves them; what
// else it must know (which interface, which limits) are further properties of the closure.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/algorithm/quantities.h"
#include "sinew/data/dimension.h"

namespace sinew::algorithm {

enum class Direction : std::uint8_t { kIn, kOut };

// Of a port that takes data blocks of whatever quantity: only external operators have one.
inline constexpr std::string_view kAnyQuantity = "any";

struct Port {
  std::string name;      // "in1"
  std::string iri;       // the property that links a closure to its data block
  std::string quantity;  // a row of quantities.cpp, or kAnyQuantity
  Direction direction = Direction::kIn;
  bool many = false;  // takes an ordered list of data blocks, one argument each
};

// Which symbol of which port: "in1.of".
struct Symbol {
  std::uint8_t port = 0;
  Attribute attribute = Attribute::kOf;
};

struct FrameRule {
  Symbol left, right;  // must be the same node
};

// Dimensions that fit each other: the product of the ports' dimensions, each with its exponent, and
// of `rest` is none.
struct UnitRule {
  struct Factor {
    std::uint8_t port = 0;
    std::int8_t exponent = 1;
  };
  std::string text;  // "control = proportional-gain error"
  std::vector<Factor> factors;
  data::Dimension rest;
};

struct Operator {
  std::string_view name;     // "compose-pose"
  std::string iri;           // published where a published one exists
  std::string_view formula;  // what it computes
  std::vector<Port> ports;   // inputs first
  std::vector<FrameRule> rules;
  std::vector<UnitRule> unit_rules;
  bool external = false;
};

std::span<const Operator> operators();
const Operator* find_operator(std::string_view name);        // nullptr when there is none
const Operator* find_operator_by_iri(std::string_view iri);  // nullptr when there is none

// "in1.of = in2.with-respect-to"
std::string to_string(const FrameRule& rule, const Operator& op);

}  // namespace sinew::algorithm
