// Questions on the command line: ill-posed ones are refused with the IRI of what is at fault and
// the remedy, and several at once cost less than each by itself.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>

#include "command.h"

namespace sinew::test {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> with_gen3(std::vector<std::string> arguments,
                                   const std::vector<std::string>& options) {
  for (const auto& file : gen3_models()) arguments.push_back(file.string());
  arguments.insert(arguments.end(), options.begin(), options.end());
  return arguments;
}

// A query of Sinew's own, in a file, after a change; with the IRI https://example.org/query.
std::string query_file(const Folder& folder, const std::string& solver,
                       const std::function<void(Json&)>& change) {
  std::ifstream in(std::string(SINEW_SOURCE_DIR "/solvers/") + solver + ".json");
  Json query = Json::parse(in);
  query["@id"] = "https://example.org/query";
  change(query);
  write_file(folder / "query.json", query.dump(1));
  return (folder / "query.json").string();
}

void remove_driver(Json& query, const std::string& quantity) {
  Json& gives = query["gives"];
  for (std::size_t i = gives.size(); i-- > 0;)
    if (gives[i]["quantity"] == quantity) gives.erase(i);
}

void expect_match(const std::string& text, const std::string& expression) {
  EXPECT_TRUE(std::regex_search(text, std::regex(expression))) << text << "\nlacks " << expression;
}

TEST(IllPosedQuery, ThatLacksADriverIsRefusedByThePlannerAndByTheShape) {
  const std::pair<std::string, std::string> missing[] = {
      {"fpk", "joint-position"},  {"fvk", "joint-velocity"},     {"rnea", "joint-acceleration"},
      {"aba", "joint-force"},     {"bias", "joint-velocity"},    {"gravity", "gravity"},
      {"crba", "joint-position"}, {"momentum", "joint-velocity"}};
  for (const auto& [solver, driver] : missing) {
    SCOPED_TRACE(solver + " without " + driver);
    const Folder folder;
    const std::string file =
        query_file(folder, solver, [&](Json& query) { remove_driver(query, driver); });
    const Result checked = run_sinew({"check", file, "--only-shapes"});
    EXPECT_EQ(checked.exit_code, 1);
    expect_match(checked.err, "https://example.org/query");
    // Forces and accelerations follow from each other: the shape names either.
    expect_match(checked.err, driver == "joint-force" ? "joint-acceleration" : driver);
    if (driver == "gravity") continue;  // without it, the planner takes the base to rest in space
    const Result planned = run_sinew(with_gen3({"stats"}, {"--query", file}));
    EXPECT_EQ(planned.exit_code, 1);
    expect_match(planned.err, R"(query\.json:\d+: https://example\.org/query: .* without )" +
                                  driver + "; add " + driver);
  }
}

TEST(IllPosedQuery, NamesEveryDriverThatIsMissing) {
  const Folder folder;
  const std::string file = query_file(folder, "rnea", [](Json& query) {
    remove_driver(query, "joint-velocity");
    remove_driver(query, "joint-acceleration");
  });
  const Result planned = run_sinew(with_gen3({"stats"}, {"--query", file}));
  EXPECT_EQ(planned.exit_code, 1);
  expect_match(planned.err, "without joint-velocity");
  expect_match(planned.err, "without joint-acceleration");
}

TEST(IllPosedQuery, WithContradictoryDriversOnOneJointIsRefused) {
  const Folder folder;
  const std::string joint = "https://example.org/arm/joint1";
  const std::string file = query_file(folder, "rnea", [&](Json& query) {
    for (const std::string quantity : {"joint-force", "joint-acceleration"})
      query["gives"].push_back({{"@type", "Given"}, {"quantity", quantity}, {"of", joint}});
  });
  const Result checked = run_sinew({"check", file, "--only-shapes"});
  EXPECT_EQ(checked.exit_code, 1);
  expect_match(checked.err, "are both given: give one of them");
  const Result planned = run_sinew(with_gen3({"stats"}, {"--query", file}));
  EXPECT_EQ(planned.exit_code, 1);
  expect_match(planned.err, joint + ": .*contradict each other; give one of them");
}

TEST(IllPosedQuery, AboutAFrameThatIsNotThereSaysWhatThereIs) {
  const Result result =
      run_sinew(with_gen3({"stats"}, {"--solver", "fpk", "--ask", "pose of elbow"}));
  EXPECT_EQ(result.exit_code, 1);
  expect_match(result.err, "elbow: no frame or link of the tree has this name; .*link1");
}

TEST(IllPosedQuery, AboutDirectionsThatAQuantityDoesNotHaveIsRefused) {
  Result result = run_sinew(
      with_gen3({"stats"}, {"--solver", "fpk", "--ask", "pose of link7 wrt link3 seen-by link1"}));
  EXPECT_EQ(result.exit_code, 1);
  expect_match(result.err, "pose cannot be seen by link1; it is seen by the frame");
  result =
      run_sinew(with_gen3({"stats"}, {"--solver", "crba", "--ask", "mass-matrix seen-by link1"}));
  EXPECT_EQ(result.exit_code, 1);
  expect_match(result.err, "leave out with-respect-to and seen-by");
}

TEST(IllPosedQuery, WithAWrenchOnTheBaseThatDoesNotMoveIsRefused) {
  const Result result =
      run_sinew(with_gen3({"stats"}, {"--solver", "rnea", "--give", "external-wrench of link0"}));
  EXPECT_EQ(result.exit_code, 1);
  expect_match(result.err, "link0.*: a wrench on the base.*leave it out, or let the base float");
}

TEST(IllPosedModel, WithAnAxisOfNoLengthIsRefused) {
  const Folder folder;
  write_file(folder / "arm.urdf", R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="a"/>
  <link name="b"/>
  <joint name="ab" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 0"/></joint>
</robot>)");
  const Result result = run_sinew({"stats", (folder / "arm.urdf").string(), "--solver", "fpk"});
  EXPECT_EQ(result.exit_code, 1);
  expect_match(result.err, R"(arm\.urdf:5: .*ax[ie]s)");
}

TEST(IllPosedPhrase, SaysHowToWriteIt) {
  for (const std::string phrase : {"pose off link7", "pose of", "pose of link7 of link6"}) {
    const Result result = run_sinew(with_gen3({"stats"}, {"--solver", "fpk", "--ask", phrase}));
    EXPECT_EQ(result.exit_code, 1) << phrase;
    expect_match(result.err, R"(write QUANTITY \[of ELEMENT\])");
  }
}

Json stats(const std::string& solvers) {
  const Result result = run_sinew(
      with_gen3({"stats"}, {"--solver", solvers, "--gravity", "0,0,-9.81", "--format", "json"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return Json::parse(result.out);
}

constexpr const char* kAddsAndMultiplies = "adds and multiplies of each asked apart";
constexpr const char* kAll = "all floating-point operations of each asked apart";

TEST(SeveralQueries, CostLessTogetherThanApart) {
  const Json report = stats("fpk,jacobian,rnea,crba");
  for (const char* section : {kAddsAndMultiplies, kAll}) {
    const Json& rows = report.at(section);
    EXPECT_LT(rows.at("together").get<int>(), rows.at("sum").get<int>()) << section;
    EXPECT_EQ(rows.at("sum").get<int>(),
              rows.at("fpk").get<int>() + rows.at("jacobian").get<int>() +
                  rows.at("rnea").get<int>() + rows.at("crba").get<int>());
  }
  EXPECT_EQ(report["operations"]["add"].get<int>() + report["operations"]["multiply"].get<int>(),
            report.at(kAddsAndMultiplies).at("together").get<int>());
}

TEST(SeveralQueries, OfPoseTwistJacobianAndForcesCostAtLeastThirtyPercentLess) {
  const Json report = stats("fpk,fvk,jacobian,rnea,bias,gravity");
  for (const char* section : {kAddsAndMultiplies, kAll}) {
    const Json& rows = report.at(section);
    EXPECT_LE(rows.at("together").get<double>(), 0.7 * rows.at("sum").get<double>()) << section;
  }
}

}  // namespace
}  // namespace sinew::test
