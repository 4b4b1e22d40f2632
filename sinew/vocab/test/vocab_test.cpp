// The generated constants name the published IRIs.
#include "sinew/vocab/vocab.h"

#include <gtest/gtest.h>

namespace sinew::vocab {
namespace {

TEST(Vocab, NamesATermByItsMetamodelsPrefix) {
  EXPECT_EQ(geom_coord::PoseCoordinate,
            "https://comp-rob2b.github.io/metamodels/geometry/coordinates#PoseCoordinate");
  EXPECT_EQ(kc::between_attachments,
            "https://comp-rob2b.github.io/metamodels/kinematic-chain/"
            "structural-entities#between-attachments");
}

TEST(Vocab, HasTheTermsThatAreScopedToAType) {
  EXPECT_EQ(dyn_op::rigid_body_inertia,
            "https://comp-rob2b.github.io/metamodels/newtonian-rigid-body-dynamics/"
            "operators#rigid-body-inertia");
}

TEST(Vocab, KeepsTheTwoMeaningsOfOneWordApart) {
  EXPECT_NE(geom_rel::of, dyn_ent::of);
  EXPECT_NE(geom_coord::as_seen_by, dyn_coord::as_seen_by);
}

TEST(Vocab, PutsATermThatAnotherContextBorrowsIntoItsOwnNamespace) {
  EXPECT_EQ(skc::NegativePolarity, "https://w3id.org/sinew/kinematic-chain#NegativePolarity");
}

TEST(Vocab, WritesNamesThatAreNoIdentifiersSoThatTheyAre) {
  EXPECT_EQ(geom::n3D, "https://comp-rob2b.github.io/metamodels/geometry/structural-entities#3D");
  EXPECT_EQ(mot::while_, "https://comp-rob2b.github.io/metamodels/task/motion-specification#while");
}

}  // namespace
}  // namespace sinew::vocab
