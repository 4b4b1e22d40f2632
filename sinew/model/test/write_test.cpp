// The tree as triples, as docs/architecture.md promises them to synthesis.
#include <gtest/gtest.h>

#include "models.h"
#include "sinew/graph/standard_iris.h"
#include "sinew/math/layout.h"
#include "sinew/model/ids.h"

namespace sinew::model::test {
namespace {

class WrittenTree : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path folder = std::filesystem::path(SINEW_SOURCE_DIR) / "robots/gen3";
    load_and_normalise(
        model, {folder / "geometry.jsonld", folder / "chain.jsonld", folder / "dynamics.jsonld",
                folder / "limits.jsonld", folder / "mounting-upright.jsonld"});
    ASSERT_FALSE(model.report.has_errors()) << model.problems();
    write(model.tree, model.store);
  }

  Id iri(std::string_view text) { return model.store.terms().iri(text); }
  Id object(Id subject, std::string_view predicate) {
    Id found;
    model.store.view().match_in(subject, iri(predicate), {}, iri(kNormalisedGraph),
                                [&](const graph::Quad& quad) {
                                  found = quad.object;
                                  return false;
                                });
    return found;
  }
  bool is_a(Id subject, std::string_view type) {
    return model.store.view().contains_in(
        {subject, iri(graph::kRdfType), iri(type), iri(kNormalisedGraph)});
  }
  std::vector<double> numbers(Id coordinate) {
    std::vector<double> values;
    for (Id cell = object(coordinate, vocab::tree::value); cell != iri(graph::kRdfNil);
         cell = object(cell, graph::kRdfRest)) {
      values.push_back(*model.store.terms().number(object(cell, graph::kRdfFirst)));
    }
    return values;
  }
  std::size_t size() {
    std::size_t count = 0;
    model.store.view().match_in({}, {}, {}, iri(kNormalisedGraph), [&](const graph::Quad&) {
      ++count;
      return true;
    });
    return count;
  }

  Model model;
};

template <typename Value>
std::vector<double> laid_out(const Value& value) {
  std::vector<double> numbers(math::Layout<Value>::kSize);
  math::Layout<Value>::store(value, numbers.data());
  return numbers;
}

TEST_F(WrittenTree, HasItsBodies) {
  const Tree::Body& root = model.tree.bodies[0];
  EXPECT_TRUE(is_a(root.iri, vocab::tree::Root));
  for (const Tree::Body& body : model.tree.bodies) {
    EXPECT_TRUE(is_a(body.iri, vocab::tree::Body));
    EXPECT_EQ(object(body.iri, vocab::tree::frame), body.frame);
    EXPECT_EQ(object(body.iri, vocab::tree::contains), body.links.front());
    EXPECT_EQ(numbers(object(body.iri, vocab::tree::inertia)), laid_out(body.inertia));
  }
}

TEST_F(WrittenTree, HasItsJoints) {
  for (std::size_t k = 0; k < model.tree.joints.size(); ++k) {
    const Tree::Joint& joint = model.tree.joints[k];
    EXPECT_TRUE(is_a(joint.iri, vocab::tree::Joint));
    EXPECT_TRUE(is_a(joint.iri, vocab::tree::Revolute));
    EXPECT_EQ(model.store.terms().integer_value(object(joint.iri, vocab::tree::index)), k);
    EXPECT_EQ(object(joint.iri, vocab::tree::predecessor_frame),
              model.tree.bodies[joint.predecessor].frame);
    EXPECT_EQ(object(joint.iri, vocab::tree::successor_frame),
              model.tree.bodies[joint.successor].frame);
    EXPECT_EQ(object(joint.iri, vocab::tree::joint_frame), joint.joint_frame);
    EXPECT_EQ(numbers(object(joint.iri, vocab::tree::placement)), laid_out(joint.placement));
  }
  EXPECT_EQ(model.store.terms().number(object(model.tree.joints[3].iri, vocab::tree::upper)), 2.57);
}

TEST_F(WrittenTree, HasThePlacementOfEveryFrameThatIsNoBodyFrame) {
  for (const Tree::Frame& frame : model.tree.frames) {
    const Id body_frame = model.tree.bodies[frame.body].frame;
    if (frame.iri == body_frame) {
      EXPECT_FALSE(object(frame.iri, vocab::tree::fixed_to));
    } else {
      EXPECT_EQ(object(frame.iri, vocab::tree::fixed_to), body_frame);
      EXPECT_EQ(numbers(object(frame.iri, vocab::tree::placement)), laid_out(frame.placement));
    }
  }
  for (const Tree::Link& link : model.tree.links) {
    EXPECT_EQ(object(link.iri, vocab::tree::root_frame), link.root_frame);
  }
}

TEST_F(WrittenTree, HasGravityAsTheAccelerationOfItsBase) {
  const Id A = object(model.tree.bodies[0].frame, vocab::tree::base_acceleration);
  EXPECT_EQ(numbers(A), (std::vector<double>{0, 0, 0, 0, 0, 9.81}));
}

TEST_F(WrittenTree, ReplacesTheOneBefore) {
  const std::size_t before = size();
  const Id placement = object(model.tree.joints[0].iri, vocab::tree::placement);
  write(model.tree, model.store);
  EXPECT_EQ(size(), before);
  EXPECT_EQ(object(model.tree.joints[0].iri, vocab::tree::placement), placement);
}

}  // namespace
}  // namespace sinew::model::test
