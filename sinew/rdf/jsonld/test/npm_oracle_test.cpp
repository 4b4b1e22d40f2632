// The published models mean the same to us as to npm's jsonld, with the contexts of both ages.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "sinew/graph/store.h"
#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/json/writer.h"
#include "sinew/rdf/jsonld/processor.h"
#include "sinew/rdf/turtle/reader.h"

namespace sinew::jsonld {
namespace {

namespace fs = std::filesystem;
using graph::Quad;

const fs::path kModels = fs::path(SINEW_SHARED_DIR) / "models";

std::string read(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string output_of(const std::string& command) {
  std::string output;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    output.append(buffer.data(), count);
  }
  pclose(pipe);
  return output;
}

std::vector<fs::path> files() {
  std::vector<fs::path> result;
  for (const char* folder : {"kinova/gen3/7dof", "tutorial"}) {
    for (const auto& entry : fs::directory_iterator(kModels / folder)) {
      if (entry.path().extension() == ".json") result.push_back(entry.path());
    }
  }
  return result;
}

class NpmOracle : public testing::TestWithParam<const char*> {
 protected:
  static void SetUpTestSuite() {
    // Installed once, into the build directory.
    if (!fs::exists(modules() / "jsonld")) {
      const std::string install = "npm install --no-audit --no-fund --silent --prefix '" +
                                  modules().parent_path().string() + "' jsonld@8 >/dev/null 2>&1";
      available_ = std::system("command -v node npm >/dev/null 2>&1") == 0 &&
                   std::system(install.c_str()) == 0;
    }
    available_ = available_ && fs::exists(modules() / "jsonld");
  }

  void SetUp() override {
    if (!fs::exists(kModels)) GTEST_SKIP() << "no published models at " << kModels;
    if (!available_) GTEST_SKIP() << "npm's jsonld cannot be installed here";
    catalogue_.add_directory(kModels / GetParam());
  }

  static fs::path modules() { return fs::path(SINEW_BINARY_DIR) / "npm" / "node_modules"; }

  // The answer for each file.
  std::vector<json::Document> ask(const std::string& operation,
                                  const std::vector<fs::path>& files) {
    std::string command = "node '" SINEW_SOURCE_DIR "/sinew/rdf/jsonld/test/npm_oracle.mjs' '" +
                          modules().string() + "' " + operation + " " +
                          std::string(catalogue::kPublishedMetamodels) + " '" +
                          (kModels / GetParam()).string() + "'";
    for (const fs::path& file : files) command += " '" + file.string() + "'";
    std::istringstream lines(output_of(command));
    std::vector<json::Document> answers;
    for (std::string line; std::getline(lines, line);) answers.push_back(json::read(line, "npm"));
    EXPECT_EQ(answers.size(), files.size());
    answers.resize(files.size());
    return answers;
  }

  static inline bool available_ = true;
  catalogue::Catalogue catalogue_ = catalogue::Catalogue::without_metamodels();
};

// Calls process(), and compares its Error, if there is one, with npm's. False after an Error.
template <typename Process>
bool fails_alike(const fs::path& file, const json::Document& answer, Process&& process) {
  try {
    process();
  } catch (const Error& error) {
    const json::Value* code = answer.root.find("error");
    EXPECT_TRUE(code != nullptr && code->is_string(error.problems().front().code))
        << file << ": " << error.what() << "\nbut npm: " << json::to_text(answer.root);
    return true;
  }
  EXPECT_NE(answer.root.find("result"), nullptr) << file << ": " << json::to_text(answer.root);
  return answer.root.find("result") == nullptr;
}

std::string url_of(const fs::path& file) {
  return "https://example.org/" + file.filename().string();
}

// The same text for documents that differ only in the order of sets.
std::string normal_form(const json::Value& value, bool in_list = false) {
  std::vector<std::string> parts;
  for (const json::Value& item : value.items()) parts.push_back(normal_form(item, in_list));
  if (!in_list) std::sort(parts.begin(), parts.end());
  if (value.is_array()) return "[" + fmt::format("{}", fmt::join(parts, ",")) + "]";
  if (!value.is_object()) return json::to_canonical_text(value);
  for (const json::Member& member : value.members()) {
    parts.push_back(std::string(member.name()) + ":" +
                    normal_form(member.value, member.name() == "@list"));
  }
  std::sort(parts.begin(), parts.end());
  return "{" + fmt::format("{}", fmt::join(parts, ",")) + "}";
}

TEST_P(NpmOracle, GivesTheSameGraphForThePublishedModels) {
  const auto answers = ask("toRdf", files());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const fs::path file = files()[i];
    const json::Document document = json::read(read(file), file.string());
    graph::Terms terms;
    std::vector<Quad> ours, theirs;
    if (fails_alike(file, answers[i], [&] {
          Processor(catalogue_).to_rdf(document, url_of(file), terms, [&](const Quad& quad) {
            ours.push_back(quad);
          });
        })) {
      continue;
    }
    rdf::read_rdf(answers[i].root.find("result")->text(), rdf::Syntax::kNQuads, {"npm", "", {}},
                  terms,
                  [&](const Quad& quad, std::size_t, std::size_t) { theirs.push_back(quad); });
    EXPECT_EQ(rdf::compare_quads(ours, theirs, terms).difference, "") << file;
  }
}

TEST_P(NpmOracle, FlattensThePublishedModelsTheSameWay) {
  const auto answers = ask("flatten", files());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const fs::path file = files()[i];
    const json::Document document = json::read(read(file), file.string());
    Processor processor(catalogue_);
    json::Value ours;
    if (fails_alike(file, answers[i],
                    [&] { ours = processor.flatten(document, url_of(file), {}); })) {
      continue;
    }
    EXPECT_EQ(normal_form(ours), normal_form(*answers[i].root.find("result"))) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(WithContextsOf, NpmOracle,
                         testing::Values("metamodels", "metamodels-2023-10"), [](const auto& info) {
                           return std::string(info.param) == "metamodels" ? "Head" : "October2023";
                         });

}  // namespace
}  // namespace sinew::jsonld
