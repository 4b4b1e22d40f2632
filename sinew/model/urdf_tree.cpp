// Whether the links and joints of a URDF document form one tree.
#include <fmt/format.h>

#include <unordered_map>

#include "sinew/model/urdf_document.h"

namespace sinew::model::urdf {
namespace {

struct Checker {
  const Document& document;
  Report& report;
  std::unordered_map<std::string, std::size_t> link = {}, joint = {};  // index by name

  void error(std::size_t line, std::string where, std::string what, std::string remedy) {
    report.error({document.file, line, 0}, std::move(where), std::move(what), std::move(remedy));
  }

  // Index by name, with an error for each name that comes twice.
  template <typename Element>
  void index(const std::vector<Element>& elements, std::string_view kind,
             std::unordered_map<std::string, std::size_t>& by_name) {
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const auto [found, fresh] = by_name.emplace(elements[i].name, i);
      if (fresh) continue;
      error(elements[i].line, fmt::format("{} '{}'", kind, elements[i].name),
            fmt::format("the name is used already, in line {}", elements[found->second].line),
            fmt::format("give every {} a name of its own", kind));
    }
  }

  void run() {
    index(document.links, "link", link);
    index(document.joints, "joint", joint);
    if (document.links.empty()) {
      error(document.line, "", "the robot has no links", "give it at least one");
      return;
    }
    std::vector<const Joint*> into(document.links.size());
    for (const Joint& j : document.joints) check_joint(j, into);
    if (!report.has_errors()) check_roots(into);
  }

  void check_joint(const Joint& j, std::vector<const Joint*>& into) {
    const std::string here = fmt::format("joint '{}'", j.name);
    for (const std::string& name : {j.parent, j.child}) {
      if (!link.contains(name)) {
        error(j.line, here, fmt::format("there is no link '{}'", name),
              "name a link of this robot, or add that link");
        return;
      }
    }
    if (j.mimic && !joint.contains(j.mimic->joint)) {
      error(j.line, here, fmt::format("it mimics '{}', which is no joint", j.mimic->joint),
            "name a joint of this robot");
    }
    if (j.parent == j.child) {
      error(j.line, here, fmt::format("it connects '{}' with itself", j.parent),
            "connect two links");
      return;
    }
    const Joint*& other = into[link[j.child]];
    if (other) {
      error(j.line, here,
            fmt::format("'{}' is the child of '{}' already, in line {}", j.child, other->name,
                        other->line),
            "let every link be the child of at most one joint: URDF describes trees");
    } else {
      other = &j;
    }
  }

  void check_roots(const std::vector<const Joint*>& into) {
    std::string roots;
    std::size_t count = 0, second = 0;
    for (std::size_t i = 0; i < into.size(); ++i) {
      if (into[i]) continue;
      if (++count == 2) second = i;
      roots += fmt::format("{}'{}'", roots.empty() ? "" : ", ", document.links[i].name);
    }
    if (count > 1) {
      error(document.links[second].line, "", fmt::format("there are {} roots: {}", count, roots),
            "let joints connect all links to one root");
    }
    check_loops(into);
  }

  // A link that cannot be followed up to a root is part of a loop, or hangs on one.
  void check_loops(const std::vector<const Joint*>& into) {
    enum class Mark : char { kNew, kOpen, kDone };
    std::vector<Mark> marks(into.size(), Mark::kNew);
    for (std::size_t start = 0; start < into.size(); ++start) {
      std::size_t at = start;
      std::vector<std::size_t> way;
      while (marks[at] == Mark::kNew) {
        marks[at] = Mark::kOpen;
        way.push_back(at);
        if (!into[at]) break;
        at = link[into[at]->parent];
      }
      if (into[at] && marks[at] == Mark::kOpen) {
        std::string joints;
        std::size_t l = at;
        do {
          joints += fmt::format("{}'{}'", joints.empty() ? "" : ", ", into[l]->name);
          l = link[into[l]->parent];
        } while (l != at);
        error(into[at]->line, fmt::format("joint '{}'", into[at]->name),
              fmt::format("the joints form a loop: {}", joints), "remove one of them");
      }
      for (const std::size_t done : way) marks[done] = Mark::kDone;
    }
  }
};

}  // namespace

void check_tree(const Document& document, Report& report) { Checker{document, report}.run(); }

}  // namespace sinew::model::urdf
