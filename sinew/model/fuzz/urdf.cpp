// Any text as a URDF: read, imported, checked and normalised. Nothing may crash, hang, or grow
// without bounds; errors are what most inputs end in.
#include "sinew/model/urdf.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sinew/model/check.h"
#include "sinew/model/normalise.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew;
  graph::Store store;
  graph::Places places;
  Report report;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  {
    graph::Transaction transaction = store.begin();
    model::UrdfOptions options;
    options.lenient = size % 2 == 0;
    model::import_urdf(text, "fuzz.urdf", options, store.terms(), transaction, places, report);
    transaction.commit();
  }
  if (report.has_errors()) return 0;
  model::check_numbers(store, places, report);
  Report normalised;
  const model::Tree tree = model::normalise(store, places, {}, normalised);
  if (!normalised.has_errors()) model::write(tree, store);
  return 0;
}
