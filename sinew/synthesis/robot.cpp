#include "sinew/synthesis/robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sinew/algorithm/names.h"
#include "sinew/base/error.h"
#include "sinew/rdf/sparql/prepared.h"

namespace sinew::synthesis {
namespace {

using algorithm::short_name;
using graph::View;
using Row = std::vector<Id>;

constexpr std::string_view kPrefixes =
    "PREFIX tree: <https://w3id.org/sinew/kinematic-tree#>\n"
    "PREFIX geom: <https://comp-rob2b.github.io/metamodels/geometry/structural-entities#>\n"
    "PREFIX kc: <https://comp-rob2b.github.io/metamodels/kinematic-chain/structural-entities#>\n";

std::vector<Row> select(graph::Store& store, const View& view, std::string_view text) {
  std::vector<Row> rows;
  const auto query = rdf::sparql::prepare(store, std::string(kPrefixes) + std::string(text));
  query->select(view, {}, [&](std::span<const Id> row) {
    rows.emplace_back(row.begin(), row.end());
    return true;
  });
  return rows;
}

std::string text(const View& view, Id id) { return std::string(view.terms().text(id)); }

Error fault(std::string iri, std::string what, std::string remedy) {
  return Error(Problem{{}, std::move(iri), std::move(what), std::move(remedy), {}, {}});
}

void read_root(graph::Store& store, const View& view, Robot& robot) {
  const auto roots = select(store, view, R"(
    SELECT ?body ?frame WHERE { ?body a tree:Root ; tree:frame ?frame })");
  if (roots.empty())
    throw fault("", "there is no normalised kinematic tree", "normalise the model first");
  if (roots.size() > 1) {
    std::string list;
    for (const Row& row : roots) list += (list.empty() ? "" : ", ") + text(view, row[0]);
    throw fault(text(view, roots[0][0]), "more than one root: " + list, "choose one as the base");
  }
  robot.root_body = roots[0][0];
  robot.root_frame = roots[0][1];
  const Id property =
      view.terms().find_iri("https://w3id.org/sinew/kinematic-tree#base-acceleration");
  if (property) robot.base_acceleration = view.object(robot.root_frame, property);
}

Id property(const View& view, std::string_view name) {
  return view.terms().find_iri("https://w3id.org/sinew/kinematic-tree#" + std::string(name));
}

// "Spherical" as "spherical"
std::string lower_case(std::string_view name) {
  std::string text(name);
  text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  return text;
}

// Which joints follow others, and which carry rotors.
void read_couplings(const View& view, Robot& robot) {
  const Id follows = property(view, "follows"), ratio = property(view, "ratio"),
           offset = property(view, "offset"), rotor = property(view, "rotor-inertia");
  const auto number = [&](Id subject, Id predicate, double other) {
    const Id value = predicate ? view.object(subject, predicate) : Id{};
    return value ? view.terms().number(value).value() : other;
  };
  for (RobotJoint& joint : robot.joints) {
    joint.rotor_inertia = number(joint.joint, rotor, 0);
    const Id leader = follows ? view.object(joint.joint, follows) : Id{};
    if (!leader) continue;
    for (std::size_t k = 0; k < robot.joints.size(); ++k)
      if (robot.joints[k].joint == leader) joint.follows = static_cast<int>(k);
    joint.ratio = number(joint.joint, ratio, 1);
    joint.offset = number(joint.joint, offset, 0);
  }
}

// Joints of the model that are sequences; their parts are called by the joint's name and a number.
void read_compounds(graph::Store& store, const View& view, Robot& robot) {
  const auto rows = select(store, view, R"(
    SELECT ?part ?compound ?kind WHERE {
      ?part tree:part-of ?compound . ?compound a ?kind . FILTER (?kind != tree:Compound)
    })");
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    RobotJoint& joint = robot.joints[k];
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& one) {
      return one[0] == joint.joint &&
             view.terms().text(one[2]).starts_with("https://w3id.org/sinew/kinematic-tree#");
    });
    if (row == rows.end()) continue;
    const Id whole = (*row)[1];
    if (robot.compounds.empty() || robot.compounds.back().joint != whole)
      robot.compounds.push_back({whole, lower_case(short_name(view.terms().text((*row)[2]))), {}});
    RobotCompound& compound = robot.compounds.back();
    joint.compound = static_cast<int>(robot.compounds.size()) - 1;
    joint.label = fmt::format("{}-{}", short_name(view.terms().text(whole)), compound.parts.size());
    compound.parts.push_back(k);
  }
}

}  // namespace

bool Robot::coupled() const {
  return std::any_of(joints.begin(), joints.end(),
                     [](const RobotJoint& joint) { return joint.follows >= 0; });
}

bool Robot::leads_to_link(const RobotJoint& joint) const {
  return joint.compound < 0 ||
         joints[compounds[static_cast<std::size_t>(joint.compound)].parts.back()].joint ==
             joint.joint;
}

Robot read_base(graph::Store& store, const View& view) {
  Robot robot;
  read_root(store, view, robot);
  return robot;
}

Robot read_robot(graph::Store& store, const View& view) {
  Robot robot = read_base(store, view);
  std::vector<Row> rows = select(store, view, R"(
    SELECT ?index ?joint ?kind ?joint_frame ?frame ?predecessor ?successor ?parent WHERE {
      ?joint tree:index ?index ; a ?kind ; tree:joint-frame ?joint_frame ;
             tree:successor-frame ?frame ; tree:predecessor-frame ?parent .
      VALUES ?kind { tree:Revolute tree:Prismatic tree:Floating }
      ?predecessor tree:frame ?parent .
      ?successor tree:frame ?frame .
    })");
  const auto index = [&](const Row& row) { return view.terms().integer_value(row[0]).value_or(0); };
  std::sort(rows.begin(), rows.end(),
            [&](const Row& a, const Row& b) { return index(a) < index(b); });
  for (const Row& row : rows) {
    const std::string kind = lower_case(short_name(view.terms().text(row[2])));
    robot.joints.push_back({row[1], kind, row[3], row[4], row[5], row[6], row[7]});
  }
  read_couplings(view, robot);
  read_compounds(store, view, robot);
  return robot;
}

std::vector<std::size_t> path_to(const Robot& robot, const View& view, Id frame) {
  std::vector<std::size_t> path;
  Id at = body_frame(view, frame);
  while (at != robot.root_frame) {
    const auto joint = std::find_if(robot.joints.begin(), robot.joints.end(),
                                    [&](const RobotJoint& one) { return one.frame == at; });
    if (joint == robot.joints.end())
      throw fault(text(view, frame),
                  "no path leads to it from the base " + text(view, robot.root_frame),
                  "choose a base and a tip of the same chain");
    path.push_back(static_cast<std::size_t>(joint - robot.joints.begin()));
    at = joint->parent_frame;
  }
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<Id> leaf_frames(graph::Store& store, const View& view, const Robot& robot) {
  // A link to which one joint is attached; the body's own IRI is that of its first link.
  const auto rows = select(store, view, R"(
    SELECT ?link ?frame ?body WHERE {
      ?body tree:contains ?link .
      ?link tree:root-frame ?frame .
      FILTER NOT EXISTS {
        ?link geom:simplices ?one, ?other .
        ?a kc:between-attachments ?one .
        ?b kc:between-attachments ?other .
        FILTER (?a != ?b)
      }
    })");
  std::vector<Id> frames;
  for (const Row& row : rows)
    if (row[2] != robot.root_body) frames.push_back(row[1]);  // what is fixed to the base is no tip
  return frames;
}

Id find_frame(graph::Store& store, const View& view, std::string_view name) {
  const auto rows = select(store, view, R"(
    SELECT ?frame ?link WHERE {
      { ?body tree:frame ?frame } UNION { ?frame tree:fixed-to ?other }
      OPTIONAL { ?link tree:root-frame ?frame }
    })");
  std::vector<Id> exact, by_name, by_link;
  const auto note = [](std::vector<Id>& list, Id frame) {
    if (std::find(list.begin(), list.end(), frame) == list.end()) list.push_back(frame);
  };
  for (const Row& row : rows) {
    const std::string_view frame = view.terms().text(row[0]);
    const std::string_view link = row[1] ? view.terms().text(row[1]) : std::string_view{};
    if (frame == name || link == name) note(exact, row[0]);
    if (algorithm::is_called(frame, name)) note(by_name, row[0]);
    if (row[1] && algorithm::is_called(link, name)) note(by_link, row[0]);
  }
  // A link and its root frame often share their name with further frames, such as that of its
  // inertia.
  for (const std::vector<Id>* list : {&exact, &by_name, &by_link})
    if (list->size() == 1) return list->front();
  for (const std::vector<Id>* list : {&exact, &by_name, &by_link}) {
    if (list->empty()) continue;
    std::string all;
    for (const Id one : *list) all += (all.empty() ? "" : ", ") + text(view, one);
    throw fault(std::string(name), "several frames have this name: " + all, "use the whole IRI");
  }
  // Frames that nobody named have no name that would help.
  std::vector<std::string> known;
  for (const Row& row : rows)
    if (row[1]) known.emplace_back(short_name(view.terms().text(row[1])));
  if (known.empty())
    for (const Row& row : rows) known.emplace_back(short_name(view.terms().text(row[0])));
  std::sort(known.begin(), known.end());
  constexpr std::size_t kNamesInAnError = 12;
  const bool more = known.size() > kNamesInAnError;
  if (more) known.resize(kNamesInAnError);
  throw fault(
      std::string(name), "no frame or link of the tree has this name",
      fmt::format("a frame's IRI, or one of {}{}", fmt::join(known, ", "), more ? ", ..." : ""));
}

Id body_frame(const View& view, Id frame) {
  const Id property = view.terms().find_iri("https://w3id.org/sinew/kinematic-tree#fixed-to");
  const Id body = property ? view.object(frame, property) : Id{};
  return body ? body : frame;
}

}  // namespace sinew::synthesis
