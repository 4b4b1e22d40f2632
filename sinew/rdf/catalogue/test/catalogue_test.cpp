#include "sinew/rdf/catalogue/catalogue.h"

#include <gtest/gtest.h>

#include <fstream>

#include "sinew/base/error.h"

namespace sinew::catalogue {
namespace {

namespace fs = std::filesystem;

class CatalogueDirectory : public testing::Test {
 protected:
  void SetUp() override {
    directory_ =
        fs::path(testing::TempDir()) /
        ("catalogue_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(directory_);
    fs::create_directories(directory_ / "x");
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(directory_ / name) << text;
  }
  Problem fault() {
    Catalogue catalogue = Catalogue::without_metamodels();
    try {
      catalogue.add_directory(directory_);
    } catch (const Error& error) {
      return error.problems().front();
    }
    return {};
  }
  fs::path directory_;
};

TEST(Catalogue, ShipsThePublishedContexts) {
  const Catalogue catalogue;
  for (const char* file :
       {"geometry/structural-entities.json", "geometry/spatial-relations.json",
        "geometry/coordinates.json", "kinematic-chain/structural-entities.json",
        "kinematic-chain/state.json", "newtonian-rigid-body-dynamics/structural-entities.json",
        "newtonian-rigid-body-dynamics/coordinates.json", "algorithm.json", "qudt.json"}) {
    const Document* document = catalogue.find(std::string(kPublishedMetamodels) + file);
    ASSERT_NE(document, nullptr) << file;
    EXPECT_NE(document->text.find("@context"), std::string_view::npos) << file;
    EXPECT_EQ(document->file, std::string("metamodels/") + file);
  }
  EXPECT_EQ(catalogue.find("https://example.org/unknown.json"), nullptr);
}

TEST_F(CatalogueDirectory, WithoutIndexStandsInForThePublishedMetamodels) {
  write("x/y.json", "{}");
  write("x/readme.txt", "not a document");
  Catalogue catalogue = Catalogue::without_metamodels();
  catalogue.add_directory(directory_);
  ASSERT_EQ(catalogue.documents().size(), 1u);
  const Document* document = catalogue.find(std::string(kPublishedMetamodels) + "x/y.json");
  ASSERT_NE(document, nullptr);
  EXPECT_EQ(document->text, "{}");
  EXPECT_EQ(document->file, (directory_ / "x/y.json").string());
}

TEST_F(CatalogueDirectory, IndexNamesFilesAndFolders) {
  write("catalog.json", R"({"https://e.org/a": "x/a.json", "https://f.org/": "x"})");
  write("x/a.json", "1");
  write("x/b.ttl", "2");
  Catalogue catalogue = Catalogue::without_metamodels();
  catalogue.add_directory(directory_);
  EXPECT_EQ(catalogue.find("https://e.org/a")->text, "1");
  EXPECT_EQ(catalogue.find("https://f.org/a.json")->text, "1");
  EXPECT_EQ(catalogue.find("https://f.org/b.ttl")->text, "2");
}

TEST_F(CatalogueDirectory, WinsOverWhatWasThereBefore) {
  fs::create_directories(directory_ / "geometry");
  write("geometry/coordinates.json", "mine");
  Catalogue catalogue;
  catalogue.add_directory(directory_);
  const std::string iri = std::string(kPublishedMetamodels) + "geometry/coordinates.json";
  EXPECT_EQ(catalogue.find(iri)->text, "mine");
}

TEST_F(CatalogueDirectory, SaysWhereItsIndexIsWrong) {
  write("catalog.json", "{\n \"https://e.org/a\": \"missing.json\"}");
  EXPECT_EQ(fault().place.line, 2u);
  EXPECT_EQ(fault().iri, "https://e.org/a");
  EXPECT_NE(fault().what.find("there is no file"), std::string::npos);
  write("catalog.json", R"({"https://e.org/a": "../other.json"})");
  EXPECT_NE(fault().what.find("leads out"), std::string::npos);
  write("catalog.json", R"({"https://e.org/a": 3})");
  EXPECT_NE(fault().what.find("not a string"), std::string::npos);
  write("catalog.json", "[]");
  EXPECT_NE(fault().what.find("one JSON object"), std::string::npos);
  write("catalog.json", R"({"https://e.org/": "x/no"})");
  EXPECT_NE(fault().what.find("there is no directory"), std::string::npos);
}

TEST(Catalogue, RefusesADirectoryThatDoesNotExist) {
  Catalogue catalogue;
  EXPECT_THROW(catalogue.add_directory("/no/such/directory"), Error);
}

}  // namespace
}  // namespace sinew::catalogue
