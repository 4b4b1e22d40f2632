// Qualitative relations of bodies - on, above, in, near, left of, between, reachable - grounded in
// numbers by declared rules. A rule is data: conditions on quantities that are measured between the
// shapes, within bounds in SI units, along axes that the rule names. What is true is explained by
// the numbers that made it so.
//
//   Relations relations(space);                       // usual_rules(), or one's own
//   relations.judge({.relation = "on", .first = cup, .second = table}).holds
//   explain(judgement)    "cup on table: true; height-gap 0.001 m within -0.005 .. 0.02; …"
//   relations.find({.relation = "on", .second = table})          every body that is
//
// Answers are as of the space's last update.
#pragma once

#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/world/space.h"

namespace sinew::world {

// Along which axes a rule measures: x to the front, y to the left, z up.
enum class Axes : std::uint8_t {
  kSpace,   // of the space's frame
  kSecond,  // of the second body's frame: a car's own left
  kViewer,  // of the frame that the question names: left as somebody sees it
};
std::string_view to_string(Axes axes);

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct Condition {
  std::string quantity;                                // of quantities()
  double minimum = -kUnbounded, maximum = kUnbounded;  // both included, in the quantity's unit
  std::string maximum_of = {};  // the maximum is this property of the second body (`declare`)
};

struct Rule {
  std::string name;
  Axes axes = Axes::kSpace;
  std::vector<Condition> conditions;  // all must hold
  bool ternary = false;               // asks for a third body
};

// The rules for things of the size of a workbench. Thresholds are a choice, not a truth: exchange
// what does not fit.
std::vector<Rule> usual_rules();

// Throws Error naming the rule where it has no condition, a quantity is none of quantities() or is
// of three bodies in a rule for two, or bounds are not in order.
void check_rule(const Rule& rule);

struct QuantityDescription {
  std::string_view name, unit, meaning;
  bool ternary = false;
};
std::span<const QuantityDescription> quantities();

struct Question {
  std::string_view relation;
  BodyId first = {}, second = {}, third = {};
  FrameId viewer = {};  // of Axes::kViewer
};

struct ConditionFinding {  // one condition and what was measured
  std::string_view quantity, unit;
  double value = 0, minimum = 0, maximum = 0;
  bool holds = false;
};

struct Judgement {
  Status status = Status::kNoData;  // kOk, or why a body or the viewer has no place
  bool holds = false;
  std::string relation, first, second, third;  // IRIs
  std::string axes;                            // IRI of the frame whose axes were used
  std::vector<ConditionFinding> findings;
};
// In one line; numbers with six digits.
std::string explain(const Judgement& judgement);

class Relations {
 public:
  // Throws Error as `check_rule`, and where a name is there twice. The space must outlive this.
  explicit Relations(const Space& space, std::vector<Rule> rules = usual_rules());

  // A number that rules use: the reach of a robot.
  void declare(BodyId body, std::string_view property, double value);
  bool declares(BodyId body, std::string_view property) const {
    return declared_.contains({body, std::string(property)});
  }

  // Throws Error for a relation without a rule, a body too few, or a property not declared.
  Judgement judge(const Question& question) const;
  // The judgements that hold, for every body in the place of `first`. What cannot be judged, as it
  // has no pose, is in `unplaced`.
  struct Found {
    std::vector<std::pair<BodyId, Judgement>> bodies;
    std::vector<BodyId> unplaced;
  };
  Found find(Question question) const;
  const std::vector<Rule>& rules() const { return rules_; }
  // The rule of a relation; throws Error where there is none.
  const Rule& rule(std::string_view name) const;

 private:
  double maximum(const Condition& condition, BodyId second) const;

  const Space* space_;
  std::vector<Rule> rules_;
  std::map<std::pair<BodyId, std::string>, double> declared_;
};

}  // namespace sinew::world
