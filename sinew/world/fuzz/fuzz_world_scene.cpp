// Any scene that is read is refused with a report, or is a world that is written and read again.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sinew/model/load.h"
#include "sinew/rdf/turtle/writer.h"
#include "sinew/world/copy_declarations.h"
#include "sinew/world/declared_triggers.h"
#include "sinew/world/scene.h"

using namespace sinew;

namespace {

struct Loaded {
  graph::Store store;
  graph::Places places;
  Report report;
  world::World world;
  world::DeclaredScene scene;
  std::vector<world::DeclaredTrigger> triggers;

  explicit Loaded(std::string text) {
    const model::Source source{"fuzz.ttl", std::move(text)};
    model::load({&source, 1}, {}, store, places, report);
    if (!report.has_errors()) world::load_scene(world, store, places, report);
    if (report.has_errors()) return;
    scene = world::read_scene(world, store, places, report);
    triggers = world::read_triggers(world, scene, store, places, report);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 20'000) return 0;
  try {
    const Loaded first(std::string(reinterpret_cast<const char*>(data), size));
    if (first.report.has_errors()) return 0;
    graph::Store out;
    Report report;
    world::write_scene(first.world, first.scene, out, report);
    world::copy_declarations(first.store, out);
    const Loaded second(
        rdf::write_rdf(rdf::quads_of(out.view()), rdf::Syntax::kTurtle, out.terms()));
    if (second.report.has_errors()) std::abort();
    if (second.triggers.size() != first.triggers.size()) std::abort();
  } catch (const Error&) {  // an answer too
  }
  return 0;
}
