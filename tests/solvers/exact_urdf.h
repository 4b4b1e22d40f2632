// A URDF for dynamics in any precision, with a reader of its own: turns are computed from roll,
// pitch and yaw in the precision itself.
#pragma once

#include <tinyxml2.h>

#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "exact_dynamics.h"

namespace sinew::test {

template <typename S>
class ExactUrdf {
 public:
  // `joints`: those that follow none, in the order of the state; a floating base comes first. A
  // planar joint has three numbers, a floating one seven positions and six velocities.
  ExactUrdf(const std::string& urdf, const std::vector<std::string>& joints, bool floating) {
    tinyxml2::XMLDocument document;
    if (document.Parse(urdf.c_str()) != tinyxml2::XML_SUCCESS)
      throw std::runtime_error("no XML: " + std::string(document.ErrorStr()));
    floating_ = floating;
    const tinyxml2::XMLElement* robot = document.RootElement();
    std::map<std::string, const tinyxml2::XMLElement*> links;
    std::multimap<std::string, const tinyxml2::XMLElement*> children;
    std::map<std::string, bool> is_child;
    std::map<std::string, std::string> types;
    for (auto* link = robot->FirstChildElement("link"); link != nullptr;
         link = link->NextSiblingElement("link"))
      links[link->Attribute("name")] = link;
    for (auto* joint = robot->FirstChildElement("joint"); joint != nullptr;
         joint = joint->NextSiblingElement("joint")) {
      children.emplace(joint->FirstChildElement("parent")->Attribute("link"), joint);
      is_child[joint->FirstChildElement("child")->Attribute("link")] = true;
      types[joint->Attribute("name")] = joint->Attribute("type");
    }
    Numbers next{floating ? 7 : 0, floating ? 6 : 0};
    for (const std::string& name : joints) {
      numbers_[name] = next;
      const std::string type = types.at(name);
      next.position += type == "floating" ? 7 : type == "planar" ? 3 : 1;
      next.velocity += type == "floating" ? 6 : type == "planar" ? 3 : 1;
    }
    robot_.velocities = next.velocity;
    robot_.links.push_back({});  // the world
    for (const auto& [name, link] : links)
      if (!is_child[name]) add(links, children, name, 0, base());
  }

  const ExactRobot<S>& robot() const { return robot_; }

 private:
  using Vector3 = Eigen::Matrix<S, 3, 1>;
  using Matrix3 = Eigen::Matrix<S, 3, 3>;
  using Element = const tinyxml2::XMLElement*;
  struct Numbers {
    int position = 0, velocity = 0;  // where a joint's begin
  };

  static Vector3 vector(Element element, const char* attribute, const Vector3& otherwise) {
    const char* text = element != nullptr ? element->Attribute(attribute) : nullptr;
    if (text == nullptr) return otherwise;
    std::istringstream in(text);
    double x = 0, y = 0, z = 0;
    in >> x >> y >> z;
    return Vector3(S(x), S(y), S(z));
  }

  static double number(Element element, const char* attribute, double otherwise = 0) {
    return element != nullptr ? element->DoubleAttribute(attribute, otherwise) : otherwise;
  }

  static Matrix3 turn(int axis, const S& angle) {
    using std::cos;
    using std::sin;
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    Matrix3 R = Matrix3::Identity();
    R(j, j) = R(k, k) = cos(angle);
    R(k, j) = sin(angle);
    R(j, k) = -sin(angle);
    return R;
  }

  static Matrix3 rotation(Element origin) {
    const Vector3 rpy = vector(origin, "rpy", Vector3::Zero());
    return turn(2, rpy.z()) * turn(1, rpy.y()) * turn(0, rpy.x());
  }

  ExactJoint<S> base() const {
    ExactJoint<S> joint;
    if (floating_) joint.kind = ExactKind::kFloating;
    return joint;
  }

  static ExactLink<S> link_of(Element link) {
    ExactLink<S> result;
    result.name = link->Attribute("name");
    Element inertial = link->FirstChildElement("inertial");
    if (inertial == nullptr) return result;
    Element origin = inertial->FirstChildElement("origin"),
            inertia = inertial->FirstChildElement("inertia");
    result.mass = S(number(inertial->FirstChildElement("mass"), "value"));
    result.com = vector(origin, "xyz", Vector3::Zero());
    Matrix3 I;
    const auto at = [&](const char* name) { return S(number(inertia, name)); };
    I << at("ixx"), at("ixy"), at("ixz"), at("ixy"), at("iyy"), at("iyz"), at("ixz"), at("iyz"),
        at("izz");
    const Matrix3 R = rotation(origin);
    result.inertia = R * I * R.transpose();
    return result;
  }

  ExactJoint<S> joint_of(Element joint, int parent) const {
    ExactJoint<S> result;
    result.parent = parent;
    Element origin = joint->FirstChildElement("origin");
    result.translation = vector(origin, "xyz", Vector3::Zero());
    result.rotation = rotation(origin);
    const std::string type = joint->Attribute("type");
    if (type == "fixed") return result;
    if (type == "floating") {
      result.kind = ExactKind::kFloating;
      result.velocity = numbers_.at(joint->Attribute("name")).velocity;
      result.position = numbers_.at(joint->Attribute("name")).position;
      return result;
    }
    if (type == "planar") {  // the normal is z in these tests
      const Numbers at = numbers_.at(joint->Attribute("name"));
      for (int k = 0; k < 3; ++k) {
        result.motions.push_back({k == 2, Vector3::Unit(k), at.velocity + k, at.position + k});
      }
      return result;
    }
    if (type != "revolute" && type != "continuous" && type != "prismatic")
      throw std::runtime_error("no reference for joints of type " + type);
    ExactMotion<S> motion;
    motion.turns = type != "prismatic";
    motion.axis = vector(joint->FirstChildElement("axis"), "xyz", Vector3::UnitX());
    using std::sqrt;
    motion.axis /= sqrt(motion.axis.squaredNorm());
    std::string leader = joint->Attribute("name");
    if (Element mimic = joint->FirstChildElement("mimic")) {
      leader = mimic->Attribute("joint");
      motion.ratio = S(number(mimic, "multiplier", 1));
      motion.offset = S(number(mimic, "offset", 0));
    }
    motion.coordinate = numbers_.at(leader).velocity;
    motion.position = numbers_.at(leader).position;
    result.motions = {motion};
    return result;
  }

  void add(const std::map<std::string, Element>& links,
           const std::multimap<std::string, Element>& children, const std::string& name, int parent,
           ExactJoint<S> joint) {
    joint.parent = parent;
    robot_.joints.push_back(std::move(joint));
    robot_.links.push_back(link_of(links.at(name)));
    const int index = static_cast<int>(robot_.links.size()) - 1;
    const auto [first, last] = children.equal_range(name);
    for (auto at = first; at != last; ++at)
      add(links, children, at->second->FirstChildElement("child")->Attribute("link"), index,
          joint_of(at->second, index));
  }

  bool floating_ = false;
  std::map<std::string, Numbers> numbers_;
  ExactRobot<S> robot_;
};

}  // namespace sinew::test
