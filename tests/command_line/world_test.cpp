// A scene on the command line: what a user asks of the assembly cell without writing a program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command.h"

namespace sinew::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kSource = SINEW_SOURCE_DIR;
const std::string kCell = "https://w3id.org/sinew/examples/assembly_cell#";

// `sinew world VERB` with the cell's models, its arm and the camera's look at 1 s.
Result ask(const std::string& verb, std::vector<std::string> options, bool camera_looks = true) {
  std::vector<std::string> arguments = {"world", verb};
  for (const char* file : {"scene", "task", "arm", "shapes", "components"}) {
    arguments.push_back(kSource + "/examples/assembly_cell/" + file + ".jsonld");
  }
  for (const char* file : {"chain", "dynamics", "geometry"}) {
    arguments.insert(arguments.end(), {"--robot", kSource + "/robots/gen3/" + file + ".jsonld"});
  }
  arguments.insert(arguments.end(), {"--robot-provenance", kCell + "robot-controller"});
  if (camera_looks) {
    arguments.insert(arguments.end(), {"--write", "measured-F2-F3=0.1,-0.2,1.1,0,0,0,1@1"});
  }
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run_sinew(arguments);
}

TEST(WorldCommand, TellsAPoseWithItsFreshnessItsDeviationAndItsWay) {
  const Result result =
      ask("pose", {"--of", "F2", "--wrt", "F1", "--uncertainty", "--why", "--now", "1.75"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("position    0.3 "));
  EXPECT_THAT(result.out, HasSubstr("7 updates missed, 0 % still hold"));
  EXPECT_THAT(result.out, HasSubstr("expired 0.25 s ago"));
  EXPECT_THAT(result.out, HasSubstr("0.002 0.002 0.002 m, seen by F2"));
  EXPECT_THAT(result.out, HasSubstr("compose         pose-F2-F3  by measured-F2-F3"));
}

TEST(WorldCommand, APoseThatIsNotKnownIsAFaultThatSaysWhatIsMissing) {
  const Result result = ask("pose", {"--of", "F2", "--wrt", "F1"}, false);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("never written (" + kCell + "measured-F2-F3)"));
}

TEST(WorldCommand, TellsWhatIsInANamedArea) {
  const Result magazine = ask("within", {"--area", "storage magazine", "--inside"});
  EXPECT_EQ(magazine.exit_code, 0) << magazine.err;
  EXPECT_EQ(magazine.out, kCell + "hose_adaptor\n");
  // The joints are not written: where the hand is is not known, and that is said.
  EXPECT_THAT(magazine.err, HasSubstr("end_effector: where it is is not known: never written"));
  const Result surface = ask("within", {"--area", "working surface", "--inside"});
  EXPECT_EQ(surface.out, "");
  const Result nowhere = ask("within", {"--area", "moon"});
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_THAT(nowhere.err, HasSubstr("moon: is no object, frame or area with a shape"));
}

TEST(WorldCommand, ListsAndExplainsQualitativeRelations) {
  const Result all = ask("relations", {});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("hose_adaptor on workbench\n"));
  EXPECT_THAT(all.out, HasSubstr("hose_adaptor reachable robot_base\n"));
  EXPECT_THAT(all.out, Not(HasSubstr("hose_adaptor above workbench")));
  EXPECT_THAT(all.err, HasSubstr("left-of-as-seen: left out, as nobody looks"));
  const Result one = ask("relations", {"--judge", "hose_adaptor", "above", "workbench"});
  EXPECT_THAT(one.out, HasSubstr("above " + kCell + "workbench: false"));
  EXPECT_THAT(one.out, HasSubstr("is not within 0.02"));
  const Result wrong = ask("relations", {"--judge", "hose_adaptor", "beneath", "workbench"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.err, HasSubstr("no relation that a rule is declared for"));
  // Asked for one alone, nothing is said of the others, and none is none.
  const Result on = ask("relations", {"--relation", "on"});
  EXPECT_THAT(on.out, Not(HasSubstr("reachable")));
  EXPECT_THAT(on.err, Not(HasSubstr("left-of-as-seen")));
  const Result misspelt = ask("relations", {"--relation", "onn"});
  EXPECT_EQ(misspelt.exit_code, 1);
  EXPECT_THAT(misspelt.err, HasSubstr("onn: is no relation that a rule is declared for; "));
}

TEST(WorldCommand, AsksTheModelsAndTheRelationsInOneQuery) {
  const Result result = ask("query", {"-e", "SELECT ?x WHERE { ?x w:on <" + kCell +
                                                "workbench> ; w:attached-to <" + kCell + "F2> }"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("hose_adaptor"));
  EXPECT_EQ(ask("query", {}).exit_code, 2);
}

TEST(WorldCommand, RefusesWhoMayNotWrite) {
  const Result camera = ask("pose", {"--of", "F5", "--wrt", "F4", "--as", "camera-device",
                                     "--write", "joint1/position=0.3"});
  EXPECT_EQ(camera.exit_code, 1);
  EXPECT_THAT(camera.err, HasSubstr("camera-device may not write it: its provenance is " + kCell +
                                    "robot-controller"));
  const Result rights = ask("rights", {});
  EXPECT_THAT(rights.out, HasSubstr("camera-device writes measured-F2-F3"));
  EXPECT_THAT(rights.out, HasSubstr("camera-device write-measurement measured-F2-F3: allowed"));
  // With the arm's model the world computes what measured.jsonld has the controller write.
  EXPECT_EQ(rights.exit_code, 1);
  EXPECT_THAT(rights.err, HasSubstr("measured-F5-F4: " + kCell +
                                    "robot-controller is to write it, and it is no measurement"));
}

TEST(WorldCommand, SavesWhatItWasGivenAndReadsItBack) {
  const Folder folder;
  for (const char* name : {"saved.jsonld", "saved.trig"}) {
    const std::string file = (folder / name).string();
    const Result saved = ask("save", {"-o", file});
    EXPECT_EQ(saved.exit_code, 0) << saved.err;
    const Result again =
        run_sinew({"world", "pose", file, "--of", "F2", "--wrt", "F1", "--uncertainty"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(again.out, ask("pose", {"--of", "F2", "--wrt", "F1", "--uncertainty"}).out) << name;
    const Result checked = run_sinew({"check", file});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
    // Of the robot only what the scene is fixed to is left.
    EXPECT_THAT(read_file(folder / name), Not(HasSubstr("link3-root")));
  }
  EXPECT_THAT(read_file(folder / "saved.jsonld"), HasSubstr("\"assembly_cell:hose_adaptor\""));
}

TEST(WorldCommand, CheckTellsAFaultInASceneWithItsPlace) {
  const Folder folder;
  std::string text = read_file(kSource + "/examples/assembly_cell/shapes.jsonld");
  const std::string size = "[0.8, 1.2, 0.05]";
  text.replace(text.find(size), size.size(), "[0.8, -1.2, 0.05]");
  write_file(folder / "shapes.jsonld", text);
  const std::string scene = kSource + "/examples/assembly_cell/scene.jsonld";
  const Result good =
      run_sinew({"check", scene, kSource + "/examples/assembly_cell/shapes.jsonld"});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("a scene of 4 frames, 3 objects"));
  const Result bad = run_sinew({"check", scene, (folder / "shapes.jsonld").string()});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.err, HasSubstr("shapes.jsonld:12: " + kCell +
                                 "workbench-top: the box's size along y is -1.2"));
}

// The scene of docs/scenes.md, as it stands there, and what that page says of it.
TEST(WorldCommand, TheDocumentedSceneAnswersAsDocumented) {
  const std::string page = read_file(kSource + "/docs/scenes.md");
  const std::size_t begin = page.find("```json\n") + 8, end = page.find("```", begin);
  const Folder folder;
  const std::string lab = (folder / "lab.jsonld").string();
  write_file(folder / "lab.jsonld", page.substr(begin, end - begin));
  const auto ask = [&](const std::string& verb, std::vector<std::string> options) {
    std::vector<std::string> arguments = {"world", verb, lab};
    for (const char* write : {"seen-red=0.3,0.2,1.75,1,0,0,0@10", "odometry=0.5,1,0,0,0,0,1@9",
                              "odometry=0.7,1,0,0,0,0,1@10"}) {
      EXPECT_THAT(page, HasSubstr(write));
      arguments.insert(arguments.end(), {"--write", write});
    }
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Result result = run_sinew(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  const Result checked = run_sinew({"check", lab});
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("a scene of 6 frames, 5 objects"));
  EXPECT_THAT(ask("show", {}), HasSubstr("area at at-table, \"right half of the table\""));
  const std::string pose = ask("pose", {"--of", "at-red", "--wrt", "at-table", "--now", "10.2"});
  EXPECT_THAT(pose, HasSubstr("position    0.3 -0.2 "));
  EXPECT_THAT(pose, HasSubstr("holds for another 0.3 s"));
  const std::string sure =
      ask("pose", {"--of", "at-red", "--wrt", "at-table", "--uncertainty", "--why"});
  EXPECT_THAT(sure, HasSubstr("pose-red  by seen-red"));
  EXPECT_THAT(sure, HasSubstr("deviation   0.01745 0.01745 0.01745 rad, 0.003"));
  // An object stands for its frame.
  EXPECT_EQ(ask("pose", {"--of", "red-box", "--wrt", "table", "--now", "10.2"}), pose);
  EXPECT_EQ(ask("relations", {"--relation", "on"}), "blue-box on table\nred-box on table\n");
  EXPECT_EQ(ask("within", {"--area", "right half of the table", "--inside"}),
            "http://lab.example/red-box\nhttp://lab.example/blue-box\n");
  EXPECT_THAT(ask("query", {"-e", "SELECT ?x WHERE { ?x w:on <http://lab.example/table> }"}),
              HasSubstr("(2 rows)"));
  EXPECT_THAT(ask("show", {}), HasSubstr("seen  on change of seen-red: plan-grasp, priority 0"));
  EXPECT_EQ(ask("watch", {"--until", "10.5"}),
            "9 s  careful  when of http://lab.example/robot and http://lab.example/table distance "
            "up to 1.1: slow-down\n"
            "10 s  seen  on change of seen-red: plan-grasp\n");
  EXPECT_THAT(run_sinew({"world", "watch", lab, "--now", "1", "--until", "2", "--step", "0"}).err,
              HasSubstr("a positive step"));
  EXPECT_THAT(
      run_sinew({"world", "watch", lab, "--now", "1", "--until", "2", "--step", "1e-9"}).err,
      HasSubstr("at most 1000000 of them"));
  // 0.2 m/s, for half a second more.
  EXPECT_THAT(ask("pose", {"--of", "at-robot", "--wrt", "room", "--now", "10.5"}),
              HasSubstr("position    0.8 1 0 m"));
}

// What is easily written for shaped-as is no word of the context, and not dropped in silence.
TEST(WorldCommand, ATermThatIsNoneIsAFault) {
  const Folder folder;
  std::string text = read_file(kSource + "/examples/assembly_cell/shapes.jsonld");
  const std::string term = "\"shaped-as\"";
  text.replace(text.find(term), term.size(), "\"shape\"");
  write_file(folder / "shapes.jsonld", text);
  const Result bad = run_sinew({"check", kSource + "/examples/assembly_cell/scene.jsonld",
                                (folder / "shapes.jsonld").string()});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.err, HasSubstr("no context defines \"shape\""));
}

TEST(WorldCommand, SaysWhatItDoesAndWhatIsMissing) {
  EXPECT_THAT(run_sinew({"world", "--help"}).out, HasSubstr("relations"));
  EXPECT_EQ(run_sinew({"world"}).exit_code, 2);
  const Result less = ask("pose", {"--of", "F2"});
  EXPECT_EQ(less.exit_code, 2);
  EXPECT_THAT(less.err, HasSubstr("--wrt is required\nsee 'sinew world pose --help'"));
  const Result unknown = ask("pose", {"--of", "F9", "--wrt", "F1"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("F9: is no frame or object of this scene; one of F0"));
  const Result numbers =
      ask("pose", {"--of", "F2", "--wrt", "F1", "--write", "measured-F2-F3=1,2,3@2"});
  EXPECT_EQ(numbers.exit_code, 1);
  EXPECT_THAT(numbers.err, HasSubstr("is a pose, and 3 numbers are written"));
}

}  // namespace
}  // namespace sinew::test
