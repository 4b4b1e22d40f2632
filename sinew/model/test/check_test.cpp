// Models of real robots conform; each fault is found by the shapes or by the numbers.
#include "sinew/model/check.h"

#include <gtest/gtest.h>

#include "small_models.h"

namespace sinew::model::test {
namespace {

void run_check(Model& model) {
  const catalogue::Catalogue catalogue;
  check(model.store, model.places, catalogue, model.report);
}

TEST(Check, PassesThePublishedGen3) {
  SINEW_NEEDS(published_gen3().front());
  Model model;
  load_files(published_gen3(), {}, model.store, model.places, model.report);
  run_check(model);
  EXPECT_TRUE(model.report.problems().empty()) << model.problems();
}

TEST(Check, PassesOurOwnGen3) {
  Model model;
  std::vector<std::filesystem::path> files;
  for (const char* name : {"geometry", "chain", "dynamics", "limits", "mounting-upright"}) {
    files.push_back(std::filesystem::path(SINEW_SOURCE_DIR) / "robots/gen3" /
                    (std::string(name) + ".jsonld"));
  }
  load_files(files, {}, model.store, model.places, model.report);
  run_check(model);
  EXPECT_TRUE(model.report.problems().empty()) << model.problems();
}

class CheckedUrdf : public testing::TestWithParam<const char*> {};

TEST_P(CheckedUrdf, Passes) {
  const auto file = shared() / "robots" / GetParam();
  SINEW_NEEDS(file);
  Model model;
  load_files(std::vector{file}, {}, model.store, model.places, model.report);
  run_check(model);
  EXPECT_FALSE(model.report.has_errors()) << model.problems();
}

INSTANTIATE_TEST_SUITE_P(Robots, CheckedUrdf,
                         testing::Values("gen3_7dof.urdf", "iiwa.urdf", "hyq.urdf", "panda.urdf",
                                         "ur5_robot.urdf", "baxter.urdf", "double_pendulum.urdf",
                                         "clean/general_7r.urdf"));

TEST(Check, FindsThatThePublishedTutorialHasALeftHandedFrame) {
  const auto folder = shared() / "models/tutorial";
  SINEW_NEEDS(folder);
  Model model;
  std::vector<std::filesystem::path> files;
  for (const char* name : {"cartesian-coordinates", "chain", "dynamics", "fpk-algorithm",
                           "joint-coordinates", "skeleton", "spatial-relations"}) {
    files.push_back(folder / (std::string(name) + ".json"));
  }
  load_files(files, {}, model.store, model.places, model.report);
  ASSERT_TRUE(model.report.problems().empty()) << model.problems();  // it loads
  run_check(model);
  const std::string text = model.problems();
  EXPECT_NE(text.find("no right-handed frame"), std::string::npos) << text;
}

struct ShapeFault {
  const char* name;
  std::string text;
  const char* iri;
  const char* phrase;
};

const std::vector<ShapeFault>& shape_faults() {
  static const std::vector<ShapeFault> kFaults = {
      {"JointWithOneAttachment",
       ":j a kc:Joint, skc:FixedJoint ; kc:between-attachments :base-root .", "#j",
       "two attachments"},
      {"JointWithinOneLink",
       ":j a kc:Joint, skc:FixedJoint ; kc:between-attachments :base-root, :a .", "#j",
       "two different links"},
      {"JointOfNoKind", ":j a kc:Joint ; kc:between-attachments :base-root, :one-root .", "#j", ""},
      {"MovingJointWithoutAxis",
       ":j a kc:Joint, kc:RevoluteJoint ; kc:between-attachments :base-root, :one-root .", "#j",
       "one axis"},
      {"PoseWithoutWithRespectTo", ":p a rel:Pose ; rel:of :a .", "#p", ""},
      {"PoseOfAPoint", ":p a rel:Pose ; rel:of :a-origin ; rel:with-respect-to :base-root .", "#p",
       ""},
      {"PoseWithRespectToItself", ":p a rel:Pose ; rel:of :a ; rel:with-respect-to :a .", "#p", ""},
      {"CoordinatesSeenByNobody", ":c a coord:PositionCoordinate .", "#c", "exactly one frame"},
      {"CoordinatesWithoutUnit", ":c a coord:VectorXYZ ; coord:x 1.0 ; coord:y 1.0 ; coord:z 1.0 .",
       "#c", "need a unit"},
      {"TwoOfThreeCoordinates",
       ":c a coord:VectorXYZ ; qudt:unit unit:M ; coord:x 1.0 ; coord:y 1.0 .", "#c",
       "one number each"},
      {"ListOfTwoCosines",
       ":c a coord:DirectionCosineXYZ ; qudt:unit unit:UNITLESS ; coord:direction-cosine-x (1 0) ;"
       " coord:direction-cosine-y (0 1 0) ; coord:direction-cosine-z (0 0 1) .",
       "#c", "lists of three"},
      {"NoRotation",
       ":c a coord:DirectionCosineXYZ ; qudt:unit unit:UNITLESS ; coord:direction-cosine-x (1 1 0) "
       ";"
       " coord:direction-cosine-y (0 1 0) ; coord:direction-cosine-z (0 0 1) .",
       "#c", "no rotation"},
      {"NegativeMass", ":c a dync:MassScalar ; qudt:unit unit:KiloGM ; dync:mass -1.0 .", "#c",
       "not negative"},
      {"InertiaAboutNothing", ":i a dyn:RigidBodyInertia ; dyn:of-body :base .", "#i",
       "about one point"},
      {"InertiaOfNoLink", ":i a dyn:RigidBodyInertia ; dyn:of-body :a ; dyn:about :a-origin .",
       "#i", "of one link"},
      {"HalfAnInertia",
       ":i a dyn:RigidBodyInertia ; dyn:of-body :base ; dyn:about :a-origin .\n"
       ":c a dync:RigidBodyInertiaCoordinate ; dync:of-inertia :i ; dync:as-seen-by :a ;"
       " qudt:unit unit:KiloGM ; dync:mass 1.0 .",
       "#c", "ten numbers|three moments"},
      {"UnitThatIsNone", ":c qudt:unit <https://example.org/foot> .", "#c", "QUDT"},
      {"SharedSimplex", ":two a geom:SimplicialComplex ; geom:simplices :a .", "#a", "one link"},
  };
  return kFaults;
}

class CheckedFault : public testing::TestWithParam<std::size_t> {};

TEST_P(CheckedFault, IsFoundByTheShapes) {
  const ShapeFault& fault = shape_faults()[GetParam()];
  Model model;
  load_texts(model, {turtle(link("base", {"a"}) + link("one") + fault.text)});
  ASSERT_FALSE(model.report.has_errors()) << model.problems();
  const std::size_t before = model.store.view().size();
  const catalogue::Catalogue catalogue;
  check_shapes(model.store, model.places, catalogue, model.report);
  EXPECT_EQ(model.store.view().size(), before);  // no shapes stay behind
  bool found = false;
  const std::string_view phrases = fault.phrase;
  const std::string first(phrases.substr(0, phrases.find('|')));
  const std::string second(phrases.substr(phrases.find('|') + 1));
  for (const Problem& problem : model.report.problems()) {
    const std::string text = to_string(problem);
    found |= problem.iri.ends_with(fault.iri) && problem.place.line > 0 &&
             (text.find(first) != std::string::npos || text.find(second) != std::string::npos);
  }
  EXPECT_TRUE(found) << model.problems();
}

INSTANTIATE_TEST_SUITE_P(Each, CheckedFault, testing::Range<std::size_t>(0, 18),
                         [](const auto& info) { return shape_faults()[info.param].name; });

TEST(Check, FindsPosesThatDisagreeWhereNoQueryAsksForThem) {
  Model model;
  load_texts(model, {turtle(link("base", {"a", "b"}) + link("one", {"c"}) +
                            pose("a", "base-root", "0 0 1") + pose("b", "a", "0 0 1") +
                            pose("b", "base-root", "0 0 3"))});
  check_numbers(model.store, model.places, model.report);
  EXPECT_NE(first_error(model).find("differs by 1"), std::string::npos) << model.problems();
}

}  // namespace
}  // namespace sinew::model::test
