// The data blocks of one measurement: the same value in other prototypes (other units, other order,
// other memory layout), kept consistent by the conversion engine.
//
// The measurement's own numbers (its quantity's layout, SI units) are one more form, the
// *canonical* one. Whoever writes one form writes all: the value is converted to the canonical
// form, from there to every block, real-time blocks first, and all become visible at one instant. A
// block from which no conversion leads back is derived: it can be read only.
//
// Blocks hold the latest value; the measurement keeps the history. Converting allocates nothing and
// does a bounded number of operations, so real-time handles keep blocks consistent as well.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/data/engine.h"
#include "sinew/data/library.h"
#include "sinew/world/cell.h"

namespace sinew::world {

struct BlockSpec {
  std::string name;          // IRI
  std::string prototype;     // of the library
  bool realtime = false;     // converted first
  bool allow_lossy = false;  // converting into it may lose something: digits, in a float
};

// What the blocks of a measurement are made of; see MeasurementSpec.
struct BlocksSpec {
  std::shared_ptr<const data::Library> library = nullptr;
  // The prototype of the measurement's own numbers: an array or struct of that many doubles. Empty:
  // kPosePrototype, for poses.
  std::string canonical = {};
  std::vector<BlockSpec> blocks = {};
  std::string library_text = {};  // in the block language, for scenes that are written (scene.h)
};

// The declarations of the canonical forms, in the block language: to be appended to the text of a
// library whose prototypes are to be blocks of a world.
extern const char* const kCanonicalPrototypes;
inline constexpr const char* kPosePrototype = "sinew_world_pose";

inline constexpr std::size_t kMaximumBlockBytes = kMaximumValues * sizeof(double);
inline constexpr std::size_t kMaximumBlocksOfMeasurement = 32;

struct DataBlock {
  std::string name, prototype;
  std::size_t bytes = 0;
  bool realtime = false;
  data::Converter from_canonical;
  std::optional<data::Converter> to_canonical;  // none: derived, with the reason below
  std::string why_derived;
  std::uint32_t words() const { return static_cast<std::uint32_t>((bytes + 7) / 8); }
};

struct BlockSet {
  std::shared_ptr<const data::Library> library;
  BlocksSpec spec;                // that it was made of
  std::vector<DataBlock> blocks;  // real-time blocks first, otherwise as declared
  std::optional<std::size_t> find(std::string_view name) const;
};

// Entries that a block's ring keeps, so that readers are not overtaken at once.
inline constexpr std::uint32_t kBlockCapacity = 8;

// Checks and prepares all conversions. Throws Error naming the block and its prototype.
std::shared_ptr<const BlockSet> make_block_set(const std::string& measurement,
                                               const BlocksSpec& spec, bool is_pose,
                                               std::uint32_t values);

// A block's bytes, made from the canonical numbers, as the numbers of its cell; no number is looked
// at. `numbers` has room for block.words().
void convert(const DataBlock& block, const double* canonical, double* numbers);

}  // namespace sinew::world
