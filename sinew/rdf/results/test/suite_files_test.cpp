// Every result file of the SPARQL suite is read, and survives being written in its format.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "sinew/base/error.h"
#include "sinew/rdf/results/compare.h"
#include "sinew/rdf/results/formats.h"

namespace sinew::rdf {
namespace {

TEST(ResultFilesOfTheSuite, SurviveBeingWritten) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(SINEW_SHARED_DIR) / "suites" / "sparql11";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "the suite is not in " << folder;
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto format = result_format_of_file(entry.path().string());
    if (!format) continue;
    ++count;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    graph::Terms terms;
    try {
      const ResultSet results = read_results(text, *format, entry.path().string(), terms);
      const std::string written = write_results(results, *format, terms);
      const ResultSet again = read_results(written, *format, "written", terms);
      const Comparison same = compare_results(results, again, true, terms);
      EXPECT_TRUE(same) << entry.path() << "\n" << same.difference << "\n" << written;
    } catch (const Error& error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GT(count, 200u);
}

}  // namespace
}  // namespace sinew::rdf
