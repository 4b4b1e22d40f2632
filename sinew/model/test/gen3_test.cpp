// The published Gen3 files, unchanged, give the published robot's numbers (shared/reference.md,
// section 2).
#include <gtest/gtest.h>

#include "models.h"
#include "newton_euler.h"
#include "small_models.h"

namespace sinew::model::test {
namespace {

struct State {
  Motion motion;
  std::vector<double> torques;
  Vector3 p;
  Matrix3 R;  // written column by column
};

const std::vector<State>& states() {
  static const std::vector<State> kStates = {
      {{std::vector<double>(7, 0.2), std::vector<double>(7), std::vector<double>(7)},
       {0, -6.1049793161502901, 0.12976516944306268, -2.9211559500853213, 0.0034301511793215778,
        -0.53648150477306344, -0.028939511370873069},
       {0.24516925065538719, -0.099651982404516476, 1.0753469939654274},
       transpose(Matrix3{0.54166277298414922, -0.66667893959172142, -0.51199671079801035,
                         -0.66667893959172153, -0.71170036905359524, 0.221408618156194,
                         -0.51199671079801035, 0.221408618156194, -0.82996240393055409})},
      {{{0.1, -0.2, 0.3, -0.4, 0.5, -0.6, 0.7},
        {0.5, -0.4, 0.3, -0.2, 0.1, 0.6, -0.7},
        {1.0, -0.8, 0.6, -0.4, 0.2, -0.1, 0.3}},
       {0.46434100798012889, 6.3705599437082894, 0.35838220573390211, 3.6857467015278571,
        0.19265444740403875, 0.71176434790767917, 0.022454598886598294},
       {-0.33209390146355749, 0.097511908787567103, 1.0018704061934924},
       transpose(Matrix3{-0.37846568940210579, -0.81252124216447075, 0.44336548464770492,
                         -0.59389794253951644, -0.15423524349050421, -0.78961808712361325,
                         0.70996405246513583, -0.56215720283291759, -0.42418194623339617})},
      {{{-1.2, 0.9, 2.1, -1.7, 0.4, 1.3, -2.5},
        {-1.1, 0.7, 1.9, -0.8, 2.3, -1.5, 0.6},
        {3, -2, 1.5, 4, -3.5, 2.5, -1}},
       {3.0133260052072419, -15.886049933834908, -4.2372906751665136, 4.6157372357251107,
        0.17807489860605621, 0.98543655048281154, -0.053042364925385006},
       {-0.13366167146415336, 0.53508624937261207, 0.47323649176080335},
       transpose(Matrix3{-0.12816162606577713, 0.62064843740520992, -0.77354386737317449,
                         0.95379913531412641, 0.29084726920179649, 0.075333096789408527,
                         0.2717384902405261, -0.728150659646978, -0.62924940188884593})}};
  return kStates;
}

void expect_the_reference(Model& model) {
  ASSERT_FALSE(model.report.has_errors()) << model.problems();
  ASSERT_EQ(model.tree.joints.size(), 7u);
  const Tree::Frame* tip = model.frame("/link7-root");
  ASSERT_TRUE(tip);
  for (const State& state : states()) {
    const Dynamics result = newton_euler(model.tree, state.motion);
    for (int k = 0; k < 7; ++k) EXPECT_NEAR(result.forces[k], state.torques[k], 2e-14) << k;
    const Pose X = pose_of(model.tree, result, tip->iri);
    EXPECT_NEAR(X.p.x, state.p.x, 1e-15);
    EXPECT_NEAR(X.p.y, state.p.y, 1e-15);
    EXPECT_NEAR(X.p.z, state.p.z, 1e-15);
    EXPECT_NEAR(X.R.xx, state.R.xx, 2e-15);
    EXPECT_NEAR(X.R.xy, state.R.xy, 2e-15);
    EXPECT_NEAR(X.R.zy, state.R.zy, 2e-15);
    EXPECT_NEAR(X.R.zz, state.R.zz, 2e-15);
  }
}

TEST(PublishedGen3, GivesTheReferenceTorquesAndPoses) {
  SINEW_NEEDS(published_gen3().front());
  Model model;
  load_and_normalise(model, published_gen3());
  expect_the_reference(model);
  EXPECT_TRUE(model.report.problems().empty()) << model.problems();
}

TEST(PublishedGen3, GivesTheSameWhenItsOwnFramesAreKept) {
  SINEW_NEEDS(published_gen3().front());
  Model model;
  NormaliseOptions options;
  options.choose_frames = false;
  load_and_normalise(model, published_gen3(), options);
  expect_the_reference(model);
  // Then every body's frame is the link's own root frame.
  for (const Tree::Body& body : model.tree.bodies) {
    EXPECT_TRUE(model.store.terms().text(body.frame).ends_with("-root"))
        << model.store.terms().text(body.frame);
  }
}

TEST(PublishedGen3, GivesTheSameInWhicheverOrderItsFilesComeIn) {
  SINEW_NEEDS(published_gen3().front());
  auto files = published_gen3();
  std::reverse(files.begin(), files.end());
  Model model;
  load_and_normalise(model, files);
  expect_the_reference(model);
}

TEST(PublishedGen3, HasItsRootOnTheLinkAndNotOnTheWorld) {
  SINEW_NEEDS(published_gen3().front());
  Model model;
  load_and_normalise(model, published_gen3());
  ASSERT_FALSE(model.tree.bodies.empty()) << model.problems();
  EXPECT_TRUE(model.store.terms().text(model.tree.bodies[0].iri).ends_with("/link0"));
  EXPECT_TRUE(model.store.terms().text(model.tree.bodies[0].frame).ends_with("/link0-root"));
  EXPECT_EQ(model.tree.bodies[0].links.size(), 2u);  // the world is fixed to it
}

// Our own files of the same robot, one concern each.
std::vector<std::filesystem::path> own_gen3() {
  const std::filesystem::path folder = std::filesystem::path(SINEW_SOURCE_DIR) / "robots/gen3";
  return {folder / "geometry.jsonld", folder / "chain.jsonld", folder / "dynamics.jsonld",
          folder / "limits.jsonld", folder / "mounting-upright.jsonld"};
}

TEST(OwnGen3, GivesTheReferenceTorquesAndPoses) {
  Model model;
  load_and_normalise(model, own_gen3());
  expect_the_reference(model);
  EXPECT_TRUE(model.report.problems().empty()) << model.problems();
}

TEST(OwnGen3, HasLimits) {
  Model model;
  load_and_normalise(model, own_gen3());
  ASSERT_EQ(model.tree.joints.size(), 7u) << model.problems();
  EXPECT_EQ(model.tree.joints[3].limits.upper, 2.57);
  EXPECT_TRUE(std::isnan(model.tree.joints[0].limits.upper));  // it turns without end
  EXPECT_EQ(model.tree.joints[6].limits.maximum_force, 9);
}

TEST(OwnGen3, NeedsNoDynamicsForKinematics) {
  auto files = own_gen3();
  files.erase(files.begin() + 2);  // dynamics
  Model model;
  load_and_normalise(model, files);
  ASSERT_FALSE(model.report.has_errors()) << model.problems();
  const Dynamics result = newton_euler(model.tree, states()[1].motion);
  const Pose X = pose_of(model.tree, result, model.frame("/link7-root")->iri);
  EXPECT_NEAR(X.p.x, states()[1].p.x, 1e-15);
}

// A link composed on top of the published files, by a file of its own (reference.md, section 2.4).
constexpr std::string_view kLinkB = R"(
@prefix rob: <https://comp-rob2b.github.io/robots/kinova/gen3/7dof/> .
rob:link3 geom:simplices rob:link3-jointB, rob:link3-jointB-origin .
rob:link3-jointB a geom:Frame ; geom:origin rob:link3-jointB-origin ; geom:vector-z rob:B-z1 .
rob:link3-jointB-origin a geom:Point .
rob:linkB a geom:SimplicialComplex ; geom:simplices rob:linkB-root, rob:linkB-origin, rob:linkB-com .
rob:linkB-root a geom:Frame ; geom:origin rob:linkB-origin ; geom:vector-z rob:B-z2 .
rob:linkB-origin a geom:Point .
rob:linkB-com a geom:Point .
rob:B-z1 a geom:Vector . rob:B-z2 a geom:Vector .
rob:jointB a kc:Joint, kc:RevoluteJoint ; kc:common-axis rob:B-axis ; kc:origin-offset rob:B-offset ;
  kc:between-attachments rob:link3-jointB, rob:linkB-root .
rob:B-axis a rel:LineCollinearity ; rel:lines rob:B-z1, rob:B-z2 .
rob:B-offset a rel:Position ; rel:of rob:linkB-origin ; rel:with-respect-to rob:link3-jointB-origin .
rob:B-pose a rel:Pose ; rel:of rob:link3-jointB ; rel:with-respect-to rob:link3-root .
rob:B-pose-coord a coord:PoseCoordinate ; coord:of-pose rob:B-pose ; coord:as-seen-by rob:link3-root ;
  qudt:unit unit:UNITLESS, unit:M ; coord:direction-cosine-x (1 0 0) ;
  coord:direction-cosine-y (0 0 1) ; coord:direction-cosine-z (0 -1 0) ;
  coord:x 0.05 ; coord:y 0.02 ; coord:z -0.1 .
rob:B-com a rel:Position ; rel:of rob:linkB-com ; rel:with-respect-to rob:linkB-origin .
rob:B-com-coord a coord:PositionCoordinate ; coord:of-position rob:B-com ; coord:as-seen-by rob:linkB-root ;
  qudt:unit unit:M ; coord:x 0.01 ; coord:y -0.05 ; coord:z 0.02 .
rob:B-inertia a dyn:RigidBodyInertia ; dyn:of-body rob:linkB ; dyn:about rob:linkB-com .
rob:B-inertia-coord a dync:RigidBodyInertiaCoordinate ; dync:of-inertia rob:B-inertia ;
  dync:as-seen-by rob:linkB-root ; qudt:unit unit:KiloGM, unit:M-KiloGM, unit:KiloGM-M2 ;
  dync:mass 0.7 ; dync:first-moment-of-mass (0 0 0) ; dync:ixx 0.002 ; dync:ixy 1e-5 ;
  dync:ixz 2e-5 ; dync:iyy 0.001 ; dync:iyz -3e-5 ; dync:izz 0.0021 .
)";

TEST(PublishedGen3, CarriesABranchThatAnotherFileAdds) {
  SINEW_NEEDS(published_gen3().front());
  Model model;
  std::vector<Source> sources = {turtle(std::string(kLinkB))};
  for (const auto& file : published_gen3()) {
    sources.insert(sources.end() - 1, read_source(file));
  }
  normalise_texts(model, sources);
  ASSERT_FALSE(model.report.has_errors()) << model.problems();
  ASSERT_EQ(model.tree.joints.size(), 8u);
  Motion motion = states()[1].motion;
  motion.q.push_back(0.9), motion.qd.push_back(1.1), motion.qdd.push_back(-2);
  const Dynamics result = newton_euler(model.tree, motion);
  const std::vector<double> expected = {0.479282727471986,  6.09432497723859,  0.327904577935636,
                                        3.68574670152786,   0.192654447404039, 0.711764347907679,
                                        0.0224545988865983, -0.292233467049947};
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(result.forces[k], expected[k], 1e-13) << k;
}

}  // namespace
}  // namespace sinew::model::test
