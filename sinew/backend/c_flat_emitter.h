// What writes the statements of a flat function; internal to `backend`. Its parts:
//   c_flat_body.cpp     nodes, inputs, results
//   c_flat_angles.cpp   sines and cosines
//   c_flat_calls.cpp    functions that a very long program is divided into
//   c_flat_stages.cpp   values that wait in memory, constants in a table
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/backend/c_constant_table.h"
#include "sinew/backend/c_flat_body.h"
#include "sinew/backend/c_flat_plan.h"
#include "sinew/backend/c_names.h"
#include "sinew/backend/flat_parts.h"

namespace sinew::backend {

class FlatEmitter {
 public:
  FlatEmitter(const program::Computation& computation, const FlatLayout& layout,
              const FlatOptions& options, const FlatPlan& plan);

  FlatBody run();

 private:
  using Ref = program::Ref;
  using Node = program::Node;
  using Op = program::Op;

  // Arrays and lines.
  bool strided() const { return options_.form != FlatForm::kSample; }
  void use(const std::string& array);
  void touch(std::string_view name);
  std::string element(const FlatPlace& place);
  std::string address(const FlatPlace& place);
  std::string number(double value) const { return scalar_number(value, options_.scalar); }
  void line(std::string_view text, std::uint32_t origin = program::kNoOrigin);
  void declare(std::string_view type, std::string_view name, std::string_view value,
               std::uint32_t origin = program::kNoOrigin);

  // Nodes.
  const std::string& value(std::uint32_t i);
  std::string value(Ref ref) { return (ref.negative() ? "-" : "") + value(ref.node()); }
  void read_input(std::uint32_t i, const Node& node);
  void emit(std::uint32_t i);
  void declare_arithmetic(std::uint32_t i, const Node& node);
  void express(const Node& n);
  void lane_by_lane(std::uint32_t i, const Node& node);

  // Results.
  void results_of(std::uint32_t node);
  void later_results();
  void declare_zero();
  void write(std::uint32_t k);

  // Sines and cosines.
  void angles(const AngleGroup& group);
  void angles_one_by_one(const AngleGroup& group);
  void take(std::uint32_t node, const std::string& name, const std::string& array, int k);
  bool is_held(const Node& node) const;
  bool is_state(const Node& node) const;
  bool contiguous(const AngleGroup& group, std::size_t padded) const;

  // Functions that a very long program is divided into.
  void call_parts(const std::vector<std::uint32_t>& before);
  void forget();
  void keep(std::uint32_t node);
  void read_kept(std::uint32_t node);

  // Stages (c_flat_stages.cpp).
  void declare_kept();
  void begin_step();
  void end_step();
  void point_to(const std::string& pointer);
  const std::string& constant(std::uint32_t i, double value);
  const std::string& input_again(std::uint32_t i, const Node& node);
  void wait_in_memory(std::uint32_t node);
  void read_again(std::uint32_t node);
  bool rounds_product(std::uint32_t node) const;
  void declare_constants();

  const FlatLayout& layout_;
  const program::Computation& computation_;
  const program::Dag& dag_;
  const FlatOptions& options_;
  const FlatPlan& plan_;
  std::string prefix_, upper_;
  bool block_form_;
  std::string scalar_, suffix_;  // "float", "f" behind the names of functions
  std::string type_;             // of a value
  std::string constant_;         // what its declaration begins with
  std::vector<std::string> arrays_;
  std::vector<std::string> touched_;  // arrays, and n, that the code names
  std::vector<std::string> names_;    // of nodes; empty: not emitted yet
  std::string expression_;            // of the statement that is being written
  bool zero_ = false;
  FlatParts parts_;

  // What can be read again: "t17", "kept[3]"; a constant: "0.5", "NUMBER(3, 0.5)".
  struct InMemory {
    std::string name, place;
  };
  InMemory& in_memory(std::uint32_t node);
  std::vector<std::uint32_t> memory_of_;  // of a node, in:
  std::deque<InMemory> memory_;           // it grows while texts of it are in use

  // Of stages. All empty where values need not wait in memory.
  bool stages_;
  std::uint32_t step_ = 0;
  int middle_of_inputs_ = 0;           // where `inputs` points to; 0: there is no such pointer
  std::vector<std::uint32_t> named_;   // nodes read from memory in this stage
  std::vector<std::string> pointers_;  // to the arrays that they lie in
  ConstantTable table_;

  CNames given_ = {"in",   "out",    "state",   "held",    "n",       "kept",   "angle",
                   "sine", "cosine", "lane",    "zero",    "result",  "y",      "a",
                   "b",    "x",      "a_lanes", "b_lanes", "x_lanes", "y_lanes"};
  FlatBody result_;
  CodeBlock* block_ = &result_.code;
};

}  // namespace sinew::backend
