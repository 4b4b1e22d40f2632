#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "sinew/base/error.h"
#include "sinew/rdf/results/compare.h"
#include "sinew/rdf/results/formats.h"
#include "sinew/rdf/results/table.h"

// The first byte chooses the format. What is read must survive being written in that format, unless
// the writer says why it cannot.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew::rdf;
  if (size == 0) return 0;
  const auto format = static_cast<ResultFormat>(data[0] % 4);
  sinew::graph::Terms terms;
  try {
    const ResultSet results =
        read_results({reinterpret_cast<const char*>(data) + 1, size - 1}, format, "fuzz", terms);
    write_table(results, terms, {});
    const std::string text = write_results(results, format, terms);
    const ResultSet again = read_results(text, format, "written", terms);
    if (compare_results(results, again, true, terms).likeness == Likeness::kDifferent) {
      std::fprintf(stderr, "changed by writing:\n%s\n", text.c_str());
      std::abort();
    }
  } catch (const sinew::Error&) {  // an answer too
  }
  return 0;
}
