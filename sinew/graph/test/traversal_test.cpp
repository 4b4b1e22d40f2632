#include "sinew/graph/traversal.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/store.h"

namespace sinew::graph {
namespace {

// Bodies and joints, each with its frame, and the poses between neighbouring frames:
//   body0 <-predecessor- joint1 -successor-> body1 <-predecessor- joint2 -successor-> body2
struct Mechanism {
  Store store;
  Id my_frame = iri("myFrame"), target = iri("target"), reference = iri("reference");
  Id predecessor = iri("predecessor"), successor = iri("successor"), length = iri("length");
  std::vector<Id> bodies, joints, joint_poses, body_poses;

  explicit Mechanism(int joint_count) {
    Transaction transaction = store.begin();
    const auto with_frame = [&](const std::string& name) {
      const Id node = iri(name);
      transaction.add({node, my_frame, iri(name + "_frame")});
      return node;
    };
    const auto pose = [&](const std::string& name, Id of, Id with_respect_to) {
      const Id node = iri(name);
      transaction.add({node, target, transaction.view().object(of, my_frame)});
      transaction.add({node, reference, transaction.view().object(with_respect_to, my_frame)});
      return node;
    };
    bodies.push_back(with_frame("body0"));
    for (int i = 1; i <= joint_count; ++i) {
      const std::string number = std::to_string(i);
      bodies.push_back(with_frame("body" + number));
      joints.push_back(with_frame("joint" + number));
      transaction.add({joints.back(), predecessor, bodies[i - 1]});
      transaction.add({joints.back(), successor, bodies[i]});
      joint_poses.push_back(pose("pose_joint" + number, joints.back(), bodies[i - 1]));
      body_poses.push_back(pose("pose_body" + number, bodies[i], joints.back()));
      transaction.add({joint_poses.back(), length, store.terms().integer(i)});
    }
    transaction.commit();
  }
  Id iri(const std::string& name) { return store.terms().iri("http://robot/" + name); }
};

// ---- the published example: section 3.2.1, figure 3.11 ----

// Fetches the relative pose between a joint's frame and the frame of the joint's predecessor.
Traversal<> pose_with_respect_to_predecessor(const Mechanism& m) {
  return Traversal<>()
      .as("joint")
      .out(m.my_frame)
      .in(m.target)
      .as("the right pose")
      .out(m.reference)
      .in(m.my_frame)
      .in(m.predecessor)
      .where(equals("joint"))
      .select("the right pose");
}

TEST(Traversal, FindsThePoseOfAJointWithRespectToItsPredecessor) {
  Mechanism m(2);
  const View view = m.store.view();
  const auto pose = pose_with_respect_to_predecessor(m);
  EXPECT_EQ(pose.ids(view, m.joints[0]), (std::vector<Id>{m.joint_poses[0]}));
  EXPECT_EQ(pose.ids(view, m.joints[1]), (std::vector<Id>{m.joint_poses[1]}));
  EXPECT_TRUE(pose.ids(view, m.bodies[0]).empty());
}

TEST(Traversal, IgnoresPosesOfTheJointWithRespectToOtherThings) {
  Mechanism m(2);
  const Id decoy = m.iri("pose_joint2_in_body0");
  m.store.add({decoy, m.target, m.iri("joint2_frame")});
  m.store.add({decoy, m.reference, m.iri("body0_frame")});
  EXPECT_EQ(pose_with_respect_to_predecessor(m).ids(m.store.view(), m.joints[1]),
            (std::vector<Id>{m.joint_poses[1]}));
}

// A language of the domain on top: joint.pose_wrt_predecessor().
struct Joint {
  const Mechanism& mechanism;
  View view;
  Id id;

  Id pose_wrt_predecessor() const {
    return pose_with_respect_to_predecessor(mechanism).first(view, id);
  }
};

TEST(Traversal, CarriesADomainLanguage) {
  Mechanism m(3);
  const Joint joint{m, m.store.view(), m.joints[2]};
  EXPECT_EQ(joint.pose_wrt_predecessor(), m.joint_poses[2]);
}

TEST(Traversal, ComposesWhatItCarriesAlongAChain) {
  Mechanism m(4);
  const auto pose = pose_with_respect_to_predecessor(m);
  // From body to body over the joints; at each joint, the pose's length is added to what the agent
  // has.
  const auto step = Traversal<int>()
                        .in(m.predecessor)
                        .carry([&](auto& agent) {
                          const View& view = agent.view();
                          const Id length = view.object(pose.first(view, agent.node()), m.length);
                          agent.carried += static_cast<int>(*view.terms().integer_value(length));
                        })
                        .out(m.successor);
  std::vector<int> lengths;
  Traversal<int>().repeat(step).emit().run(m.store.view(), m.bodies[0], [&](const auto& agent) {
    lengths.push_back(agent.carried);
    return true;
  });
  EXPECT_EQ(lengths, (std::vector<int>{1, 1 + 2, 1 + 2 + 3, 1 + 2 + 3 + 4}));
}

// ---- each step ----

struct Diamond : ::testing::Test {
  // a -> b -> d, a -> c -> d, d -> a
  Diamond() {
    for (const auto& [from, to] : {std::pair{a, b}, {a, c}, {b, d}, {c, d}, {d, a}}) {
      store.add({from, to_next, to});
    }
    store.add({b, colour, red});
  }
  Id iri(const char* name) { return store.terms().iri(name); }
  Store store;
  Id a = iri("a"), b = iri("b"), c = iri("c"), d = iri("d");
  Id to_next = iri("next"), colour = iri("colour"), red = iri("red");
  using Ids = std::vector<Id>;
  Ids ids(const Traversal<>& traversal, Id start) { return traversal.ids(store.view(), start); }
};

TEST_F(Diamond, MovesOutInAndBoth) {
  EXPECT_EQ(ids(Traversal<>().out(to_next), a), (Ids{b, c}));
  EXPECT_EQ(ids(Traversal<>().in(to_next), d), (Ids{b, c}));
  EXPECT_EQ(ids(Traversal<>().both(to_next), a), (Ids{b, c, d}));
  EXPECT_EQ(ids(Traversal<>().out(), b), (Ids{d, red}));
  EXPECT_EQ(ids(Traversal<>().out(to_next).out(to_next), a), (Ids{d, d}));
  EXPECT_EQ(ids(Traversal<>().out(to_next).out(to_next).dedup(), a), (Ids{d}));
}

TEST_F(Diamond, KeepsWhatHasAProperty) {
  EXPECT_EQ(ids(Traversal<>().out(to_next).has(colour), a), (Ids{b}));
  EXPECT_EQ(ids(Traversal<>().out(to_next).has(colour, red), a), (Ids{b}));
  EXPECT_EQ(ids(Traversal<>().out(to_next).has(colour, a), a), (Ids{}));
  EXPECT_EQ(ids(Traversal<>().out(to_next).has_not(colour), a), (Ids{c}));
  EXPECT_EQ(ids(Traversal<>().out(to_next).is(c), a), (Ids{c}));
}

TEST_F(Diamond, KeepsWhereAnotherTraversalArrives) {
  const auto red_parent = Traversal<>().in(to_next).has(colour, red);
  EXPECT_EQ(ids(Traversal<>().both(to_next).where(red_parent), a), (Ids{d}));
  EXPECT_EQ(ids(Traversal<>().both(to_next).where_not(red_parent), a), (Ids{b, c}));
  EXPECT_EQ(ids(Traversal<>()
                    .as("start")
                    .repeat(Traversal<>().out(to_next))
                    .until(Traversal<>().where(equals("start")))
                    .dedup(),
                a),
            (Ids{a}));
  EXPECT_EQ(
      ids(Traversal<>().out(to_next).where([&](const auto& agent) { return agent.node() == c; }),
          a),
      (Ids{c}));
}

TEST_F(Diamond, GoesBackToALabelledNode) {
  EXPECT_EQ(ids(Traversal<>().out(to_next).as("x").has(colour).out(to_next).select("x"), a),
            (Ids{b}));
  EXPECT_EQ(
      ids(Traversal<>().as("x").out(to_next).out(to_next).out(to_next).where(differs("x")), a),
      (Ids{}));
  EXPECT_THROW(ids(Traversal<>().out(to_next).select("nobody"), a), Error);
}

TEST_F(Diamond, RemembersItsPath) {
  EXPECT_EQ(Traversal<>().out(to_next).out(to_next).paths(store.view(), a),
            (std::vector<Ids>{{a, b, d}, {a, c, d}}));
  EXPECT_EQ(
      Traversal<>().repeat(Traversal<>().out(to_next).simple_path()).emit().paths(store.view(), b),
      (std::vector<Ids>{{b, d}, {b, d, a}, {b, d, a, c}}));
}

TEST_F(Diamond, RepeatsSoManyTimesOrUntil) {
  const auto next = Traversal<>().out(to_next);
  EXPECT_EQ(ids(Traversal<>().repeat(next).times(3), a), (Ids{a, a}));
  EXPECT_EQ(
      ids(Traversal<>().repeat(next).until([&](const auto& agent) { return agent.node() == d; }),
          a),
      (Ids{d, d}));
  // A loop in a loop: twice around, thrice each.
  EXPECT_EQ(ids(Traversal<>().repeat(Traversal<>().repeat(next).times(3)).times(2), b),
            (Ids{b, c, b, c}));
  EXPECT_THROW(Traversal<>().out(to_next).times(2), Error);
}

TEST_F(Diamond, CallsAFunctionAtAStepAndFolds) {
  Ids visited;
  const auto watched = Traversal<>()
                           .out(to_next)
                           .side_effect([&](const auto& agent) { visited.push_back(agent.node()); })
                           .out(to_next);
  const int count = watched.fold(store.view(), a, 0, [](int sum, const auto&) { return sum + 1; });
  EXPECT_EQ(count, 2);
  EXPECT_EQ(visited, (Ids{b, c}));
}

TEST_F(Diamond, EndlessWalksAreErrorsNotHangs) {
  const auto for_ever =
      Traversal<>().repeat(Traversal<>().out(to_next).dedup()).until([](const auto&) {
        return false;
      });
  EXPECT_NO_THROW(ids(for_ever, a));
  const auto visit = [](const auto&) { return true; };
  const auto endless = Traversal<>().repeat(Traversal<>().out(to_next));
  EXPECT_THROW(endless.run(store.view(), a, visit, {}, {.repeats = 30, .moves = kMaxMoves}), Error);
  EXPECT_THROW(endless.run(store.view(), a, visit, {}, {.repeats = kMaxRepeats, .moves = 1000}),
               Error);
}

TEST(Traversal, WalksLongChainsWithoutRecursion) {
  Store store;
  const Id next = store.terms().iri("next");
  std::vector<Id> nodes;
  for (std::uint32_t i = 0; i < kMaxRepeats; ++i) nodes.push_back(store.terms().integer(i));
  Transaction transaction = store.begin();
  for (std::size_t i = 1; i < nodes.size(); ++i) transaction.add({nodes[i - 1], next, nodes[i]});
  transaction.commit();
  const auto last =
      Traversal<>().repeat(Traversal<>().out(next)).until(Traversal<>().has_not(next));
  EXPECT_EQ(last.ids(store.view(), nodes[0]), (std::vector<Id>{nodes.back()}));
}

}  // namespace
}  // namespace sinew::graph
