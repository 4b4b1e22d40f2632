#include "sinew/model/tree.h"

#include <algorithm>

namespace sinew::model {
namespace {

template <typename Element>
const Element* find(const std::vector<Element>& elements, Id iri) {
  for (const Element& element : elements) {
    if (element.iri == iri) return &element;
  }
  return nullptr;
}

}  // namespace

const Tree::Frame* Tree::find_frame(Id iri) const { return find(frames, iri); }
const Tree::Link* Tree::find_link(Id iri) const { return find(links, iri); }
const Tree::Joint* Tree::find_joint(Id iri) const { return find(joints, iri); }

std::vector<std::uint32_t> Tree::path(std::uint32_t body) const {
  std::vector<std::uint32_t> way;
  for (; body != 0; body = joints[body - 1].predecessor) way.push_back(body - 1);
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace sinew::model
