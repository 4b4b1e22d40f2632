// A robot as a property graph, and the traversal that finds the pose of a joint's frame with
// respect to the frame of the body before it. The layout is that of a RobMoSys deliverable,
// section 3.2.1: bodies and joints own a frame (myFrame), a joint has a predecessor and a
// successor, and a relative pose is the pose of its target with respect to its reference.
#include <gtest/gtest.h>

#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

constexpr std::string_view kPair = R"(
  :b1 a :Body ; :myFrame :frame1 .
  :b2 a :Body ; :myFrame :frame2 .
  :joint a :Joint ; :myFrame :jointFrame ; :predecessor :b1 ; :successor :b2 .
  :jointInB1 a :RelPose ; :target :jointFrame ; :reference :frame1 .
  :b2InJoint a :RelPose ; :target :frame2 ; :reference :jointFrame ; :dependsOn :joint .
  # Another pose of the joint's frame, with respect to a frame that is nobody's predecessor.
  :camera :myFrame :cameraFrame .
  :jointInCamera a :RelPose ; :target :jointFrame ; :reference :cameraFrame .
)";

// joint.out(myFrame).in(target) as pose . out(reference).in(myFrame).in(predecessor) is joint
constexpr std::string_view kPoseWrtPredecessor = R"(
  PREFIX : <http://e/>
  SELECT ?pose WHERE {
    ?joint :myFrame/^:target ?pose .
    ?pose :reference/^:myFrame/^:predecessor ?joint
  })";

TEST(KinematicPair, PoseOfAJointWithRespectToItsPredecessor) {
  Table table(kPair);
  const auto query = prepare(table.store, kPoseWrtPredecessor, {"joint"});
  EXPECT_EQ(table.rows(*query, {table.id(":joint")}), (Rows{{":jointInB1"}}));
}

TEST(KinematicPair, PosesAlongTheWayFromOneBodyToTheOther) {
  Table table(kPair);
  EXPECT_EQ(table.rows(R"(
      SELECT ?pose ?moves WHERE {
        :b1 (:myFrame/^:reference/:target/^:myFrame)* ?from .
        ?pose :reference/^:myFrame ?from ; :target/^:myFrame ?to .
        ?to (:myFrame/^:reference/:target/^:myFrame)* :b2 .
        BIND(EXISTS { ?pose :dependsOn ?joint } AS ?moves)
      })"),
            (Rows{{":b2InJoint", "true"}, {":jointInB1", "false"}}));
}

TEST(KinematicPair, TheParentRelationIsAnUpdateAway) {
  Table table(kPair);
  table.update(
      "INSERT { ?child :parent ?parent } WHERE { ?j :predecessor ?parent ; :successor ?child }");
  EXPECT_EQ(table.rows("SELECT ?p { :b2 :parent ?p }"), (Rows{{":b1"}}));
}

}  // namespace
}  // namespace sinew::rdf::sparql
