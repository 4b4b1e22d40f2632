// Any JSON-LD document as a task, and as a host of tasks: it is read, or refused with reasons;
// never more.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/model/load.h"
#include "sinew/task/host_model.h"
#include "sinew/task/read_task.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sinew::graph::Store store;
  sinew::graph::Places places;
  sinew::Report report;
  const sinew::model::Source source{"task.jsonld",
                                    std::string(reinterpret_cast<const char*>(data), size)};
  try {
    sinew::model::load(std::span(&source, 1), {}, store, places, report);
    if (!report.has_errors()) {
      sinew::task::read_task(store, places, report);
      sinew::task::read_host(store, places, report);
    }
  } catch (const sinew::Error&) {  // an answer too
  }
  return 0;
}
