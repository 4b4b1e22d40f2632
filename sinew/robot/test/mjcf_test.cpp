// The simulated robot is the robot of the models: MuJoCo's own inverse dynamics on it are the
// reference torques.
#include "sinew/robot/mjcf.h"

#include <mujoco/mujoco.h>

#include <cstring>

#include "gen3.h"

namespace sinew::robot::test {
namespace {

struct Case {
  double q[7], qd[7], qdd[7], tau[7];
};

// Kinova Gen3, model data as published; torques from an independent recursion in world coordinates.
constexpr Case kCases[] = {
    {{0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2},
     {},
     {},
     {0, -6.1049793161502901, 0.12976516944306268, -2.9211559500853213, 0.0034301511793215778,
      -0.53648150477306344, -0.028939511370873069}},
    {{0.1, -0.2, 0.3, -0.4, 0.5, -0.6, 0.7},
     {0.5, -0.4, 0.3, -0.2, 0.1, 0.6, -0.7},
     {1.0, -0.8, 0.6, -0.4, 0.2, -0.1, 0.3},
     {0.46434100798012889, 6.3705599437082894, 0.35838220573390211, 3.6857467015278571,
      0.19265444740403875, 0.71176434790767917, 0.022454598886598294}},
    {{-1.2, 0.9, 2.1, -1.7, 0.4, 1.3, -2.5},
     {-1.1, 0.7, 1.9, -0.8, 2.3, -1.5, 0.6},
     {3, -2, 1.5, 4, -3.5, 2.5, -1},
     {3.0133260052072419, -15.886049933834908, -4.2372906751665136, 4.6157372357251107,
      0.17807489860605621, 0.98543655048281154, -0.053042364925385006}},
};

class Loaded {
 public:
  explicit Loaded(const std::string& xml) {
    mjVFS files;
    mj_defaultVFS(&files);
    mj_makeEmptyFileVFS(&files, "robot.xml", static_cast<int>(xml.size()));
    std::memcpy(files.filedata[0], xml.data(), xml.size());
    char fault[1000] = "";
    model = mj_loadXML("robot.xml", &files, fault, sizeof fault);
    mj_deleteVFS(&files);
    if (model == nullptr) throw std::runtime_error(fault);
    data = mj_makeData(model);
  }
  ~Loaded() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  mjModel* model;
  mjData* data;
};

TEST(Mjcf, HasTheDynamicsOfTheModels) {
  const Gen3 gen3;
  const Loaded robot(mjcf(gen3.tree, gen3.store.terms(), {}, 0.001));
  ASSERT_EQ(robot.model->nv, 7);
  for (const Case& state : kCases) {
    for (int i = 0; i < 7; ++i) {
      robot.data->qpos[i] = state.q[i];
      robot.data->qvel[i] = state.qd[i];
      robot.data->qacc[i] = state.qdd[i];
    }
    mj_inverse(robot.model, robot.data);
    // MuJoCo finds principal axes of inertia to about eight digits.
    for (int i = 0; i < 7; ++i)
      EXPECT_NEAR(robot.data->qfrc_inverse[i], state.tau[i], 2e-7) << "joint " << i + 1;
  }
}

TEST(Mjcf, KeepsTheLimitsOfTheJoints) {
  const Gen3 gen3;
  const Loaded robot(mjcf(gen3.tree, gen3.store.terms(), {}, 0.001));
  EXPECT_EQ(robot.model->jnt_limited[0], 0) << "joint 1 turns on and on";
  ASSERT_EQ(robot.model->jnt_limited[1], 1);
  EXPECT_NEAR(robot.model->jnt_range[2], -2.24, 1e-12);
  EXPECT_NEAR(robot.model->jnt_range[3], 2.24, 1e-12);
}

TEST(Mjcf, NamesAFrameThatTheModelDoesNotHave) {
  const Gen3 gen3;
  Scene scene;
  scene.tool = Tool{"no-such-frame", 0.1};
  try {
    mjcf(gen3.tree, gen3.store.terms(), scene, 0.001);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no-such-frame"), std::string::npos);
  }
}

}  // namespace
}  // namespace sinew::robot::test
