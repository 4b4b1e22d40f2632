// What writes the statements of a flat function with limbs side by side; internal to `backend`. Its
// parts:
//   c_flat_limbs.cpp        nodes, inputs, results
//   c_flat_limb_angles.cpp  sines and cosines
//   c_flat_limb_memory.cpp  values that wait in memory, constants in a table
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/backend/c_constant_table.h"
#include "sinew/backend/c_flat_limb_steps.h"
#include "sinew/backend/c_flat_limbs.h"
#include "sinew/backend/c_names.h"
#include "sinew/backend/kept_values.h"

namespace sinew::backend {

class LimbEmitter {
 public:
  LimbEmitter(const program::LimbProgram& program, const FlatLayout& layout,
              const FlatOptions& options);

  LimbBody run();

 private:
  using Node = program::Node;
  using Ref = program::Ref;
  using Source = program::LimbSource;
  using Sources = std::vector<program::LimbSource>;

  // Lines and names.
  const program::LimbRegion& region() const { return program_.regions[at_]; }
  const program::Dag& dag() const { return region().computation.dag; }
  bool in_lanes() const { return region().lanes > 1; }
  unsigned lanes() const { return program::vector_width(region().lanes); }
  const std::string& type() const { return types_[at_]; }
  void line(std::string_view text, std::uint32_t origin = program::kNoOrigin);
  std::string number(double value) const { return scalar_number(value, options_.scalar); }

  // Nodes.
  std::string element(const FlatPlace& place) const;
  std::string text(const Source& source);
  bool is_zero(const Source& source) const;
  template <typename Lane>
  std::string vector(Lane lane) const;
  std::string zero();
  std::string input(const Node& node);
  std::optional<std::string> same_vector(const Sources& sources);
  const std::string& value(std::uint32_t i);
  std::string value(Ref ref) { return (ref.negative() ? "-" : "") + value(ref.node()); }
  void compute(std::uint32_t i, const Node& node);
  std::string express(const Node& n);
  template <typename Formula>
  std::string lane_by_lane(const std::vector<Ref>& operands, Formula formula);

  // Results.
  void find_results();
  void write(std::uint32_t k);
  void write_later_results();
  void write_results(std::uint32_t node);

  // Sines and cosines.
  struct Numbers {  // of an array, from this one on
    std::string array;
    int at;
  };
  void take_sines(std::uint32_t angle, const Numbers& sines, const Numbers& cosines, bool again);
  void sine_of(std::uint32_t angle);
  void sines_of_inputs();

  // Values that wait in memory (c_flat_limb_memory.cpp).
  void declare_kept(const std::vector<std::vector<std::uint32_t>>& orders);
  void point_to_inputs(const std::vector<std::vector<std::uint32_t>>& orders);
  void point_to(const std::string& pointer);
  void begin_step();
  void end_step();
  bool is_constant(const Node& node) const;
  const std::vector<std::string>& numbers(std::uint32_t i, const Node& node);
  void constant(std::uint32_t i, const Node& node, std::string& text);
  void declare_constants();
  void wait_in_memory(std::uint32_t node);
  const std::string& name_of(std::size_t region, std::uint32_t node);
  std::string lane_of(std::size_t region, std::uint32_t node, std::uint32_t lane);

  const program::LimbProgram& program_;
  const FlatLayout& layout_;
  const FlatOptions& options_;
  std::string upper_, scalar_, suffix_;
  std::vector<std::string> types_;               // of each region's values
  std::vector<std::vector<std::string>> names_;  // [region][node]: or the text of a constant
  std::vector<std::vector<std::uint8_t>> live_;
  // Results that are written with a value: the first of them, and the one after each.
  std::vector<std::uint32_t> result_of_, next_result_;
  std::vector<std::uint32_t> later_;  // results that no region computes
  std::size_t at_ = 0;                // the region
  std::size_t groups_ = 0;

  // What is read from memory wherever it is used.
  struct InMemory {
    std::string name, array;
    int place = 0;
  };
  LimbNodes nodes_;
  KeptValues kept_;  // empty where no value need wait
  std::size_t step_ = 0;
  int middle_of_inputs_ = 0;           // where `inputs` points to; 0: there is no such pointer
  std::vector<std::string> pointers_;  // to what waits there, and to sines
  InMemory& put_in_memory(std::uint32_t value);
  bool is_in_memory(std::uint32_t value) const { return memory_of_[value] != kNoSlot; }
  const InMemory& in_memory(std::uint32_t value) const { return memory_.at(memory_of_[value]); }
  std::vector<std::uint32_t> memory_of_;  // of a value, in:
  std::vector<InMemory> memory_;
  std::vector<std::string*> waiting_;                         // names of values that are kept
  std::vector<std::pair<std::size_t, std::uint32_t>> named_;  // read in this stage

  ConstantTable table_;                              // where kept_ is not empty
  std::vector<std::vector<std::string>> constants_;  // [node of any region][lane], once it is used

  std::map<unsigned, std::string> zeros_;  // by width: a vector of zeros
  CNames given_ = {"in", "out", "angle", "sine", "cosine", "sines", "cosines"};
  LimbBody body_;
};

}  // namespace sinew::backend
