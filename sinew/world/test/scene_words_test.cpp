// What is saved as JSON-LD has a word for everything of ours, as a person would write it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>

#include "every_kind.h"
#include "sinew/model/load.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/jsonld/write.h"
#include "sinew/world/copy_declarations.h"
#include "sinew/world/scene.h"

namespace sinew::world {
namespace {

std::string saved(const graph::Store& store) {
  const catalogue::Catalogue catalogue;
  jsonld::WriteOptions options;
  options.contexts = scene_contexts();
  options.prefixes = {{"cell", "https://w3id.org/sinew/examples/assembly_cell#"},
                      {"x", "http://x/"}};
  return jsonld::Writer(catalogue, options).write_all(store.view());
}

// Keys and types that are not words: prefixed, or absolute.
std::vector<std::string> without_a_word(const std::string& text) {
  std::vector<std::string> found;
  const std::regex key(R"re("([^"\s]*:[^"\s]*)"\s*:)re");
  const std::regex type(R"re("@type":\s*(\[[^\]]*\]|"[^"]*"))re");
  const auto each = [&](const std::regex& pattern, const auto& take) {
    for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
      take((*at)[1].str());
    }
  };
  each(key, [&](const std::string& word) { found.push_back(word); });
  each(type, [&](const std::string& types) {
    if (types.find(':') != std::string::npos) found.push_back(types);
  });
  return found;
}

TEST(SceneWords, WhatHasNoneIsFound) {
  EXPECT_EQ(without_a_word(R"({"@type": "w:Odd", "w:size": 3, "size": "x:y"})"),
            (std::vector<std::string>{"w:size", "\"w:Odd\""}));
}

TEST(SceneWords, TheAssemblyCellIsSavedInThem) {
  graph::Store store;
  graph::Places places;
  Report report;
  std::vector<std::filesystem::path> paths;
  for (const char* file : {"scene", "shapes", "components"}) {
    paths.emplace_back(std::string(SINEW_SOURCE_DIR "/examples/assembly_cell/") + file + ".jsonld");
  }
  model::load_files(paths, {}, store, places, report);
  World world;
  load_scene(world, store, places, report);
  const DeclaredScene scene = read_scene(world, store, places, report);
  ASSERT_FALSE(report.has_errors()) << to_string(report.problems().front());
  graph::Store out;
  write_scene(world, scene, out, report);
  EXPECT_GT(copy_declarations(store, out), 10u);
  const std::string text = saved(out);
  // A list of lists is written without its word: the writer knows words for lists of one kind.
  EXPECT_EQ(without_a_word(text), std::vector<std::string>{"w:outline"});
  EXPECT_NE(text.find("\"measured-by\""), std::string::npos);
}

TEST(SceneWords, EveryKindThatThereIsHasThem) {
  Everything all;
  graph::Store out;
  Report report;
  write_scene(all.world, {}, out, report);
  const std::string text = saved(out);
  EXPECT_EQ(without_a_word(text), std::vector<std::string>());
  for (const char* word :
       {"placement", "Revolute", "Prismatic", "Property", "numbers", "system", "blocks", "library",
        "prototype", "realtime", "rates", "accelerations", "angular-rate", "expiry", "size"}) {
    EXPECT_NE(text.find("\"" + std::string(word) + "\""), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace sinew::world
