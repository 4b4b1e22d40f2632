#include "sinew/model/urdf_document.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <map>

namespace sinew::model::urdf {
namespace {

using Element = tinyxml2::XMLElement;

constexpr std::string_view kSpace = " \t\r\n";

// Of a joint's axis, which is made a unit vector: its square must be a number.
constexpr double kShortestAxis = 1e-100, kLongestAxis = 1e100;

// Elements that other tools add to a robot, and that say nothing about its mechanics.
constexpr std::string_view kIgnoredInRobot[] = {"material", "transmission", "gazebo",
                                                "sensor",   "ros2_control", "mujoco"};
constexpr std::string_view kIgnoredInJoint[] = {"calibration", "safety_controller"};
constexpr std::string_view kIgnoredInShape[] = {"material", "verbose", "contact_coefficients"};
constexpr std::string_view kIgnoredInLink[] = {"sensor", "self_collision_checking"};

class Reader {
 public:
  Reader(const std::string& file, bool lenient, Report& report)
      : lenient_(lenient), report_(report) {
    document_.file = file;
  }

  Document read(std::string_view text) {
    tinyxml2::XMLDocument xml;
    xml.Parse(text.data(), text.size());
    if (xml.Error()) {
      const tinyxml2::XMLError fault = xml.ErrorID();
      error(xml.ErrorLineNum(), "", fmt::format("no well-formed XML: {}", xml.ErrorName()),
            fault == tinyxml2::XML_ERROR_EMPTY_DOCUMENT ? "give a URDF file, which is not empty"
            : fault == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED
                ? "nest elements less: a URDF needs five levels"
            : fault == tinyxml2::XML_ERROR_PARSING_DECLARATION
                ? "begin with <?xml version=\"1.0\"?>, and leave any other <? … ?> out"
            : text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")
                ? "save the file as UTF-8: it begins as UTF-16 does"
                : "close every element, and quote every attribute");
      return std::move(document_);
    }
    const Element* robot = xml.RootElement();
    if (robot == nullptr || std::string_view(robot->Name()) != "robot") {
      error(robot ? robot->GetLineNum() : 1, "", "the document is no <robot>",
            "give a URDF file, with <robot> as its root");
      return std::move(document_);
    }
    if (const Element* next = robot->NextSiblingElement()) {
      error(next->GetLineNum(), "", fmt::format("<{}> stands after the robot's end", next->Name()),
            "give one <robot>, with everything in it");
    }
    document_.line = line(robot);
    document_.robot = attribute(robot, "name").value_or("");
    for (const Element* child = robot->FirstChildElement(); child;
         child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (name == "link") {
        document_.links.push_back(read_link(child));
      } else if (name == "joint") {
        document_.joints.push_back(read_joint(child));
      } else {
        other(child, "robot", kIgnoredInRobot);
      }
    }
    for (const auto& [name, seen] : ignored_) {
      report_.warning(
          {document_.file, seen.line, 0}, "",
          fmt::format("<{}> is left out, {} time{}", name, seen.count, seen.count == 1 ? "" : "s"),
          "it says nothing about the robot's mechanics");
    }
    return std::move(document_);
  }

 private:
  static std::size_t line(const Element* element) {
    return static_cast<std::size_t>(element->GetLineNum());
  }
  void error(int line, const std::string& where, std::string what, std::string remedy) {
    report_.error({document_.file, static_cast<std::size_t>(line), 0}, where, std::move(what),
                  std::move(remedy));
  }
  void error(const Element* element, std::string what, std::string remedy) {
    error(element->GetLineNum(), here_, std::move(what), std::move(remedy));
  }
  void warning(const Element* element, std::string what, std::string remedy) {
    report_.warning({document_.file, line(element), 0}, here_, std::move(what), std::move(remedy));
  }

  // A child that is not read: known to be of no matter, or unknown.
  template <std::size_t N>
  void other(const Element* element, std::string_view parent, const std::string_view (&known)[N]) {
    const std::string_view name = element->Name();
    for (const std::string_view ignored : known) {
      if (name != ignored) continue;
      auto& seen = ignored_[std::string(name)];
      if (seen.count++ == 0) seen.line = line(element);
      return;
    }
    const std::string what = fmt::format("<{}> is no element of a URDF <{}>", name, parent);
    const bool xacro = name.find("xacro:") == 0;
    const std::string remedy = xacro ? "process the file with xacro first" : "remove it";
    if (lenient_) {
      warning(element, what + "; it is left out", remedy);
    } else {
      error(element, what, remedy + (xacro ? "" : ", or load leniently to leave it out"));
    }
  }

  // What an attribute of another name says would be lost: a misspelt one, or one of a later URDF
  // (quat_xyzw). Where that does not change what moves, it is enough to say so.
  void only(const Element* element, std::initializer_list<std::string_view> known,
            bool mechanics = true) {
    for (const auto* a = element->FirstAttribute(); a; a = a->Next()) {
      const std::string_view name = a->Name();
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      const std::string what = fmt::format("<{}> has no attribute {}", element->Name(), name);
      const std::string remedy = fmt::format("write {}", fmt::join(known, ", "));
      if (mechanics && !lenient_) {
        error(element, what, remedy + "; or load leniently to leave it out");
      } else {
        warning(element, what + "; it is left out", remedy);
      }
    }
  }

  std::optional<std::string> attribute(const Element* element, const char* name) {
    const char* value = element->Attribute(name);
    if (value && *value) return value;
    error(element, fmt::format("<{}> has no {}", element->Name(), name),
          fmt::format("write <{} {}=\"…\">", element->Name(), name));
    return std::nullopt;
  }

  // Finite numbers, separated by white space; as many as there are values.
  bool parse(const Element* element, const char* name, std::string_view text,
             std::initializer_list<double*> values) {
    std::string_view rest = text;
    const auto skip = [&] {
      rest.remove_prefix(std::min(rest.find_first_not_of(kSpace), rest.size()));
    };
    bool good = true;
    for (double* value : values) {
      skip();
      if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
      const auto [end, fault] = std::from_chars(rest.data(), rest.data() + rest.size(), *value);
      const std::string_view number = rest.substr(0, static_cast<std::size_t>(end - rest.data()));
      // A number below the smallest double is zero; one above the largest is none.
      const bool tiny = fault == std::errc::result_out_of_range &&
                        number.find_first_of("eE") != std::string_view::npos &&
                        number.find('-', 1) != std::string_view::npos;
      if (tiny) *value = 0;
      good = good && (fault == std::errc{} || tiny) && std::isfinite(*value);
      rest.remove_prefix(number.size());
      good = good && (rest.empty() || kSpace.find(rest.front()) != std::string_view::npos);
    }
    skip();
    if (good && rest.empty()) return true;
    error(element,
          fmt::format("{}=\"{}\" of <{}> is not {}", name, text, element->Name(),
                      values.size() == 1 ? "a finite number"
                                         : fmt::format("{} finite numbers", values.size())),
          std::string_view(text).find("${") != std::string_view::npos
              ? "process the file with xacro first"
          : values.size() == 1 ? "write one number"
                               : "write the numbers with spaces between them");
    for (double* value : values) *value = 0;
    return false;
  }

  double required(const Element* element, const char* name) {
    double value = 0;
    if (const auto text = attribute(element, name)) parse(element, name, *text, {&value});
    return value;
  }
  std::optional<double> optional(const Element* element, const char* name) {
    const char* text = element->Attribute(name);
    if (!text) return std::nullopt;
    double value = 0;
    parse(element, name, text, {&value});
    return value;
  }
  // False where the attribute is there and faulty.
  bool three(const Element* element, const char* name, Numbers3& to) {
    const char* text = element->Attribute(name);
    return text == nullptr || parse(element, name, text, {&to[0], &to[1], &to[2]});
  }

  Origin read_origin(const Element* element) {
    Origin origin;
    only(element, {"xyz", "rpy"});
    three(element, "xyz", origin.xyz);
    three(element, "rpy", origin.rpy);
    return origin;
  }

  // Each child once: calls read(child) for the first of a name, and reports more of them.
  bool once(const Element* child, const Element*& first) {
    if (!first) {
      first = child;
      return true;
    }
    error(child, fmt::format("a second <{}>; the first is in line {}", child->Name(), line(first)),
          "keep one of them");
    return false;
  }

  Link read_link(const Element* element) {
    Link link;
    link.line = line(element);
    here_ = "link";
    link.name = attribute(element, "name").value_or("");
    here_ = "link '" + link.name + "'";
    const Element* inertial = nullptr;
    for (const Element* child = element->FirstChildElement(); child;
         child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (name == "inertial") {
        if (once(child, inertial)) link.inertial = read_inertial(child);
      } else if (name == "visual" || name == "collision") {
        if (auto shape = read_shape(child)) link.shapes.push_back(std::move(*shape));
      } else {
        other(child, "link", kIgnoredInLink);
      }
    }
    here_.clear();
    return link;
  }

  Inertial read_inertial(const Element* element) {
    Inertial inertial;
    inertial.line = line(element);
    const Element *origin = nullptr, *mass = nullptr, *inertia = nullptr;
    for (const Element* child = element->FirstChildElement(); child;
         child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (name == "origin") {
        if (once(child, origin)) inertial.origin = read_origin(child);
      } else if (name == "mass") {
        if (!once(child, mass)) continue;
        only(child, {"value"});
        inertial.mass = required(child, "value");
      } else if (name == "inertia") {
        if (!once(child, inertia)) continue;
        only(child, {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"});
        inertial.ixx = required(child, "ixx"), inertial.ixy = required(child, "ixy");
        inertial.ixz = required(child, "ixz"), inertial.iyy = required(child, "iyy");
        inertial.iyz = required(child, "iyz"), inertial.izz = required(child, "izz");
      } else {
        other(child, "inertial", kIgnoredInLink);
      }
    }
    if (!mass) error(element, "<inertial> has no <mass>", "write <mass value=\"…\"/>, in kg");
    if (!inertia) {
      error(element, "<inertial> has no <inertia>",
            "write all six moments and products, in kg m^2");
    }
    return inertial;
  }

  std::optional<Shape> read_shape(const Element* element) {
    Shape shape;
    shape.line = line(element);
    shape.visual = std::string_view(element->Name()) == "visual";
    const Element *origin = nullptr, *geometry = nullptr;
    bool good = false;
    for (const Element* child = element->FirstChildElement(); child;
         child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (name == "origin") {
        if (once(child, origin)) shape.origin = read_origin(child);
      } else if (name == "geometry") {
        if (once(child, geometry)) good = read_geometry(child, shape);
      } else {
        other(child, element->Name(), kIgnoredInShape);
      }
    }
    if (!geometry) {
      error(element, fmt::format("<{}> has no <geometry>", element->Name()),
            "give it a box, cylinder, sphere or mesh");
    }
    return good ? std::optional(std::move(shape)) : std::nullopt;
  }

  bool read_geometry(const Element* element, Shape& shape) {
    const Element* child = element->FirstChildElement();
    const std::string_view name = child ? child->Name() : "";
    if (name == "box") {
      Box box;
      const auto size = attribute(child, "size");
      if (size) parse(child, "size", *size, {&box.size[0], &box.size[1], &box.size[2]});
      shape.geometry = box;
    } else if (name == "cylinder") {
      shape.geometry = Cylinder{required(child, "radius"), required(child, "length")};
    } else if (name == "sphere") {
      shape.geometry = Sphere{required(child, "radius")};
    } else if (name == "mesh") {
      Mesh mesh;
      mesh.file = attribute(child, "filename").value_or("");
      three(child, "scale", mesh.scale);
      shape.geometry = std::move(mesh);
    } else {
      error(element,
            child ? fmt::format("<{}> is no geometry", name) : std::string("<geometry> is empty"),
            "give it a box, cylinder, sphere or mesh");
      return false;
    }
    return true;
  }

  Joint read_joint(const Element* element) {
    Joint joint;
    joint.line = line(element);
    here_ = "joint";
    joint.name = attribute(element, "name").value_or("");
    here_ = "joint '" + joint.name + "'";
    const auto type = attribute(element, "type");
    if (type) joint.type = read_type(element, *type);
    const Element *origin = nullptr, *parent = nullptr, *child = nullptr, *axis = nullptr,
                  *limit = nullptr, *dynamics = nullptr, *mimic = nullptr;
    bool knows_axis = true;
    for (const Element* e = element->FirstChildElement(); e; e = e->NextSiblingElement()) {
      const std::string_view name = e->Name();
      if (name == "origin") {
        if (once(e, origin)) joint.origin = read_origin(e);
      } else if (name == "parent") {
        if (once(e, parent)) joint.parent = attribute(e, "link").value_or("");
      } else if (name == "child") {
        if (once(e, child)) joint.child = attribute(e, "link").value_or("");
      } else if (name == "axis") {
        if (!once(e, axis)) continue;
        only(e, {"xyz"});
        knows_axis = three(e, "xyz", joint.axis);
      } else if (name == "limit") {
        if (!once(e, limit)) continue;
        only(e, {"lower", "upper", "effort", "velocity"}, false);
        joint.limit = Limit{optional(e, "lower"), optional(e, "upper"), optional(e, "effort"),
                            optional(e, "velocity")};
      } else if (name == "dynamics") {
        if (!once(e, dynamics)) continue;
        only(e, {"damping", "friction"}, false);
        joint.dynamics = {optional(e, "damping"), optional(e, "friction")};
      } else if (name == "mimic") {
        if (!once(e, mimic)) continue;
        only(e, {"joint", "multiplier", "offset"});
        joint.mimic =
            Mimic{attribute(e, "joint").value_or(""), optional(e, "multiplier").value_or(1),
                  optional(e, "offset").value_or(0)};
      } else {
        other(e, "joint", kIgnoredInJoint);
      }
    }
    if (!parent) error(element, "the joint has no <parent>", "write <parent link=\"…\"/>");
    if (!child) error(element, "the joint has no <child>", "write <child link=\"…\"/>");
    if (knows_axis) check_axis(axis ? axis : element, joint);
    check_motion(element, joint);
    here_.clear();
    return joint;
  }

  JointType read_type(const Element* element, const std::string& type) {
    if (type == "fixed") return JointType::kFixed;
    if (type == "revolute") return JointType::kRevolute;
    if (type == "continuous") return JointType::kContinuous;
    if (type == "prismatic") return JointType::kPrismatic;
    if (type == "planar") return JointType::kPlanar;
    if (type == "floating") return JointType::kFloating;
    error(element, fmt::format("'{}' is no type of joint", type),
          "write revolute, continuous, prismatic, planar, floating or fixed");
    return JointType::kFixed;
  }

  void check_axis(const Element* element, const Joint& joint) {
    if (joint.type == JointType::kFixed || joint.type == JointType::kFloating) return;
    const double length = std::hypot(joint.axis[0], joint.axis[1], joint.axis[2]);
    if (length == 0) error(element, "the joint's axis is zero", "give it a direction");
    if (length > kLongestAxis || (length > 0 && length < kShortestAxis))
      error(element, fmt::format("the joint's axis has length {}", length), "give a unit vector");
  }

  void check_motion(const Element* element, const Joint& joint) {
    if (joint.type == JointType::kFixed) return;
    const bool several = joint.type == JointType::kPlanar || joint.type == JointType::kFloating;
    if (several && joint.mimic) {
      error(element, "a joint of several degrees of freedom mimics another",
            "let only revolute, continuous and prismatic joints do so");
    }
    if (several && (joint.limit || joint.dynamics.damping || joint.dynamics.friction)) {
      warning(element, "the limits and friction of a planar or floating joint are left out",
              "URDF does not say of which of its degrees of freedom they are");
    }
    if (joint.mimic && joint.mimic->multiplier == 0) {
      warning(element, "it mimics another joint with multiplier 0, so it never moves",
              "make it a fixed joint, or state the multiplier");
    }
    const bool needs_limit =
        joint.type == JointType::kRevolute || joint.type == JointType::kPrismatic;
    if (needs_limit && !joint.limit) {
      warning(element, "the joint has no <limit>, which its type asks for",
              joint.type == JointType::kRevolute ? "write one, or make the joint continuous"
                                                 : "write one");
    }
  }

  struct Seen {
    std::size_t line = 0, count = 0;
  };
  bool lenient_;
  Report& report_;
  Document document_;
  std::string here_;  // the link or joint that is being read
  std::map<std::string, Seen> ignored_;
};

}  // namespace

Document read(std::string_view text, const std::string& file, bool lenient, Report& report) {
  if (text.size() > kMaximumUrdfBytes) {
    report.error({file, 0, 0}, "", fmt::format("the file has {} bytes", text.size()),
                 fmt::format("the limit is {}", kMaximumUrdfBytes));
    return {};
  }
  Document document = Reader(file, lenient, report).read(text);
  if (!report.has_errors()) check_tree(document, report);
  return document;
}

}  // namespace sinew::model::urdf
