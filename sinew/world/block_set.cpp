#include "sinew/world/block_set.h"

#include <algorithm>

#include "sinew/data/plan.h"
#include "sinew/world/refuse.h"

namespace sinew::world {

const char* const kCanonicalPrototypes = R"(
dproto sinew_world_quaternion :: geometry {
  semantic  = Orientation
  coord     = quaternion
  algebraic = quat_named
  ddr       = :: c99 { double[4] }
  dr        = { 0 = x, 1 = y, 2 = z, 3 = w }
}

dproto sinew_world_pose :: geometry {
  semantic  = Pose
  composes  = { Position = s_plain_position, Orientation = sinew_world_quaternion }
  usingddr  = :: c99 { struct sinew_world_pose { double orientation[4]; double position[3]; } }
  dr        = { position = Position, orientation = Orientation }
}
)";

namespace {

// Whether a type is nothing but so many doubles in a row.
bool is_doubles(const data::Type& type, std::uint32_t count) {
  if (type.size != count * sizeof(double)) return false;
  const std::vector<data::Accessor> numbers = data::list_accessors(type, count + 1);
  if (numbers.size() != count) return false;
  return std::all_of(numbers.begin(), numbers.end(), [&](const data::Accessor& path) {
    std::string why;
    const auto access = data::find_access(type, path, &why);
    return access && access->scalar == data::ScalarKind::kFloat64 && access->offsets.size() == 1;
  });
}

// Memory that may be copied byte by byte: no pointers into growing containers.
bool is_flat(const data::Type& type) {
  switch (type.kind) {
    case data::Type::Kind::kScalar:
    case data::Type::Kind::kMatrix:
      return true;
    case data::Type::Kind::kArray:
      return is_flat(*type.element);
    case data::Type::Kind::kStruct:
      return std::all_of(type.members.begin(), type.members.end(),
                         [](const data::Member& member) { return is_flat(*member.type); });
    case data::Type::Kind::kVector:
    case data::Type::Kind::kList:
    case data::Type::Kind::kOpaque:
    case data::Type::Kind::kJson:
      return false;
  }
  return false;
}

const data::Prototype& prototype(const data::Library& library, const std::string& iri,
                                 const std::string& name) {
  const auto index = library.find_prototype(name);
  if (!index) {
    refuse(
        iri, "there is no data prototype '" + name + "' in the library",
        "a prototype of the library; append kCanonicalPrototypes to its text for the world's own");
  }
  return library.prototypes[*index];
}

}  // namespace

std::optional<std::size_t> BlockSet::find(std::string_view name) const {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].name == name) return i;
  }
  return std::nullopt;
}

std::shared_ptr<const BlockSet> make_block_set(const std::string& measurement,
                                               const BlocksSpec& spec, bool is_pose,
                                               std::uint32_t values) {
  if (spec.blocks.empty()) return nullptr;
  if (!spec.library) refuse(measurement, "data blocks without a library of prototypes", "give one");
  if (spec.blocks.size() > kMaximumBlocksOfMeasurement) {
    refuse(measurement, std::to_string(spec.blocks.size()) + " data blocks",
           "at most " + std::to_string(kMaximumBlocksOfMeasurement));
  }
  std::string canonical = spec.canonical;
  if (canonical.empty()) {
    if (!is_pose) {
      refuse(measurement, "data blocks, and it is not said which prototype its numbers have",
             "name it: BlocksSpec::canonical");
    }
    canonical = kPosePrototype;
  }
  const data::Library& library = *spec.library;
  const data::Prototype& own = prototype(library, measurement, canonical);
  if (!own.representation.type || !is_doubles(*own.representation.type, values)) {
    refuse(measurement,
           "the prototype '" + canonical + "' of its numbers is not " + std::to_string(values) +
               " doubles in a row",
           "a c99 array or struct of doubles");
  }
  auto set = std::make_shared<BlockSet>();
  set->library = spec.library;
  set->spec = spec;
  for (const bool realtime : {true, false}) {
    for (const BlockSpec& block : spec.blocks) {
      if (block.realtime != realtime) continue;
      if (set->find(block.name)) refuse(block.name, "a data block declared twice", "once");
      const data::Prototype& target = prototype(library, block.name, block.prototype);
      if (!target.representation.type || !is_flat(*target.representation.type)) {
        refuse(block.name,
               "values of the prototype '" + block.prototype + "' have no memory of fixed size",
               "a prototype whose values can be copied byte by byte");
      }
      const std::size_t bytes = target.representation.type->size;
      if (bytes > kMaximumBlockBytes) {
        refuse(block.name, "a block of " + std::to_string(bytes) + " bytes",
               "at most " + std::to_string(kMaximumBlockBytes));
      }
      DataBlock made{.name = block.name,
                     .prototype = block.prototype,
                     .bytes = bytes,
                     .realtime = realtime,
                     .from_canonical = data::make_converter(
                         library, data::find_plan(library, canonical, block.prototype,
                                                  {.allow_lossy = block.allow_lossy})),
                     .to_canonical = {},
                     .why_derived = {}};
      try {
        made.to_canonical =
            data::make_converter(library, data::find_plan(library, block.prototype, canonical));
      } catch (const Error& error) {
        made.why_derived = error.problems().front().what;
      }
      set->blocks.push_back(std::move(made));
    }
  }
  return set;
}

void convert(const DataBlock& block, const double* canonical, double* numbers) {
  numbers[block.words() - 1] = 0;  // bytes of its last word that the value does not fill
  block.from_canonical.run(canonical, numbers);
}

}  // namespace sinew::world
