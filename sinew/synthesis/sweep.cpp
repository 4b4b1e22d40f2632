#include "sinew/synthesis/sweep.h"

#include <algorithm>
#include <memory>
#include <unordered_map>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/prepared.h"

namespace sinew::synthesis {
namespace {

using Prepared = std::shared_ptr<const rdf::sparql::Prepared>;

// A row of an expansion, and where it leads from and to.
struct Edge {
  std::size_t expansion = 0;
  Id parent, child;
  std::vector<Id> row;
};

class Traversal {
 public:
  Traversal(Context& context, std::span<const Sweep> sweeps) : context_(context), sweeps_(sweeps) {
    for (const Sweep& sweep : sweeps) {
      std::vector<Call>& calls = calls_.emplace_back();
      for (const Step* step : sweep.steps) {
        const std::size_t first = calls.size();
        for (const Visitor& visitor : step->visitors) calls.push_back(call_of(*step, visitor));
        // On the way out a child is ready after its edge; on the way in, before it.
        std::stable_partition(calls.begin() + static_cast<std::ptrdiff_t>(first), calls.end(),
                              [&](const Call& call) {
                                return (call.visitor->where == Where::kEdge) == is_outward(sweep);
                              });
      }
    }
  }

  TraversalCounts run() {
    expand();
    for (std::size_t i = 0; i < sweeps_.size(); ++i)
      for (const auto pass : {&Visitor::configure, &Visitor::compute})
        go(sweeps_[i], calls_[i], pass);
    return counts_;
  }

 private:
  // A query that steps ask, and what it has answered.
  struct Asked {
    Prepared query;
    std::unordered_map<Id, std::vector<std::vector<Id>>> rows;
    std::unordered_map<std::uint64_t, bool> answers;
  };

  // A visitor with its queries.
  struct Call {
    const Step* step;
    const Visitor* visitor;
    std::size_t expansion;
    Asked* select = nullptr;
    std::vector<Asked*> conditions = {};
  };

  Call call_of(const Step& step, const Visitor& visitor) {
    Call call{&step, &visitor,
              cluster(visitor.expansion.empty() ? step.expansion : visitor.expansion)};
    for (const std::string& text : visitor.conditions) call.conditions.push_back(&prepare(text));
    if (!visitor.select.empty()) call.select = &prepare(visitor.select);
    return call;
  }

  Asked& prepare(const std::string& text) {
    Asked& asked = asked_[text];
    if (!asked.query)
      asked.query = rdf::sparql::prepare(context_.store, text, {"node", "parent", "algorithm"});
    return asked;
  }

  // Steps with the same expansion query form one cluster.
  std::size_t cluster(const std::string& text) {
    const auto [found, fresh] = clusters_.try_emplace(text, expansions_.size());
    if (fresh) expansions_.push_back(prepare(text).query);
    return found->second;
  }

  static std::size_t column(const rdf::sparql::Prepared& query, std::string_view name) {
    const auto& columns = query.columns();
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                    columns.begin());
  }

  // Breadth first from the root; every node is expanded once.
  void expand() {
    nodes_.push_back(context_.robot.root_frame);
    std::unordered_map<Id, std::size_t> depth = {{nodes_.front(), 0}};
    for (std::size_t at = 0; at < nodes_.size(); ++at) {
      const Id node = nodes_[at];
      std::vector<Edge> found;
      for (std::size_t i = 0; i < expansions_.size(); ++i) expand(node, i, found);
      sort_by_index(found);
      for (Edge& edge : found) {
        const auto [place, fresh] = depth.try_emplace(edge.child, depth[node] + 1);
        if (fresh) nodes_.push_back(edge.child);
        if (place->second > kMaximumDepth || (!fresh && place->second != depth[node] + 1))
          throw Error(Problem{{},
                              std::string(context_.view.terms().text(edge.child)),
                              "it is reached on two ways from the root",
                              "a tree: cut the loop by a constraint",
                              {},
                              {}});
        edges_.push_back(std::move(edge));
      }
    }
    counts_.nodes = nodes_.size();
  }

  void expand(Id node, std::size_t expansion, std::vector<Edge>& found) {
    const rdf::sparql::Prepared& query = *expansions_[expansion];
    const std::size_t child = column(query, "child");
    const Id parameters[] = {node, Id{}, context_.builder.algorithm().id};
    query.select(context_.view, parameters, [&](std::span<const Id> row) {
      if (!in_scope(row[child])) return true;
      found.push_back({expansion, node, row[child], {row.begin(), row.end()}});
      return true;
    });
    ++counts_.expansions;
  }

  // Frames that are fixed to a body are always of interest when an expansion leads there.
  bool in_scope(Id child) const {
    return context_.scope.empty() || context_.scope.contains(child) || !is_body_frame(child);
  }

  bool is_body_frame(Id frame) const {
    return std::any_of(context_.robot.joints.begin(), context_.robot.joints.end(),
                       [&](const RobotJoint& joint) { return joint.frame == frame; });
  }

  // Siblings in the order of ?index where an expansion has it, otherwise as they were found.
  void sort_by_index(std::vector<Edge>& edges) const {
    const graph::Terms& terms = context_.view.terms();
    std::stable_sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) {
      if (a.expansion != b.expansion) return a.expansion < b.expansion;
      const std::size_t index = column(*expansions_[a.expansion], "index");
      if (index == a.row.size()) return false;
      return terms.integer_value(a.row[index]).value_or(0) <
             terms.integer_value(b.row[index]).value_or(0);
    });
  }

  static bool is_outward(const Sweep& sweep) { return sweep.direction != Direction::kInward; }

  void go(const Sweep& sweep, std::span<const Call> calls, Pass Visitor::*pass) {
    const bool outward = is_outward(sweep);
    if (outward) visit_root(calls, pass);
    if (sweep.direction == Direction::kOnce) return;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Edge& edge = edges_[outward ? i : edges_.size() - 1 - i];
      for (const Call& call : calls) {
        if (call.expansion != edge.expansion) continue;
        if (call.visitor->where == Where::kNode)
          visit(call, {edge.child, {}, {}, {}}, pass);
        else
          visit(call, {edge.child, edge.parent, expansions_[edge.expansion]->columns(), edge.row},
                pass);
      }
    }
    if (!outward) visit_root(calls, pass);
  }

  void visit_root(std::span<const Call> calls, Pass Visitor::*pass) {
    for (const Call& call : calls)
      if (call.visitor->where == Where::kNode && call.visitor->expansion.empty())
        visit(call, {context_.robot.root_frame, {}, {}, {}}, pass);
  }

  void visit(const Call& call, Visit visit, Pass Visitor::*pass) {
    const Pass& run = call.visitor->*pass;
    if (!run || !holds(call, visit.node, visit.parent)) return;
    context_.step = call.step;
    if (call.select == nullptr) {
      run(context_, visit);
      return;
    }
    for (const std::vector<Id>& row : select(*call.select, visit.node)) {
      visit.columns = call.select->query->columns();
      visit.row = row;
      run(context_, visit);
    }
  }

  // The configure and the compute pass ask the same; the second one is answered from memory.
  const std::vector<std::vector<Id>>& select(Asked& asked, Id node) {
    const auto [found, fresh] = asked.rows.try_emplace(node);
    if (fresh) {
      const Id parameters[] = {node, Id{}, context_.builder.algorithm().id};
      asked.query->select(context_.view, parameters, [&](std::span<const Id> row) {
        found->second.emplace_back(row.begin(), row.end());
        return true;
      });
      ++counts_.selections;
    }
    return found->second;
  }

  bool holds(const Call& call, Id node, Id parent) {
    for (Asked* const asked : call.conditions) {
      const std::uint64_t key = std::uint64_t{node.value} << 32 | parent.value;
      const auto [found, fresh] = asked->answers.try_emplace(key, false);
      if (fresh) {
        const Id parameters[] = {node, parent, context_.builder.algorithm().id};
        found->second = asked->query->ask(context_.view, parameters);
        ++counts_.conditions;
      }
      if (!found->second) return false;
    }
    return true;
  }

  Context& context_;
  std::span<const Sweep> sweeps_;
  TraversalCounts counts_;
  std::unordered_map<std::string, Asked> asked_;
  std::unordered_map<std::string, std::size_t> clusters_;
  std::vector<Prepared> expansions_;
  std::vector<std::vector<Call>> calls_;  // of each sweep, in the order in which an edge has them
  std::vector<Id> nodes_;
  std::vector<Edge> edges_;
};

}  // namespace

TraversalCounts run_sweeps(Context& context, std::span<const Sweep> sweeps) {
  return Traversal(context, sweeps).run();
}

}  // namespace sinew::synthesis
