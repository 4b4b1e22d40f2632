#include "robot_tree.h"

#include "sinew/model/normalise.h"

namespace sinew::cli {

model::Tree robot_tree(Models& models, const QueryOptions& query) {
  model::NormaliseOptions options;
  options.base = query.base;
  options.lenient = models.lenient;
  if (!query.gravity.empty()) {
    const auto g = parse_vector3(query.gravity, "--gravity");
    options.gravity = model::Vector3{g[0], g[1], g[2]};
  }
  Report report;
  model::Tree tree = model::normalise(models.store, models.places, options, report);
  report.throw_if_errors();
  return tree;
}

}  // namespace sinew::cli
