#include "sinew/model/couple.h"

#include <fmt/format.h>

#include <unordered_map>

#include "sinew/model/sizes.h"

namespace sinew::model {
namespace {

struct Coupler {
  const Structure& structure;
  const graph::Terms& terms;
  const graph::Places& places;
  Tree& tree;
  Report& report;
  std::unordered_map<Id, const Structure::Joint*> facts = {};
  // The tree's joint that a model's joint of one degree of freedom is, or its first part.
  std::unordered_map<Id, std::size_t> first = {};

  void error(Id node, std::string what, std::string remedy) {
    report.error(places.find(node), std::string(terms.text(node)), std::move(what),
                 std::move(remedy));
  }

  static bool has_one_degree(const Structure::Joint& joint) {
    return joint.kind == JointKind::kRevolute || joint.kind == JointKind::kPrismatic ||
           joint.kind == JointKind::kHelical;
  }

  void run() {
    for (const Structure::Joint& joint : structure.joints) facts.emplace(joint.iri, &joint);
    for (std::size_t k = 0; k < tree.joints.size(); ++k)
      if (tree.joints[k].compound < 0) first.emplace(tree.joints[k].iri, k);
    for (const Tree::Compound& compound : tree.compounds)
      first.emplace(compound.iri, compound.parts.front());
    for (const Structure::Joint& joint : structure.joints)
      if (joint.mimicry && first.contains(joint.iri)) follow(joint);
  }

  void follow(const Structure::Joint& joint) {
    // q = ratio * q_leader + offset, and so on to the head of the line.
    double ratio = 1, offset = 0;
    const Structure::Joint* at = &joint;
    for (std::size_t steps = 0; at->mimicry; ++steps) {
      const Structure::Mimicry& mimicry = *at->mimicry;
      const auto leader = facts.find(mimicry.leader);
      if (leader == facts.end() || !has_one_degree(*leader->second) || !has_one_degree(*at)) {
        const bool fault_is_leader = leader == facts.end() || !has_one_degree(*leader->second);
        const Id fault = fault_is_leader ? mimicry.leader : at->iri;
        error(mimicry.node,
              fmt::format("<{}> is no joint with one degree of freedom", terms.text(fault)),
              "couple revolute, prismatic or helical joints");
        return;
      }
      if (steps == structure.joints.size()) {
        error(joint.mimicry->node,
              fmt::format("<{}> follows itself by way of others", terms.text(joint.iri)),
              "let one joint of the line follow none");
        return;
      }
      offset += ratio * mimicry.offset;
      ratio *= mimicry.multiplier;
      at = leader->second;
    }
    if (!within(ratio, kLargestRatio) || !within(offset, kLargestLength)) {
      error(joint.mimicry->node,
            fmt::format("by way of others <{}> follows <{}> more than {:g} times as far",
                        terms.text(joint.iri), terms.text(at->iri), kLargestRatio),
            "check the multipliers and offsets of the line");
      return;
    }
    const auto head = first.find(at->iri);
    if (head == first.end()) {
      error(joint.mimicry->node,
            fmt::format("<{}> follows <{}>, to which no way from the base leads",
                        terms.text(joint.iri), terms.text(at->iri)),
            "add a tip behind it, or leave the tips out");
      return;
    }
    const auto set = [&](Tree::Joint& part, double factor) {
      part.follows = static_cast<int>(head->second);
      part.ratio = ratio * factor;
      part.offset = offset * factor;
    };
    Tree::Joint& own = tree.joints[first.at(joint.iri)];
    if (own.compound >= 0) {
      for (const std::uint32_t part : tree.compounds[static_cast<std::size_t>(own.compound)].parts)
        if (tree.joints[part].follows >= 0) set(tree.joints[part], tree.joints[part].ratio);
    }
    set(own, 1);
  }
};

}  // namespace

void couple(const Structure& structure, const graph::Terms& terms, const graph::Places& places,
            Tree& tree, Report& report) {
  Coupler{structure, terms, places, tree, report}.run();
}

}  // namespace sinew::model
