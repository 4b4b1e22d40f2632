#include "sinew/robot/scene.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "sinew/base/error.h"

namespace sinew::robot {
namespace {

using Json = nlohmann::json;

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& where, std::string what, std::string remedy) const {
    throw Error(
        Problem{{file_, 0, 0}, "", where + ": " + std::move(what), std::move(remedy), {}, {}});
  }

  // An object with these keys and no others.
  void keys(const Json& value, const std::string& where, const std::set<std::string>& required,
            const std::set<std::string>& optional = {}) const {
    if (!value.is_object()) fail(where, "is no object", "write { \"key\": value }");
    for (const std::string& key : required)
      if (!value.contains(key)) fail(where, "has no '" + key + "'", "state it");
    for (const auto& [key, ignored] : value.items())
      if (!required.contains(key) && !optional.contains(key))
        fail(where, "'" + key + "' is unknown", "see the documentation of scenes");
  }

  double number(const Json& value, const std::string& where) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(where, "is no number", "a finite number, in SI units");
    return value.get<double>();
  }
  double positive(const Json& value, const std::string& where) const {
    const double result = number(value, where);
    if (!(result > 0)) fail(where, "is not positive", "a number greater than 0");
    return result;
  }
  Vector vector(const Json& value, const std::string& where) const {
    if (!value.is_array() || value.size() != 3) fail(where, "is no vector", "three numbers");
    return {number(value[0], where), number(value[1], where), number(value[2], where)};
  }
  Vector positive_vector(const Json& value, const std::string& where) const {
    const Vector result = vector(value, where);
    for (const double each : result)
      if (!(each > 0)) fail(where, "is not positive", "numbers greater than 0");
    return result;
  }
  std::string text(const Json& value, const std::string& where) const {
    if (!value.is_string()) fail(where, "is no text", "write it in quotes");
    return value.get<std::string>();
  }

  Hand hand(const Json& value) const {
    keys(value, "hand", {"frame", "stiffness", "damping", "maximum-force", "phases"});
    Hand hand{text(value["frame"], "hand: frame"),
              positive(value["stiffness"], "hand: stiffness"),
              number(value["damping"], "hand: damping"),
              positive(value["maximum-force"], "hand: maximum-force"),
              {}};
    const Json& phases = value["phases"];
    if (!phases.is_array() || phases.empty() || phases.size() > kMaximumPhases)
      fail("hand: phases", "is no list of phases", "1 to 1000 of them");
    double before = 0;
    for (const Json& each : phases) {
      const std::string where = "hand: phase " + std::to_string(hand.phases.size() + 1);
      keys(each, where, {"name", "until"}, {"velocity", "force"});
      HandPhase phase{text(each["name"], where), number(each["until"], where), {}, {}};
      if (!(phase.until > before))
        fail(where, "ends before it begins", "phases follow each other in time");
      before = phase.until;
      if (each.contains("velocity")) phase.velocity = vector(each["velocity"], where);
      if (each.contains("force")) phase.force = vector(each["force"], where);
      if (phase.velocity && phase.force)
        fail(where, "has a velocity and a force", "a hand guides or pushes");
      hand.phases.push_back(std::move(phase));
    }
    return hand;
  }

  Scene scene(const Json& value) const {
    keys(value, "scene", {}, {"start", "joint-damping", "tool", "table", "object", "hand"});
    Scene scene;
    if (value.contains("start")) {
      if (!value["start"].is_object()) fail("start", "is no object", "joints and numbers");
      for (const auto& [name, at] : value["start"].items())
        scene.start[name] = number(at, "start: " + name);
    }
    if (value.contains("joint-damping")) {
      scene.joint_damping = number(value["joint-damping"], "joint-damping");
      if (scene.joint_damping < 0) fail("joint-damping", "is negative", "0 or more");
    }
    if (value.contains("tool")) {
      const Json& tool = value["tool"];
      keys(tool, "tool", {"frame", "radius"});
      scene.tool =
          Tool{text(tool["frame"], "tool: frame"), positive(tool["radius"], "tool: radius")};
    }
    if (value.contains("table")) {
      const Json& table = value["table"];
      keys(table, "table", {"center", "size"});
      scene.table = Table{vector(table["center"], "table: center"),
                          positive_vector(table["size"], "table: size")};
      if (!scene.tool) fail("table", "nothing can touch it", "state the tool");
    }
    if (value.contains("object")) {
      const Json& object = value["object"];
      keys(object, "object", {"frame", "mass", "center-of-mass", "inertia"});
      scene.object =
          Object{text(object["frame"], "object: frame"), positive(object["mass"], "object: mass"),
                 vector(object["center-of-mass"], "object: center-of-mass"),
                 positive_vector(object["inertia"], "object: inertia")};
    }
    if (value.contains("hand")) scene.hand = hand(value["hand"]);
    return scene;
  }

 private:
  std::string file_;
};

}  // namespace

Scene parse_scene(std::string_view json, const std::string& file) {
  const Reader reader(file);
  Json value;
  try {
    value = Json::parse(json);
  } catch (const Json::exception& fault) {
    reader.fail("scene", fault.what(), "write JSON");
  }
  return reader.scene(value);
}

}  // namespace sinew::robot
