// A fault in a model must never become code: each of these models is refused with exit code 1, a
// place, the remedy, and no output.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <regex>

#include "command.h"

namespace sinew::test {
namespace {

using Json = nlohmann::ordered_json;
using Documents = std::vector<Json>;

bool has_type(const Json& node, const std::string& type) {
  if (!node.is_object() || !node.contains("@type")) return false;
  const Json& types = node["@type"];
  if (types.is_string()) return types == type;
  return std::find(types.begin(), types.end(), type) != types.end();
}

// The n-th node of a type over all documents, in order.
Json& node_of_type(Documents& documents, const std::string& type, int n = 0) {
  for (Json& document : documents) {
    for (Json& node : document["@graph"]) {
      if (has_type(node, type) && n-- == 0) return node;
    }
  }
  throw std::runtime_error("no node of type " + type);
}

struct Fault {
  std::string name;
  std::function<void(Documents&)> make;
  std::string expected;  // regular expression that standard error must match
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

const Fault kFaults[] = {
    {"joint without attachments",
     [](Documents& d) { node_of_type(d, "Joint", 3).erase("between-attachments"); }, "attachment"},
    {"joint with one attachment",
     [](Documents& d) { node_of_type(d, "Joint", 3)["between-attachments"].erase(0); },
     "attachment"},
    {"two coordinates for one pose",
     [](Documents& d) {
       Json& first = node_of_type(d, "PoseCoordinate", 2);
       Json second = first;
       second["@id"] = first["@id"].get<std::string>() + "-again";
       second["x"] = 0.75;
       for (Json& document : d) {
         for (Json& node : document["@graph"]) {
           if (node["@id"] == first["@id"]) {
             document["@graph"].push_back(second);
             return;
           }
         }
       }
     },
     "coordinates"},
    {"missing unit", [](Documents& d) { node_of_type(d, "PoseCoordinate", 2).erase("unit"); },
     "unit"},
    {"wrong dimension",
     [](Documents& d) { node_of_type(d, "PoseCoordinate", 2)["unit"] = "KiloGM"; }, "KiloGM"},
    {"negative mass",
     [](Documents& d) { node_of_type(d, "RigidBodyInertiaCoordinate", 2)["mass"] = -1.0; }, "mass"},
    {"triangle inequality",
     [](Documents& d) { node_of_type(d, "RigidBodyInertiaCoordinate", 2)["izz"] = 9.0; },
     "triangle"},
    {"no rotation matrix",
     [](Documents& d) {
       node_of_type(d, "PoseCoordinate", 2)["direction-cosine-x"] = {2.0, 0.0, 0.0};
     },
     "right-handed|orthogonal"},
    {"mirrored rotation matrix",
     [](Documents& d) {
       for (Json& x : node_of_type(d, "PoseCoordinate", 2)["direction-cosine-x"]) {
         x = -x.get<double>();
       }
     },
     "right-handed|orthogonal"},
    {"number where a list should be",
     [](Documents& d) { node_of_type(d, "PoseCoordinate", 2)["direction-cosine-x"] = 1.0; },
     "direction-cosine-x"},
    {"missing number", [](Documents& d) { node_of_type(d, "PoseCoordinate", 2).erase("y"); }, "y"},
    {"unknown term",
     [](Documents& d) { node_of_type(d, "RigidBodyInertiaCoordinate", 1)["masss"] = 1.0; },
     "masss"},
    {"unknown context",
     [](Documents& d) {
       Json& context = d.front()["@context"];
       context.insert(context.begin(), "https://example.org/nowhere.json");
     },
     "https://example.org/nowhere.json"},
    {"kinematic loop",
     [](Documents& d) {
       Json joint = node_of_type(d, "Joint", 6);
       joint["@id"] = joint["@id"].get<std::string>() + "-loop";
       const std::string first = node_of_type(d, "Joint", 0)["between-attachments"][0];
       joint["between-attachments"][0] = first;
       for (Json& document : d) {
         for (Json& node : document["@graph"]) {
           if (has_type(node, "Joint")) {
             document["@graph"].push_back(joint);
             return;
           }
         }
       }
     },
     "loop"},
};

class FaultyModel : public testing::TestWithParam<Fault> {};

// Asks for RNEA and checks that nothing comes out but an error that matches.
void expect_refused(const Folder& folder, const std::vector<std::string>& files,
                    const std::string& expected, const std::vector<std::string>& options = {}) {
  std::vector<std::string> arguments{"generate"};
  arguments.insert(arguments.end(), files.begin(), files.end());
  arguments.insert(arguments.end(),
                   {"--solver", "rnea", "--name", "f", "-o", (folder / "out").string()});
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Result result = run_sinew(arguments, 20);
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_TRUE(std::regex_search(result.err, std::regex(expected))) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "f.c"));
}

Documents gen3_documents() {
  Documents documents;
  for (const auto& file : gen3_models()) documents.push_back(Json::parse(read_file(file)));
  return documents;
}

// Writes the documents as model0.jsonld, model1.jsonld, ... and returns their paths.
std::vector<std::string> write_models(const Folder& folder, const Documents& documents) {
  std::vector<std::string> files;
  for (std::size_t i = 0; i < documents.size(); ++i) {
    const auto path = folder / ("model" + std::to_string(i) + ".jsonld");
    write_file(path, documents[i].dump(1));
    files.push_back(path.string());
  }
  return files;
}

TEST_P(FaultyModel, IsRefusedWithFileLineAndRemedy) {
  const Folder folder;
  Documents documents = gen3_documents();
  ASSERT_FALSE(documents.empty());
  GetParam().make(documents);
  expect_refused(folder, write_models(folder, documents),
                 R"(model\d\.jsonld:\d+: [^\n]*()" + GetParam().expected + ")");
}

INSTANTIATE_TEST_SUITE_P(Gen3, FaultyModel, testing::ValuesIn(kFaults), [](const auto& info) {
  return std::regex_replace(info.param.name, std::regex("[^a-z]"), "_");
});

std::vector<std::string> gen3_files() {
  std::vector<std::string> files;
  for (const auto& file : gen3_models()) files.push_back(file.string());
  return files;
}

TEST(FaultyQuery, NamesAnUnknownFrame) {
  const Folder folder;
  expect_refused(folder, gen3_files(), "no-such-link", {"--tip", "no-such-link"});
  expect_refused(folder, gen3_files(), "no-such-link", {"--base", "no-such-link"});
}

TEST(FaultyQuery, RefusesATipThatTheBaseDoesNotReach) {
  const Folder folder;
  // Without joint 4 the chain falls into two.
  Documents documents = gen3_documents();
  for (Json& document : documents) {
    Json& nodes = document["@graph"];
    for (std::size_t n = nodes.size(); n-- > 0;) {
      Json& node = nodes[n];
      const bool is_joint4 = has_type(node, "Joint") && node.value("@id", "").ends_with("joint4");
      if (is_joint4 || node.value("of-joint", "").ends_with("joint4")) {
        nodes.erase(n);
      } else if (has_type(node, "KinematicChain")) {
        Json& joints = node["joints"];
        for (std::size_t j = joints.size(); j-- > 0;) {
          if (joints[j].get<std::string>().ends_with("joint4")) joints.erase(j);
        }
      }
    }
  }
  const auto files = write_models(folder, documents);
  expect_refused(folder, files, "no joints lead", {"--base", "link0", "--tip", "link7"});
  expect_refused(folder, files, "root");  // and without --base there are two roots
}

TEST(FaultyUrdf, NamesTheBrokenTree) {
  const Folder folder;
  const std::string two_parents = R"(<?xml version="1.0"?>
<robot name="broken">
  <link name="a"/>
  <link name="b"/>
  <link name="c"/>
  <joint name="ab" type="continuous"><parent link="a"/><child link="c"/></joint>
  <joint name="bc" type="continuous"><parent link="b"/><child link="c"/></joint>
</robot>)";
  write_file(folder / "two.urdf", two_parents);
  expect_refused(folder, {(folder / "two.urdf").string()}, R"(two\.urdf:\d+)");

  const std::string missing_link = R"(<robot name="broken">
  <link name="a"/>
  <joint name="ab" type="continuous"><parent link="a"/><child link="nowhere"/></joint>
</robot>)";
  write_file(folder / "missing.urdf", missing_link);
  expect_refused(folder, {(folder / "missing.urdf").string()}, R"(missing\.urdf:\d+.*nowhere)");
}

TEST(FaultyFile, TruncatedJsonIsAnErrorWithItsLine) {
  const Folder folder;
  const auto files = write_models(folder, gen3_documents());
  const std::string text = read_file(files.front());
  write_file(files.front(), text.substr(0, text.size() / 2));
  expect_refused(folder, files, R"(model0\.jsonld:\d+)");
}

TEST(FaultyFile, HundredMegabytesOfNestedArraysEndInBoundedTime) {
  const Folder folder;
  write_file(folder / "deep.jsonld", std::string(100u << 20, '['));
  expect_refused(folder, {(folder / "deep.jsonld").string()}, R"(deep\.jsonld:1)");
}

TEST(FaultyFile, MissingFileIsNamed) {
  const Folder folder;
  expect_refused(folder, {(folder / "nowhere.jsonld").string()}, R"(nowhere\.jsonld)");
}

TEST(Usage, IsExitCodeTwo) {
  EXPECT_EQ(run_sinew({}).exit_code, 2);
  EXPECT_EQ(run_sinew({"generat"}).exit_code, 2);
  EXPECT_EQ(run_sinew({"generate"}).exit_code, 2);
  EXPECT_EQ(run_sinew({"generate", "x.jsonld", "--no-such-option"}).exit_code, 2);
}

TEST(Usage, NumbersThatAreNoneExitWithTwo) {
  EXPECT_EQ(run_sinew({"generate", "x.urdf", "--snap", "nan"}).exit_code, 2);
  EXPECT_EQ(run_sinew({"explain", "x.json", "0"}).exit_code, 2);
  EXPECT_EQ(run_sinew({"explain", "x.json", "-5"}).exit_code, 2);
}

TEST(Usage, EveryCommandHasHelp) {
  const Result overview = run_sinew({"--help"});
  EXPECT_EQ(overview.exit_code, 0);
  for (const std::string command : {"check", "import", "query", "update", "synth", "weave", "stats",
                                    "generate", "run", "bench", "explain"}) {
    EXPECT_NE(overview.out.find(command), std::string::npos) << command;
    EXPECT_EQ(run_sinew({command, "--help"}).exit_code, 0) << command;
  }
}

}  // namespace
}  // namespace sinew::test
