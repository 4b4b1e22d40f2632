#include "sinew/robot/mjcf.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/algorithm/names.h"
#include "sinew/base/error.h"

namespace sinew::robot {
namespace {

std::string text(const model::Vector3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x, v.y, v.z);
}
std::string text(const Vector& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v[0], v[1], v[2]);
}

// The first two columns of R are the axes that MJCF asks for.
std::string placement(const model::Pose& X) {
  return fmt::format("pos='{}' xyaxes='{} {}'", text(X.p),
                     text(model::Vector3{X.R.xx, X.R.yx, X.R.zx}),
                     text(model::Vector3{X.R.xy, X.R.yy, X.R.zy}));
}

// About the centre of mass c: I_c = I - m (c.c 1 - c c^T), Steiner's theorem.
std::string inertial(const model::RigidBodyInertia& I) {
  const double m = I.mass;
  const model::Vector3 c{I.first_moment.x / m, I.first_moment.y / m, I.first_moment.z / m};
  const double cc = c.x * c.x + c.y * c.y + c.z * c.z;
  const auto& J = I.rotational;
  return fmt::format(
      "<inertial pos='{}' mass='{:.17g}' fullinertia='{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} "
      "{:.17g}'/>",
      text(c), m, J.xx - m * (cc - c.x * c.x), J.yy - m * (cc - c.y * c.y),
      J.zz - m * (cc - c.z * c.z), J.xy + m * c.x * c.y, J.xz + m * c.x * c.z,
      J.yz + m * c.y * c.z);
}

class Writer {
 public:
  Writer(const model::Tree& tree, const graph::Terms& terms, const Scene& scene)
      : tree_(tree), terms_(terms), scene_(scene) {}

  std::string body(std::uint32_t index) const {
    const model::Tree::Body& body = tree_.bodies[index];
    std::string xml;
    if (body.has_inertia && body.inertia.mass > 0) {
      xml += inertial(body.inertia);
    } else if (index != 0) {
      throw Error(Problem{{},
                          std::string(terms_.text(body.iri)),
                          "a body that moves and has no mass cannot be simulated",
                          "state its inertia",
                          {},
                          {}});
    }
    xml += fixtures(index);
    for (const model::Tree::Joint& joint : tree_.joints) {
      if (joint.predecessor != index) continue;
      xml +=
          fmt::format("<body name='body {}' {}>{}{}</body>\n", joint.successor,
                      placement(joint.placement), this->joint(joint), this->body(joint.successor));
    }
    return xml;
  }

  std::string table() const {
    if (!scene_.table) return "";
    const Vector half{scene_.table->size[0] / 2, scene_.table->size[1] / 2,
                      scene_.table->size[2] / 2};
    return fmt::format("<geom name='table' type='box' pos='{}' size='{}'/>",
                       text(scene_.table->center), text(half));
  }

 private:
  std::string joint(const model::Tree::Joint& joint) const {
    std::string range;
    if (!std::isnan(joint.limits.lower) && !std::isnan(joint.limits.upper))
      range = fmt::format(" limited='true' range='{:.17g} {:.17g}'", joint.limits.lower,
                          joint.limits.upper);
    return fmt::format("<joint name='{}' type='{}' axis='0 0 1' damping='{:.17g}'{}/>",
                       terms_.text(joint.iri),
                       joint.kind == model::JointKind::kPrismatic ? "slide" : "hinge",
                       scene_.joint_damping, range);
  }

  // What is fixed to a body beside its mass.
  std::string fixtures(std::uint32_t index) const {
    std::string xml;
    const auto on = [&](const std::string& frame) -> const model::Tree::Frame* {
      const model::Tree::Frame& found = find_frame(tree_, terms_, frame);
      return found.body == index ? &found : nullptr;
    };
    if (scene_.tool)
      if (const auto* frame = on(scene_.tool->frame))
        xml += fmt::format("<geom name='tool' type='sphere' size='{:.17g}' {} mass='0'/>",
                           scene_.tool->radius, placement(frame->placement));
    if (scene_.hand)
      if (const auto* frame = on(scene_.hand->frame))
        xml += fmt::format("<site name='hand' {}/>", placement(frame->placement));
    if (scene_.object)
      if (const auto* frame = on(scene_.object->frame))
        xml += fmt::format(
            "<body name='object' {}><inertial pos='{}' mass='{}' diaginertia='{} {} {}'/></body>",
            placement(frame->placement), text(scene_.object->center_of_mass), kNoMass, kNoMass,
            kNoMass, kNoMass);
    return xml;
  }

  const model::Tree& tree_;
  const graph::Terms& terms_;
  const Scene& scene_;
};

}  // namespace

const model::Tree::Frame& find_frame(const model::Tree& tree, const graph::Terms& terms,
                                     const std::string& name) {
  for (const model::Tree::Frame& frame : tree.frames) {
    const std::string_view iri = terms.text(frame.iri);
    if (iri == name || algorithm::short_name(iri) == name) return frame;
  }
  throw Error(Problem{{},
                      "",
                      "the robot has no frame '" + name + "'",
                      "name one by its IRI or its last segment",
                      {},
                      {}});
}

std::string mjcf(const model::Tree& tree, const graph::Terms& terms, const Scene& scene,
                 double timestep) {
  if (scene.tool) find_frame(tree, terms, scene.tool->frame);
  if (scene.hand) find_frame(tree, terms, scene.hand->frame);
  if (scene.object) find_frame(tree, terms, scene.object->frame);
  const auto& a = tree.base_acceleration.linear;  // minus gravity
  const Writer writer(tree, terms, scene);
  return fmt::format(
      "<mujoco><compiler angle='radian' fusestatic='false' balanceinertia='false' "
      "inertiafromgeom='false' boundmass='0' boundinertia='0'/>"
      "<option timestep='{:.17g}' gravity='{:.17g} {:.17g} {:.17g}'/>\n"
      "<worldbody>{}<body name='body 0'>{}</body></worldbody></mujoco>",
      timestep, -a.x, -a.y, -a.z, writer.table(), writer.body(0));
}

}  // namespace sinew::robot
