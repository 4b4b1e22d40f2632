// Joints that the tree has several joints for, and joints that follow others.
#include <gtest/gtest.h>

#include <cmath>

#include "small_models.h"

namespace sinew::model::test {
namespace {

std::string link_text(const std::string& name) {
  return "<link name=\"" + name +
         "\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" "
         "ixz=\"0\" iyz=\"0\"/></inertial></link>\n";
}

std::string joint_text(const std::string& name, const std::string& type, const std::string& parent,
                       const std::string& child, const std::string& more = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + more + "</joint>\n";
}

const std::string kFourLinks = link_text("a") + link_text("b") + link_text("c") + link_text("d");

TEST(JointTypes, OfUrdfPlanarIsTwoSlidesAndATurnAboutTheNormal) {
  Model model;
  normalise_texts(model, {urdf(link_text("a") + link_text("b") +
                               joint_text("p", "planar", "a", "b", "<axis xyz=\"0 0 1\"/>"))});
  ASSERT_EQ(first_error(model), "");
  ASSERT_EQ(model.tree.compounds.size(), 1u);
  EXPECT_EQ(model.tree.compounds[0].kind, JointKind::kPlanar);
  ASSERT_EQ(model.tree.joints.size(), 3u);
  EXPECT_EQ(model.tree.joints[0].kind, JointKind::kPrismatic);
  EXPECT_EQ(model.tree.joints[1].kind, JointKind::kPrismatic);
  EXPECT_EQ(model.tree.joints[2].kind, JointKind::kRevolute);
  // The first slide is along x of the joint.
  EXPECT_NEAR(model.tree.joints[0].placement.R.xz, 1, 1e-15);
  // The bodies in between weigh nothing and are nobody's links.
  EXPECT_TRUE(model.tree.bodies[1].links.empty());
  EXPECT_FALSE(model.tree.bodies[1].has_inertia);
  EXPECT_EQ(model.tree.bodies[3].links.size(), 1u);
}

TEST(JointTypes, OfUrdfFloatingIsThreeTurnsAndThreeSlides) {
  Model model;
  normalise_texts(model,
                  {urdf(link_text("a") + link_text("b") + joint_text("f", "floating", "a", "b"))});
  ASSERT_EQ(first_error(model), "");
  ASSERT_EQ(model.tree.joints.size(), 6u);
  EXPECT_EQ(model.tree.compounds.at(0).kind, JointKind::kFloating);
  EXPECT_EQ(model.tree.joints[2].kind, JointKind::kRevolute);
  EXPECT_EQ(model.tree.joints[3].kind, JointKind::kPrismatic);
}

TEST(JointTypes, AMimickingJointFollowsTheHeadOfItsLine) {
  Model model;
  normalise_texts(model,
                  {urdf(kFourLinks + joint_text("j", "continuous", "a", "b") +
                        joint_text("k", "continuous", "b", "c",
                                   "<mimic joint=\"j\" multiplier=\"-2\" offset=\"0.5\"/>") +
                        joint_text("l", "continuous", "c", "d",
                                   "<mimic joint=\"k\" multiplier=\"3\" offset=\"0.25\"/>"))});
  ASSERT_EQ(first_error(model), "");
  ASSERT_EQ(model.tree.joints.size(), 3u);
  EXPECT_EQ(model.tree.joints[0].follows, -1);
  EXPECT_EQ(model.tree.joints[1].follows, 0);
  EXPECT_EQ(model.tree.joints[1].ratio, -2);
  EXPECT_EQ(model.tree.joints[1].offset, 0.5);
  EXPECT_EQ(model.tree.joints[2].follows, 0);
  EXPECT_EQ(model.tree.joints[2].ratio, -6);
  EXPECT_EQ(model.tree.joints[2].offset, 1.75);
}

TEST(JointTypes, AreWrittenAsTheContractSays) {
  Model model;
  normalise_texts(model, {urdf(kFourLinks + joint_text("s", "floating", "a", "b") +
                               joint_text("j", "continuous", "b", "c") +
                               joint_text("k", "continuous", "c", "d", "<mimic joint=\"j\"/>"))});
  ASSERT_EQ(first_error(model), "");
  write(model.tree, model.store);
  graph::Terms& terms = model.store.terms();
  const graph::View view = model.store.view();
  const auto word = [&](const std::string& name) {
    return terms.iri("https://w3id.org/sinew/kinematic-tree#" + name);
  };
  const Id whole = terms.iri("https://w3id.org/sinew/robots/r/joint/s");
  const Id type = terms.iri("http://www.w3.org/1999/02/22-rdf-syntax-ns#type");
  EXPECT_TRUE(view.contains(whole, type, word("Compound")));
  EXPECT_TRUE(view.contains(whole, type, word("Floating")));
  EXPECT_EQ(view.object(model.tree.joints[5].iri, word("part-of")), whole);
  EXPECT_EQ(view.object(terms.iri("https://w3id.org/sinew/robots/r/joint/k"), word("follows")),
            terms.iri("https://w3id.org/sinew/robots/r/joint/j"));
}

const std::string kTwo = link("a", {"a-1"}) + link("b") + pose("a-1", "a-root", "0 0 1");

std::string spherical(const std::string& more = "") {
  return kTwo +
         ":j a kc:Joint, skc:SphericalJoint ; kc:between-attachments :a-1, :b-root ; "
         "kc:origin-offset :j-offset .\n:j-offset a rel:Position ; rel:of :b-root-origin ; "
         "rel:with-respect-to :a-1-origin .\n" +
         more;
}

struct Fault {
  const char* name;
  std::string model;
  const char* iri;
  const char* phrase;
};

std::vector<Fault> faults() {
  const std::string state =
      "@prefix kc-stat: <https://comp-rob2b.github.io/metamodels/kinematic-chain/state#> .\n";
  const std::string line = state + link("a", {"a-1"}) + link("b", {"b-1"}) + link("c") +
                           pose("a-1", "a-root", "0 0 1") + pose("b-1", "b-root", "0 0 1") +
                           joint("j", "a-1", "b-root") + joint("k", "b-1", "c-root");
  const auto mimicry = [](const std::string& of, const std::string& mimics) {
    return ":" + of + "-m a skc:JointMimicry ; kc-stat:of-joint :" + of +
           " ; skc:mimics :" + mimics +
           " ; skc:multiplier 2 ; skc:offset 0 ; qudt:unit unit:RAD .\n";
  };
  const std::string helical = state + kTwo + joint("j", "a-1", "b-root", "skc:HelicalJoint");
  return {
      {"NoPitch", helical, "r#j", "the helical joint has no pitch"},
      {"PitchOfARevolute",
       line + ":p a skc:JointPitch ; kc-stat:of-joint :j ; skc:pitch 1 ; qudt:unit "
              "unit:M-PER-RAD .\n",
       "r#p", "has a pitch but is no helical joint"},
      {"Circle", line + mimicry("j", "k") + mimicry("k", "j"), "r#", "follows itself"},
      {"LeaderIsNone", line + mimicry("j", "nothing"), "r#j-m",
       "nothing> is no joint with one degree of freedom"},
      {"NoMultiplier",
       line + ":m a skc:JointMimicry ; kc-stat:of-joint :j ; skc:mimics :k ; skc:offset 0 ; "
              "qudt:unit unit:RAD .\n",
       "r#m", "multiplier"},
      {"NegativeRotor",
       line + ":t a skc:JointTransmission ; kc-stat:of-joint :j ; skc:ratio 2 ; skc:rotor-inertia "
              "-1 ; qudt:unit unit:KiloGM-M2 .\n",
       "r#t", "the rotor's inertia is negative"},
      {"RotorOfASpherical",
       state + spherical(":t a skc:JointTransmission ; kc-stat:of-joint :j ; skc:ratio 2 ; "
                         "skc:rotor-inertia 1 ; qudt:unit unit:KiloGM-M2 .\n"),
       "r#t", "has not one degree of freedom"},
      {"PositionLimitOfASpherical",
       state + spherical(":l a skc:JointPositionLimits ; kc-stat:of-joint :j ; skc:lower -1 ; "
                         "skc:upper 1 ; skc:degree-of-freedom 0 ; qudt:unit unit:RAD .\n"),
       "r#l", "has no positions to limit"},
      {"WhichDegree",
       state + spherical(":l a skc:JointVelocityLimit ; kc-stat:of-joint :j ; skc:maximum 1 ; "
                         "qudt:unit unit:RAD-PER-SEC .\n"),
       "r#l", "does not say of which"},
      {"EmptySequence",
       kTwo + ":j a kc:Joint, skc:CompositeJoint ; kc:between-attachments :a-1, :b-root ; "
              "skc:sequence () .\n",
       "r#j", "the sequence is empty"},
      {"UniversalOfOne",
       kTwo + ":j a kc:Joint, skc:UniversalJoint ; kc:between-attachments :a-1, :b-root ; "
              "skc:sequence ( :m ) .\n:m a skc:RevoluteMotion ; kc:common-axis :x .\n:x a "
              "rel:LineCollinearity ; rel:lines :a-1-z, :b-root-z .\n",
       "r#j", "a universal joint is a sequence of two turns"},
      {"AxisWithoutLength",
       kTwo +
           ":j a kc:Joint, kc:RevoluteJoint ; kc:between-attachments :a-1, :b-root ; "
           "kc:common-axis :x .\n:x a rel:LineCollinearity ; rel:lines :l .\n"
           ":l1 a coord:DirectionCoordinate ; <https://w3id.org/sinew/geometry#of-direction> :l ; "
           "coord:as-seen-by :a-1 ; qudt:unit unit:UNITLESS ; coord:x 0 ; coord:y 0 ; coord:z 0 .\n"
           ":l2 a coord:DirectionCoordinate ; <https://w3id.org/sinew/geometry#of-direction> :l ; "
           "coord:as-seen-by :b-root ; qudt:unit unit:UNITLESS ; coord:x 0 ; coord:y 0 ; coord:z 0 "
           ".\n",
       "r#l1", "the axis of <https://example.org/r#j> has no length"},
  };
}

class JointFault : public testing::TestWithParam<std::size_t> {};

TEST_P(JointFault, IsNamedWithItsNode) {
  const Fault fault = faults()[GetParam()];
  Model model;
  normalise_texts(model, {turtle(fault.model)});
  const std::string error = first_error(model);
  EXPECT_NE(error.find(fault.iri), std::string::npos) << error;
  EXPECT_NE(error.find(fault.phrase), std::string::npos) << error;
}

INSTANTIATE_TEST_SUITE_P(Each, JointFault, testing::Range(std::size_t{0}, faults().size()),
                         [](const auto& info) { return faults()[info.param].name; });

TEST(JointTypes, LimitsStayWithTheirDegreeOfFreedom) {
  Model model;
  normalise_texts(
      model,
      {turtle("@prefix kc-stat: "
              "<https://comp-rob2b.github.io/metamodels/kinematic-chain/state#> .\n" +
              spherical(":l a skc:JointVelocityLimit ; kc-stat:of-joint :j ; skc:maximum 3 ; "
                        "skc:degree-of-freedom 1 ; qudt:unit unit:RAD-PER-SEC .\n"))});
  ASSERT_EQ(first_error(model), "");
  EXPECT_EQ(model.tree.joints.at(1).limits.maximum_velocity, 3);
  EXPECT_TRUE(std::isnan(model.tree.joints.at(0).limits.maximum_velocity));
}

TEST(JointTypes, RotorsAreReflectedByTheSquareOfTheRatio) {
  Model model;
  normalise_texts(model,
                  {turtle("@prefix kc-stat: "
                          "<https://comp-rob2b.github.io/metamodels/kinematic-chain/state#> .\n" +
                          kTwo + joint("j", "a-1", "b-root") +
                          ":t a skc:JointTransmission ; kc-stat:of-joint :j ; skc:ratio -100 ; "
                          "skc:rotor-inertia 0.0002 ; qudt:unit unit:KiloGM-M2 .\n")});
  ASSERT_EQ(first_error(model), "");
  EXPECT_DOUBLE_EQ(model.tree.joints.at(0).rotor_inertia, 2);
}

}  // namespace
}  // namespace sinew::model::test
