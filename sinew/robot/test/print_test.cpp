#include "sinew/robot/print.h"

#include <cmath>
#include <sstream>

#include "gen3.h"

namespace sinew::robot::test {
namespace {

// The published print program's state: every joint at 0.2 rad and at rest.
TEST(Print, PrintsTheReferenceTorques) {
  Gen3 gen3;
  std::vector<std::string> lines;
  PrintOptions options;
  options.measurements = {{"position", 0.2}};
  options.print = [&](const std::string& line) { lines.push_back(line); };
  const auto robot = std::make_shared<Print>(options);
  const auto host = gen3.host("gravity", "print", robot, {.cycles = 20});
  host->configure();
  host->start();
  host->wait();
  ASSERT_GE(lines.size(), 1u);
  constexpr double kReference[] = {0,
                                   -6.1049793161502901,
                                   0.12976516944306268,
                                   -2.9211559500853213,
                                   0.0034301511793215778,
                                   -0.53648150477306344,
                                   -0.028939511370873069};
  std::istringstream words(lines[0]);
  for (int i = 0; i < 7; ++i) {
    std::string name;
    double value = 0;
    ASSERT_TRUE(words >> name >> value) << lines[0];
    EXPECT_EQ(name, "gravity-force.joint" + std::to_string(i + 1));
    EXPECT_NEAR(value, kReference[i], 1e-12);
  }
  EXPECT_EQ(lines.size(), 2u) << "the same commands once, and then the safe ones";
}

TEST(Print, RefusesAMeasurementThatNobodyStated) {
  Gen3 gen3;
  PrintOptions options;
  options.measurements = {{"position.joint1", 0.2}};
  options.print = [](const std::string&) {};
  const auto robot = std::make_shared<Print>(options);
  EXPECT_THROW(gen3.host("gravity", "print", robot), Error);
}

}  // namespace
}  // namespace sinew::robot::test
