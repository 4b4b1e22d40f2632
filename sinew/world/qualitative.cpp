#include "sinew/world/qualitative.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "sinew/world/quantities.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

std::optional<std::size_t> quantity_index(std::string_view name) {
  const auto all = quantities();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const QuantityDescription& row) { return row.name == name; });
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(found - all.begin());
}

}  // namespace

void check_rule(const Rule& rule) {
  if (rule.conditions.empty()) refuse(rule.name, "has no condition", "at least one");
  for (const Condition& condition : rule.conditions) {
    const auto index = quantity_index(condition.quantity);
    if (!index) {
      std::string names;
      for (const auto& row : quantities())
        names += (names.empty() ? "" : ", ") + std::string(row.name);
      refuse(rule.name, "there is no quantity '" + condition.quantity + "'", names);
    }
    if (quantities()[*index].ternary && !rule.ternary) {
      refuse(rule.name, "'" + condition.quantity + "' is measured between three bodies",
             "a ternary rule");
    }
    if (!(condition.minimum <= condition.maximum)) {
      refuse(rule.name, "the bounds of '" + condition.quantity + "' are not in order",
             "a minimum that is not above the maximum");
    }
    if (!condition.maximum_of.empty() && condition.maximum != kUnbounded) {
      refuse(rule.name, "the maximum of '" + condition.quantity + "' is stated twice",
             "a number, or the property that it is");
    }
  }
}

namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

std::string_view to_string(Axes axes) {
  constexpr std::string_view kNames[] = {"space", "second", "viewer"};
  return kNames[static_cast<std::size_t>(axes)];
}

std::vector<Rule> usual_rules() {
  constexpr double kQuarter = std::numbers::pi / 4;
  return {
      {"on", Axes::kSpace, {{"height-gap", -0.005, 0.02}, {"covered-share", 0.3, 1}}},
      {"above", Axes::kSpace, {{"height-gap", 0.02}, {"covered-share", 0.1, 1}}},
      {"in", Axes::kSpace, {{"protrusion", -kUnbounded, 0.005}}},
      {"near", Axes::kSpace, {{"distance", 0, 0.3}}},
      // Nothing is at the side of what it is in, on or under: their bounds do not overlap.
      {"in-front-of", Axes::kSecond, {{"bearing-size", 0, kQuarter}, {"side-gap", -0.005, 2}}},
      {"behind", Axes::kSecond, {{"bearing-size", 3 * kQuarter}, {"side-gap", -0.005, 2}}},
      {"left-of", Axes::kSecond, {{"bearing", kQuarter, 3 * kQuarter}, {"side-gap", -0.005, 2}}},
      {"right-of", Axes::kSecond, {{"bearing", -3 * kQuarter, -kQuarter}, {"side-gap", -0.005, 2}}},
      // For a viewer who looks along x, what is in front of a thing is on the near side of it.
      {"in-front-of-as-seen",
       Axes::kViewer,
       {{"bearing-size", 3 * kQuarter}, {"side-gap", -0.005, 2}}},
      {"left-of-as-seen",
       Axes::kViewer,
       {{"bearing", kQuarter, 3 * kQuarter}, {"side-gap", -0.005, 2}}},
      {"right-of-as-seen",
       Axes::kViewer,
       {{"bearing", -3 * kQuarter, -kQuarter}, {"side-gap", -0.005, 2}}},
      {"between", Axes::kSpace, {{"share-of-way", 0.1, 0.9}, {"off-the-way", 0, 0.3}}, true},
      // By distance alone: no joint limit and no obstacle is looked at.
      {"reachable", Axes::kSpace, {{"distance-from-origin", 0, kUnbounded, "reach"}}},
  };
}

Relations::Relations(const Space& space, std::vector<Rule> rules)
    : space_(&space), rules_(std::move(rules)) {
  for (auto rule = rules_.begin(); rule != rules_.end(); ++rule) {
    check_rule(*rule);
    if (std::any_of(rules_.begin(), rule,
                    [&](const Rule& other) { return other.name == rule->name; })) {
      refuse(rule->name, "has two rules", "one rule for each relation");
    }
  }
}

const Rule& Relations::rule(std::string_view name) const {
  for (const Rule& rule : rules_) {
    if (rule.name == name) return rule;
  }
  std::string names;
  for (const Rule& rule : rules_) names += (names.empty() ? "" : ", ") + rule.name;
  refuse(name, "is no relation that a rule is declared for", names);
}

void Relations::declare(BodyId body, std::string_view property, double value) {
  if (!std::isfinite(value)) {
    refuse(space_->name(body), "the declared " + std::string(property) + " is not finite",
           "a number in SI units");
  }
  space_->shapes(body);  // Error where it is no body of the space
  declared_[{body, std::string(property)}] = value;
}

double Relations::maximum(const Condition& condition, BodyId second) const {
  if (condition.maximum_of.empty()) return condition.maximum;
  const auto found = declared_.find({second, condition.maximum_of});
  if (found == declared_.end()) {
    refuse(space_->name(second), "has no declared '" + condition.maximum_of + "'",
           "declare it, in SI units");
  }
  return found->second;
}

Judgement Relations::judge(const Question& question) const {
  const Rule& rule = this->rule(question.relation);
  if (!question.second || (rule.ternary && !question.third)) {
    refuse(rule.name, "is asked with a body too few",
           rule.ternary ? "first, second and third" : "first and second");
  }
  const Space& space = *space_;
  Judgement result{.status = Status::kOk,
                   .holds = true,
                   .relation = rule.name,
                   .first = space.name(question.first),
                   .second = space.name(question.second),
                   .third = rule.ternary ? space.name(question.third) : "",
                   .axes = {},
                   .findings = {}};

  const auto fail = [&result](Status status) {
    result.status = status;
    result.holds = false;
    return result;
  };
  for (const BodyId body : {question.first, question.second, question.third}) {
    if (!body || (body == question.third && !rule.ternary)) continue;
    if (!space.is_placed(body)) return fail(space.status(body));
  }

  // Only the axes' directions matter: every quantity is one of differences.
  Quaternion axes;
  FrameId axes_frame = space.frame();
  if (rule.axes == Axes::kSecond) {
    axes = space.pose(question.second).pose.q;
    axes_frame = space.frame_of(question.second);
  } else if (rule.axes == Axes::kViewer) {
    if (!question.viewer) {
      refuse(rule.name, "is asked without a viewer", "the frame of whoever looks, x to the front");
    }
    const PoseAnswer viewer = space.pose_of(question.viewer);
    if (!viewer) return fail(viewer.status);
    axes = viewer.pose.q;
    axes_frame = question.viewer;
  }
  result.axes = space.world().name(axes_frame);
  const Pose X_axes_space = {conjugate(axes), {}};

  const Seen first = see(X_axes_space, space, question.first);
  const Seen second = see(X_axes_space, space, question.second);
  std::optional<Seen> third;
  if (rule.ternary) third = see(X_axes_space, space, question.third);
  for (const Condition& condition : rule.conditions) {
    const std::size_t index = *quantity_index(condition.quantity);
    const QuantityDescription& row = quantities()[index];
    ConditionFinding finding{.quantity = row.name,
                             .unit = row.unit,
                             .value = measure(index, first, second, third ? &*third : nullptr),
                             .minimum = condition.minimum,
                             .maximum = maximum(condition, question.second)};
    finding.holds = finding.value >= finding.minimum && finding.value <= finding.maximum;
    result.holds = result.holds && finding.holds;
    result.findings.push_back(finding);
  }
  return result;
}

Relations::Found Relations::find(Question question) const {
  Found found;
  for (const BodyId body : space_->bodies()) {
    if (body == question.second || body == question.third) continue;
    question.first = body;
    Judgement judgement = judge(question);
    if (judgement.holds) {
      found.bodies.emplace_back(body, std::move(judgement));
    } else if (!space_->is_placed(body)) {
      found.unplaced.push_back(body);
    }
  }
  return found;
}

std::string explain(const Judgement& judgement) {
  std::string text = judgement.first + " " + judgement.relation + " " + judgement.second;
  if (!judgement.third.empty()) text += " and " + judgement.third;
  if (judgement.status != Status::kOk) {
    return text + ": not known, " + std::string(to_string(judgement.status));
  }
  text += judgement.holds ? ": true" : ": false";
  text += ", along the axes of " + judgement.axes;
  for (const ConditionFinding& finding : judgement.findings) {
    text += "; " + std::string(finding.quantity) + " " + number(finding.value) + " " +
            std::string(finding.unit) + (finding.holds ? " is within " : " is not within ") +
            number(finding.minimum) + " .. " + number(finding.maximum);
  }
  return text;
}

}  // namespace sinew::world
