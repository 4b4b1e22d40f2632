// Loading and normalising in one step, for tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "sinew/model/load.h"
#include "sinew/model/normalise.h"

namespace sinew::model::test {

inline std::filesystem::path shared() { return SINEW_SHARED_DIR; }

inline std::vector<std::filesystem::path> published_gen3() {
  const auto folder = shared() / "models/kinova/gen3/7dof";
  return {folder / "mounting-upright.geom.json", folder / "robot.dyn.json",
          folder / "robot.geom.json", folder / "robot.kin-chain.json"};
}

// Skips the test, with the reason, where material outside the project is missing.
#define SINEW_NEEDS(file)                                                 \
  if (!std::filesystem::exists(file)) {                                   \
    GTEST_SKIP() << "the test material is not here: " << (file).string(); \
  }

// A model in a store, and what was reported.
struct Model {
  graph::Store store;
  graph::Places places;
  Report report;
  Tree tree;

  std::string problems() const {
    std::string text;
    for (const Problem& problem : report.problems()) text += to_string(problem) + "\n";
    return text;
  }
  Id iri(std::string_view text) { return store.terms().iri(text); }
  // The frame, link or joint whose IRI ends so.
  const Tree::Frame* frame(std::string_view end) const {
    for (const Tree::Frame& f : tree.frames) {
      if (store.terms().text(f.iri).ends_with(end)) return &f;
    }
    return nullptr;
  }
};

inline void load_and_normalise(Model& model, const std::vector<std::filesystem::path>& files,
                               const NormaliseOptions& options = {}) {
  load_files(files, {}, model.store, model.places, model.report);
  if (model.report.has_errors()) return;
  model.tree = normalise(model.store, model.places, options, model.report);
}

}  // namespace sinew::model::test
