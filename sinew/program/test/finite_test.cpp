#include "sinew/program/finite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refusal.h"
#include "sinew/base/error.h"

namespace sinew::program {
namespace {

using testing::HasSubstr;

Program one_closure() {
  Program program;
  program.iri = "https://example.org/program";
  program.closures = {{"joint-acceleration-from-force", "", "", "https://example.org/joint", {}}};
  return program;
}

std::string error_of(const Computation& computation, const Program& program) {
  return refusal([&] { require_finite(computation, program); });
}

TEST(Finite, NamesWhatDividesByAConstantZero) {
  Computation computation;
  computation.inputs = 1;
  Dag& dag = computation.dag;
  dag.set_origin(0);
  const Ref product = dag.multiply(dag.input(0), dag.divide(dag.constant(1), dag.constant(0)));
  dag.set_origin(kNoOrigin);
  computation.results = {dag.add(product, dag.constant(1))};
  const std::string error = error_of(computation, one_closure());
  EXPECT_THAT(error, HasSubstr("https://example.org/joint: its 'joint-acceleration-from-force' "
                               "divides by zero"));
}

TEST(Finite, SeesResultsThatAreNoNumbers) {
  Computation computation;
  Dag& dag = computation.dag;
  computation.results = {dag.sqrt(dag.constant(-1))};
  EXPECT_THAT(error_of(computation, one_closure()), HasSubstr("https://example.org/program"));
}

TEST(Finite, MindsOnlyWhatIsUsed) {
  Computation computation;
  computation.inputs = 1;
  Dag& dag = computation.dag;
  const Ref infinite = dag.multiply(dag.input(0), dag.divide(dag.constant(1), dag.constant(0)));
  const Ref other = dag.multiply(dag.input(0), dag.constant(2));
  computation.results = {dag.select(dag.less(dag.constant(1), dag.constant(0)), infinite, other)};
  EXPECT_EQ(error_of(computation, one_closure()), "none");
}

}  // namespace
}  // namespace sinew::program
