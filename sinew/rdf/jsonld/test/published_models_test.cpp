// The published models load unchanged, with Sinew's own contexts and with the published ones.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "sinew/graph/store.h"
#include "sinew/rdf/jsonld/load.h"

namespace sinew::jsonld {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = fs::path(SINEW_SHARED_DIR) / "models";
constexpr const char* kGen3[] = {
    "kinova/gen3/7dof/mounting-upright.geom.json", "kinova/gen3/7dof/robot.geom.json",
    "kinova/gen3/7dof/robot.kin-chain.json", "kinova/gen3/7dof/robot.dyn.json"};

std::string read(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class PublishedModels : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kModels)) GTEST_SKIP() << "no published models at " << kModels;
  }

  std::size_t load(const catalogue::Catalogue& catalogue, bool lenient) {
    // The published contexts leave some types undefined, which then are relative to the document.
    LoadOptions options;
    options.lenient = lenient;
    if (lenient) options.base = "https://comp-rob2b.github.io/robots/kinova/gen3/7dof/model.json";
    Loader loader(catalogue, options);
    for (const char* name : kGen3) {
      const std::string text = read(kModels / name);
      loader.load(
          text, (kModels / name).string(), terms_,
          [this](const graph::Quad& quad) { quads_.insert(quad); }, &places_, report_);
    }
    return quads_.size();
  }

  graph::Terms terms_;
  graph::Places places_;
  Report report_;
  std::set<graph::Quad> quads_;
};

TEST_F(PublishedModels, Gen3LoadsWithOurContextsWithoutAnyFault) {
  EXPECT_GE(load(catalogue::Catalogue(), false), 1330u);
  for (const Problem& problem : report_.problems()) ADD_FAILURE() << to_string(problem);
}

TEST_F(PublishedModels, Gen3GivesTheKnownNumberOfTriplesWithThePublishedContexts) {
  catalogue::Catalogue head = catalogue::Catalogue::without_metamodels();
  head.add_directory(kModels / "metamodels");
  EXPECT_EQ(load(head, true), 1296u);
  EXPECT_FALSE(report_.problems().empty());
}

TEST_F(PublishedModels, Gen3GivesTheKnownNumberOfTriplesWithTheContextsOf2023) {
  catalogue::Catalogue old = catalogue::Catalogue::without_metamodels();
  old.add_directory(kModels / "metamodels-2023-10");
  EXPECT_EQ(load(old, true), 1330u);
}

}  // namespace
}  // namespace sinew::jsonld
