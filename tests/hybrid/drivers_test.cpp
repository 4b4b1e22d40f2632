// Drivers kept apart: what each contributes, and policies that weigh or scale them.
#include <gtest/gtest.h>

#include <random>

#include "hybrid_question.h"
#include "random_urdf.h"
#include "sinew/rdf/sparql/engine.h"

namespace sinew::test {
namespace {

class Drivers : public testing::Test {
 protected:
  Drivers() : file_(urdf()), peer_(nullptr) {
    query_.solver = "hybrid";
    query_.gravity = "0,0,-9.81";
    query_.constraints = {"link6:linear-x,linear-z@base", "link4:angular-y@itself"};
    query_.give = {"external-wrench of link3", "external-wrench of link5"};
  }

  static std::string urdf() {
    RandomRobot options;
    options.joints = 7;
    options.branching = 0.3;
    options.fixed = 0;
    options.seed = 5;
    return random_urdf(options);
  }

  // The joint forces at the limit are 100 in the URDF, where there is one.
  Problem problem(unsigned seed, double size) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<> number(-size, size);
    Problem result;
    result.state = random_state(7, seed);
    result.force.resize(7);
    for (double& force : result.force) force = number(random);
    result.constraints = {{"link6", axis(3), false, number(random)},
                          {"link6", axis(5), false, number(random)},
                          {"link4", axis(1), true, number(random)}};
    for (const char* link : {"link3", "link5"}) {
      DenseWrench wrench{link, peers::Vector(6)};
      for (double& one : wrench.wrench) one = number(random);
      result.wrenches.push_back(wrench);
    }
    return result;
  }

  TemporaryRobot file_;
  std::unique_ptr<peers::Peer> peer_;
  cli::QueryOptions query_;
};

// gravity, velocity, two wrenches, seven joint forces, two constraints
constexpr Eigen::Index kDrivers = 13;

TEST_F(Drivers, ApartSumToWhatTheyDoTogether) {
  Question together(file_.robot(), query_);
  cli::QueryOptions query = query_;
  query.drivers = "apart";
  Question apart(file_.robot(), query);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Problem one = problem(seed, 5);
    const auto expected = answers(together, one), found = answers(apart, one);
    const VectorXd acceleration = outputs(together, expected, "acceleration");
    EXPECT_LT((outputs(apart, found, "acceleration") - acceleration).norm(),
              1e-9 * (1 + acceleration.norm()));
    const VectorXd effects = outputs(apart, found, "driver-acceleration");
    ASSERT_EQ(effects.size(), kDrivers * 7);
    const VectorXd sum = Eigen::Map<const MatrixXd>(effects.data(), 7, kDrivers).rowwise().sum();
    EXPECT_LT((sum - acceleration).norm(), 1e-9 * (1 + acceleration.norm()));
  }
}

// Without any other driver, the acceleration is the one driver's own.
TEST_F(Drivers, EachEffectIsThatOfItsDriverAlone) {
  cli::QueryOptions query = query_;
  query.drivers = "apart";
  Question apart(file_.robot(), query);
  Problem one = problem(3, 5);
  const auto all = answers(apart, one);
  // Only the wrench on link5: neither gravity nor velocity, no other force, no imposed
  // acceleration.
  cli::QueryOptions alone = query_;
  alone.gravity = "0,0,0";
  Question quiet(file_.robot(), alone);
  one.state.velocity.assign(7, 0);
  one.force.assign(7, 0);
  for (DenseConstraint& constraint : one.constraints) constraint.energy = 0;
  one.wrenches.front().wrench.assign(6, 0);
  const VectorXd expected = outputs(quiet, answers(quiet, one), "acceleration");
  ASSERT_GT(expected.norm(), 1e-3);
  VectorXd found(7);
  for (int j = 0; j < 7; ++j)
    found(j) = all.at("driver-acceleration.wrench-link5.joint" + std::to_string(j)).front();
  // The order of joints is depth first, their names are by number.
  VectorXd by_name(7);
  const auto quiet_answers = answers(quiet, one);
  for (int j = 0; j < 7; ++j)
    by_name(j) = quiet_answers.at("acceleration.joint" + std::to_string(j)).front();
  EXPECT_LT((found - by_name).norm(), 1e-9 * (1 + by_name.norm()));
}

TEST_F(Drivers, AreAListWithIndexAndOrigin) {
  cli::QueryOptions query = query_;
  query.drivers = "apart";
  cli::ModelOptions files{{file_.robot().file}, {}, true};
  const auto models = cli::load(files);
  const graph::Id algorithm = cli::algorithm_of(*models, files, query);
  const std::string text =
      "PREFIX sa: <https://w3id.org/sinew/algorithm#> "
      "PREFIX rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> "
      "SELECT ?name ?index ?origin (COUNT(?effect) AS ?effects) WHERE { GRAPH <" +
      std::string(models->store.terms().text(algorithm)) +
      "> { ?algorithm sa:drivers/rdf:rest*/rdf:first ?driver . ?driver a sa:Driver ; sa:name ?name "
      "; "
      "sa:at-index ?index ; sa:origin ?origin ; sa:effect ?effect } } "
      "GROUP BY ?name ?index ?origin ORDER BY ?index";
  const auto rows =
      rdf::sparql::query(models->store.view(), models->store.terms(), text, {}).results.rows;
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(kDrivers));
  const graph::Terms& terms = models->store.terms();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(terms.integer_value(rows[i][1]), static_cast<std::int64_t>(i));
    EXPECT_GE(terms.number(rows[i][3]).value_or(0), 7);  // an effect at each joint, at least
  }
  EXPECT_EQ(terms.text(rows[0][0]), "gravity");
  EXPECT_EQ(terms.text(rows[2][0]), "wrench-link3");
  // A joint force comes from its joint's own node.
  EXPECT_TRUE(terms.text(rows[4][2]).ends_with("joint0")) << terms.text(rows[4][2]);
}

TEST_F(Drivers, AreWeighedByInputs) {
  cli::QueryOptions query = query_;
  query.drivers = "apart";
  Question apart(file_.robot(), query);
  query.drivers = "weighed";
  Question weighed(file_.robot(), query);
  const Problem one = problem(9, 5);
  const VectorXd effects = outputs(apart, answers(apart, one), "driver-acceleration");
  std::vector<double> weights;
  for (const program::Slot& slot : program::interface_of(weighed.program()).inputs) {
    const std::string& name = weighed.program().variables[slot.variable].name;
    if (!name.starts_with("driver-weight.")) continue;
    weights.push_back(0.1 * static_cast<double>(weights.size()) - 0.3);
    weighed.set(name, {weights.back()});
  }
  ASSERT_EQ(weights.size(), static_cast<std::size_t>(kDrivers));
  const VectorXd expected = Eigen::Map<const MatrixXd>(effects.data(), 7, kDrivers) *
                            Eigen::Map<const VectorXd>(weights.data(), kDrivers);
  const VectorXd found = outputs(weighed, answers(weighed, one), "acceleration");
  EXPECT_LT((found - expected).norm(), 1e-9 * (1 + expected.norm()));
}

// Limits of the URDF: 100 for joints that have one.
bool saturates(const Question& question, const std::map<std::string, peers::Vector>& found,
               const std::string& urdf, double more) {
  bool any = false;
  for (const auto& [name, numbers] : found) {
    if (!name.starts_with("control-force.")) continue;
    const std::string joint = "name=\"" + name.substr(14) + "\" type=\"continuous\"";
    if (urdf.find(joint) != std::string::npos) continue;
    any |= std::fabs(numbers.front()) > 100 + more;
  }
  static_cast<void>(question);
  return any;
}

TEST_F(Drivers, OneIsScaledDownUntilNoActuatorSaturates) {
  Question together(file_.robot(), query_);
  cli::QueryOptions query = query_;
  query.limited = "link6";
  Question limited(file_.robot(), query);
  const std::string& urdf = file_.robot().urdf;
  unsigned scaled = 0, untouched = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Problem one = problem(seed, 8);
    const auto found = answers(limited, one);
    const double scale = found.at("driver-scale.constraint-link6").front();
    ASSERT_GE(scale, 0);
    ASSERT_LE(scale, 1);
    // The same as if the setpoints of that constraint alone were smaller.
    Problem smaller = one;
    for (DenseConstraint& constraint : smaller.constraints)
      if (constraint.link == "link6") constraint.energy *= scale;
    const auto expected = answers(together, smaller);
    for (const std::string quantity :
         {"acceleration", "control-force", "constraint-magnitude", "constraint-force"}) {
      const VectorXd a = outputs(limited, found, quantity),
                     b = outputs(together, expected, quantity);
      EXPECT_LT((a - b).norm(), 1e-8 * (1 + b.norm())) << quantity;
    }
    if (scale == 1) {
      EXPECT_FALSE(saturates(limited, found, urdf, 1e-9));
      ++untouched;
    } else if (scale > 0) {
      EXPECT_FALSE(saturates(limited, found, urdf, 1e-6));
      for (DenseConstraint& constraint : smaller.constraints)
        if (constraint.link == "link6") constraint.energy *= 1 + 1e-4;
      EXPECT_TRUE(saturates(together, answers(together, smaller), urdf, 0));
      ++scaled;
    }
  }
  EXPECT_GT(scaled, 10u);
  EXPECT_GT(untouched, 10u);
}

}  // namespace
}  // namespace sinew::test
