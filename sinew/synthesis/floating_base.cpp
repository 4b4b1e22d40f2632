#include "sinew/synthesis/floating_base.h"

#include <string>

#include "sinew/algorithm/builder.h"
#include "sinew/model/tree.h"

namespace sinew::synthesis {

using graph::Id;

FloatingBase::FloatingBase(graph::Store& store, graph::Transaction& transaction, Id root_body,
                           Id root_frame)
    : transaction_(transaction) {
  graph::Terms& terms = store.terms();
  graph_ = terms.iri(model::kNormalisedGraph);
  const algorithm::Names names(terms);
  const auto tree = [&](std::string_view word) {
    return terms.iri(std::string(algorithm::kTreeNamespace) + std::string(word));
  };
  const auto made = [&](std::string_view role) { return terms.derived(tree(role), {root_body}); };
  const Id world = made("World"), world_frame = made("WorldFrame");
  const Id joint = made("FloatingJoint"), placement = made("FloatingPlacement");

  root_ = {root_body, names.type, tree("Root"), graph_};
  transaction_.remove(root_);
  add(world, names.type, tree("Body"));
  add(world, names.type, tree("Root"));
  add(world, tree("frame"), world_frame);
  add(joint, names.type, tree("Joint"));
  add(joint, names.type, tree("Floating"));
  add(joint, tree("index"), terms.integer(-1));  // it comes first
  add(joint, tree("predecessor-frame"), world_frame);
  add(joint, tree("successor-frame"), root_frame);
  add(joint, tree("joint-frame"), made("FloatingJointFrame"));
  add(joint, tree("placement"), placement);
  const Id one = terms.real(1), zero = terms.real(0);
  const Id identity[] = {one, zero, zero, zero, zero, one, zero, zero, zero, zero, one, zero};
  Id rest = names.nil;
  for (std::size_t i = std::size(identity); i-- > 0;) {
    const Id node = terms.fresh_blank();
    add(node, names.first, identity[i]);
    add(node, names.rest, rest);
    rest = node;
  }
  add(placement, names.value, rest);
}

FloatingBase::~FloatingBase() {
  for (const graph::Quad& quad : added_) transaction_.remove(quad);
  transaction_.add(root_);
}

void FloatingBase::add(Id subject, Id predicate, Id object) {
  const graph::Quad quad{subject, predicate, object, graph_};
  if (transaction_.add(quad)) added_.push_back(quad);
}

}  // namespace sinew::synthesis
