#include "sinew/program/validate.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "sinew/program/dead_closures.h"
#include "sinew/program/interface.h"

namespace sinew::program {
namespace {

Variable variable(const std::string& name, Role role, std::uint32_t size, bool output = false) {
  Variable v;
  v.name = name;
  v.iri = "https://example.org/" + name;
  v.role = role;
  v.size = size;
  v.output = output;
  if (role == Role::kConstant || role == Role::kState) v.value.assign(size, 1.0);
  return v;
}

// c = a + b, d = c + b, all wrenches; d is wanted.
Program sums() {
  Program p;
  p.name = "sums";
  p.iri = "https://example.org/sums";
  p.variables = {variable("a", Role::kInput, 6), variable("b", Role::kConstant, 6),
                 variable("c", Role::kInternal, 6), variable("d", Role::kInternal, 6, true)};
  p.closures = {{"accumulate-wrench", "https://example.org/first", "", "", {0, 1, 2}},
                {"accumulate-wrench", "https://example.org/second", "", "", {2, 1, 3}}};
  p.schedule = {0, 1};
  return p;
}

TEST(Validate, AcceptsASoundProgram) {
  Report report;
  validate(sums(), report);
  EXPECT_TRUE(report.problems().empty());
}

struct Fault {
  const char* name;
  std::function<void(Program&)> make;
  const char* iri;   // that the report names
  const char* what;  // that it says
};

class ValidateFaults : public testing::TestWithParam<Fault> {};

TEST_P(ValidateFaults, AreReportedWithTheNodeAtFault) {
  Program p = sums();
  GetParam().make(p);
  Report report;
  validate(p, report);
  ASSERT_TRUE(report.has_errors());
  const Problem& problem = report.problems().front();
  EXPECT_EQ(problem.iri, GetParam().iri);
  EXPECT_NE(problem.what.find(GetParam().what), std::string::npos) << problem.what;
  EXPECT_FALSE(problem.remedy.empty());
  EXPECT_THROW(require_valid(p), Error);
}

const std::string kFirst = "https://example.org/first";

INSTANTIATE_TEST_SUITE_P(
    All, ValidateFaults,
    testing::Values(
        Fault{"no_name", [](Program& p) { p.variables[0].name.clear(); }, "https://example.org/a",
              "without a name"},
        Fault{"no_size", [](Program& p) { p.variables[0].size = 0; }, "https://example.org/a",
              "holds no numbers"},
        Fault{"same_name", [](Program& p) { p.variables[2].name = "a"; }, "https://example.org/c",
              "second variable is named 'a'"},
        Fault{"values_missing", [](Program& p) { p.variables[1].value.pop_back(); },
              "https://example.org/b", "5 values for 6"},
        Fault{"values_of_an_input", [](Program& p) { p.variables[0].value.assign(6, 0.0); },
              "https://example.org/a", "neither constant nor state"},
        Fault{
            "not_finite",
            [](Program& p) { p.variables[1].value[3] = std::numeric_limits<double>::quiet_NaN(); },
            "https://example.org/b", "not finite"},
        Fault{"unknown_operator", [](Program& p) { p.closures[0].operation = "add-wrenches"; },
              "https://example.org/first", "unknown operator 'add-wrenches'"},
        Fault{"too_few_arguments", [](Program& p) { p.closures[0].arguments.pop_back(); },
              "https://example.org/first", "bound to 2 variables"},
        Fault{"dangling_argument", [](Program& p) { p.closures[0].arguments[1] = 9; },
              "https://example.org/first", "argument 2 of 'accumulate-wrench' is variable 9"},
        Fault{"wrong_size", [](Program& p) { p.variables[0].size = 3; },
              "https://example.org/first", "holds 3 numbers"},
        Fault{"dangling_schedule", [](Program& p) { p.schedule.push_back(7); },
              "https://example.org/sums", "names closure 7"},
        Fault{"scheduled_twice", [](Program& p) { p.schedule.push_back(0); },
              "https://example.org/first", "scheduled twice"},
        Fault{"read_too_early", [](Program& p) { std::swap(p.schedule[0], p.schedule[1]); },
              "https://example.org/second", "before anything has written it"},
        Fault{"writes_an_input", [](Program& p) { p.closures[0].arguments[2] = 0; },
              "https://example.org/first", "which is an input"},
        Fault{"writes_a_constant",
              [](Program& p) {
                p.closures[1].arguments = {0, 2, 1};
              },
              "https://example.org/second", "which is a constant"},
        Fault{"two_writers",
              [](Program& p) {
                p.closures[1].arguments = {0, 1, 2};
              },
              "https://example.org/second", "which <https://example.org/first> has written"},
        Fault{"reads_what_it_writes",
              [](Program& p) {
                p.variables[2].role = Role::kState;
                p.variables[2].value.assign(6, 0.0);
                p.closures[0].arguments = {2, 1, 2};
              },
              "https://example.org/first", "both reads and writes"},
        Fault{"output_unwritten", [](Program& p) { p.schedule.pop_back(); },
              "https://example.org/d", "nothing writes the output 'd'"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Validate, ReportsEveryFaultAtOnce) {
  Program p = sums();
  p.closures[0].operation = "nonsense";
  p.variables[3].name.clear();
  Report report;
  validate(p, report);
  EXPECT_GE(report.problems().size(), 2U);
}

TEST(DeadClosures, AreRemovedWithTheirVariablesButTheInterfaceStays) {
  Program p = sums();
  p.variables.push_back(variable("unused", Role::kInput, 1));
  p.variables.push_back(variable("e", Role::kInternal, 6));
  p.closures.push_back({"accumulate-wrench", "https://example.org/third", "", "", {3, 0, 5}});
  p.schedule.push_back(2);
  const Program live = without_dead_closures(p);
  require_valid(live);
  EXPECT_EQ(live.closures.size(), 2U);
  EXPECT_EQ(live.variables.size(), 5U);
  EXPECT_EQ(interface_of(live).in_size, interface_of(p).in_size);
  EXPECT_EQ(interface_of(live).out_size, interface_of(p).out_size);
}

TEST(Interface, PutsVariablesOneAfterTheOtherInTheirOrder) {
  const Interface interface = interface_of(sums());
  EXPECT_EQ(interface.in_size, 6U);
  EXPECT_EQ(interface.out_size, 6U);
  EXPECT_EQ(interface.state_size, 0U);
  ASSERT_EQ(interface.inputs.size(), 1U);
  EXPECT_EQ(interface.inputs[0].variable, 0U);
}

}  // namespace
}  // namespace sinew::program
