// Any text as a table of numbers: it is refused with an Error, or what is written from it reads
// back with the same columns and bits.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "../csv.h"
#include "sinew/base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew::cli;
  Table table;
  try {
    table = read_csv({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
  } catch (const sinew::Error&) {
    return 0;
  }
  const std::string text = write_csv(table);
  const Table again = read_csv(text, "written.csv");  // an Error here is a fault, and ends the run
  bool same = again.columns == table.columns && again.values.size() == table.values.size();
  for (std::size_t i = 0; same && i < table.values.size(); ++i) {
    const double a = table.values[i], b = again.values[i];
    same = std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
  }
  if (!same) {
    std::fprintf(stderr, "changed by writing:\n%s\n", text.c_str());
    std::abort();
  }
  return 0;
}
