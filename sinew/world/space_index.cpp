#include "sinew/world/space_index.h"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

namespace sinew::world {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<Point>;
using Value = std::pair<TreeBox, Index>;

TreeBox tree_box(const Bounds3& box) {
  return {{box.minimum.x, box.minimum.y, box.minimum.z},
          {box.maximum.x, box.maximum.y, box.maximum.z}};
}

// A number is in the tree once.
struct SameNumber {
  bool operator()(const Value& a, const Value& b) const { return a.second == b.second; }
};

}  // namespace

// The quadratic split is the cheaper one to change (Guttman 1984); objects move.
struct SpaceIndex::Tree {
  bg::index::rtree<Value, bg::index::quadratic<16>, bg::index::indexable<Value>, SameNumber> tree;
};

SpaceIndex::SpaceIndex() : tree_(std::make_unique<Tree>()) {}
SpaceIndex::~SpaceIndex() = default;
SpaceIndex::SpaceIndex(SpaceIndex&&) noexcept = default;
SpaceIndex& SpaceIndex::operator=(SpaceIndex&&) noexcept = default;

void SpaceIndex::fill(const std::vector<Entry>& entries) {
  std::vector<Value> values;
  values.reserve(entries.size());
  for (const Entry& entry : entries) values.emplace_back(tree_box(entry.box), entry.index);
  tree_->tree = decltype(tree_->tree)(values.begin(), values.end());
}

void SpaceIndex::insert(const Entry& entry) {
  tree_->tree.insert(Value{tree_box(entry.box), entry.index});
}

bool SpaceIndex::remove(const Entry& entry) {
  return tree_->tree.remove(Value{tree_box(entry.box), entry.index}) == 1;
}

void SpaceIndex::search(const Bounds3& box, std::vector<Index>& found) const {
  tree_->tree.query(bg::index::intersects(tree_box(box)),
                    boost::make_function_output_iterator(
                        [&found](const Value& value) { found.push_back(value.second); }));
}

std::size_t SpaceIndex::size() const { return tree_->tree.size(); }

}  // namespace sinew::world
