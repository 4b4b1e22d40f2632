// Which variables are in scope (SPARQL 1.1, section 18.2.1) while a text is read, group by group.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/rdf/sparql/syntax/ast.h"

namespace sinew::rdf::sparql::syntax {

// A stack of the variables seen; a group is what was pushed since its beginning. All in O(1).
class ScopeStack {
 public:
  using Mark = std::size_t;

  // Begins a group; give the result to `close` or `discard`.
  Mark open() {
    const Mark outer = start_;
    start_ = stack_.size();
    return outer;
  }
  // Ends the group; its variables are in scope in the outer one, too.
  void close(Mark outer) { start_ = outer; }
  // Ends the group, whose variables nobody outside sees.
  void discard(Mark outer) {
    while (stack_.size() > start_) {
      position_[stack_.back().variable] = stack_.back().previous;
      stack_.pop_back();
    }
    start_ = outer;
  }

  void see(Variable variable) {
    if (position_.size() <= variable) position_.resize(variable + 1, kNowhere);
    if (visible(variable)) return;
    stack_.push_back({variable, position_[variable]});
    position_[variable] = stack_.size() - 1;
  }
  // In the innermost group.
  bool visible(Variable variable) const {
    return variable < position_.size() && position_[variable] != kNowhere &&
           position_[variable] >= start_;
  }
  // Calls visit(Variable) for each variable of the innermost group, in the order of the text; a
  // variable may come more than once.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t i = start_; i < stack_.size(); ++i) visit(stack_[i].variable);
  }

 private:
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  struct Entry {
    Variable variable;
    std::size_t previous;  // where the variable stood before
  };
  std::vector<Entry> stack_;
  std::vector<std::size_t> position_;
  std::size_t start_ = 0;
};

}  // namespace sinew::rdf::sparql::syntax
