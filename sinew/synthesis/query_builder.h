// Queries in C++, in the words of the model: what
// `Ask("wrist").the("pose").of("tool").wrt("link3")` says is what the JSON-LD form says
// (docs/queries.md), and gives the same algorithm.
//
//   const Query query = Ask("wrist")
//                           .the("twist").of("tool").wrt("link3").seen_by("base")
//                           .the("joint-force").of("every-joint")
//                           .given("joint-position").of("every-joint")
//                           .given("gravity");
#pragma once

#include <array>
#include <string>
#include <utility>

#include "sinew/synthesis/query.h"

namespace sinew::synthesis {

class Ask {
 public:
  explicit Ask(std::string name) { query_.name = std::move(name); }
  // More of a query that is there already, such as a named one.
  explicit Ask(Query query) : query_(std::move(query)) {}

  // One more quantity that is asked; and one more that is given. What follows says more of it.
  Ask& the(std::string quantity) {
    query_.asked.push_back({std::move(quantity), "", ""});
    asks_ = true;
    return *this;
  }
  Ask& given(std::string quantity) {
    query_.given.push_back({std::move(quantity), ""});
    asks_ = false;
    return *this;
  }
  // An IRI or its last segment, every-joint, every-tip; base and itself where there is one frame.
  Ask& of(std::string element) {
    (asks_ ? query_.asked.back().of : query_.given.back().of) = std::move(element);
    return *this;
  }
  Ask& seen_by(std::string frame) {
    (asks_ ? query_.asked.back().seen_by : query_.given.back().seen_by) = std::move(frame);
    return *this;
  }
  Ask& wrt(std::string frame) {
    query_.asked.back().with_respect_to = std::move(frame);
    return *this;
  }
  Ask& that_varies() {
    query_.given.back().varies = true;
    return *this;
  }

  // Of the query as a whole.
  Ask& from(std::string base) {
    query_.base = std::move(base);
    return *this;
  }
  Ask& to(std::string tip) {
    query_.tips.push_back(std::move(tip));
    return *this;
  }
  Ask& with_gravity(double x, double y, double z) {
    query_.gravity = std::array<double, 3>{x, y, z};
    return *this;
  }
  Ask& floating() {
    query_.floating = true;
    return *this;
  }
  Ask& forces(Forces policy) {
    query_.forces = policy;
    return *this;
  }
  Ask& frames(Frames policy) {
    query_.frames = policy;
    return *this;
  }
  // Had at a lower rate; of one element, or of all that it is of.
  Ask& holding(std::string quantity, std::string of = {}) {
    query_.held.push_back({std::move(quantity), std::move(of)});
    return *this;
  }

  operator Query() const { return query_; }  // NOLINT(google-explicit-constructor): it is one

 private:
  Query query_;
  bool asks_ = true;  // whether the last thing said was asked
};

}  // namespace sinew::synthesis
