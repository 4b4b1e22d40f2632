/* Evaluates the generated forward position kinematics and inverse dynamics of the Kinova Gen3 in
 * three states and prints them beside reference values: an independent Newton-Euler recursion in
 * world coordinates over the published model, which agrees with Orocos KDL to 3e-15 N m. Gravity
 * is 9.81 m/s^2 downwards. SI units. */
#include <math.h>
#include <stdio.h>

#include "gen3_fpk.h"
#include "gen3_rnea.h"

enum { JOINTS = 7, STATES = 3, POSE = 12 };

/* Position, velocity, acceleration: the order in which the generated code takes them. */
static const double states[STATES][3 * JOINTS] = {
    {0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {0.1, -0.2, 0.3,  -0.4, 0.5,  -0.6, 0.7,  0.5, -0.4, 0.3, -0.2,
     0.1, 0.6,  -0.7, 1.0,  -0.8, 0.6,  -0.4, 0.2, -0.1, 0.3},
    {-1.2, 0.9,  2.1, -1.7, 0.4,  1.3, -2.5, -1.1, 0.7, 1.9, -0.8,
     2.3,  -1.5, 0.6, 3.0,  -2.0, 1.5, 4.0,  -3.5, 2.5, -1.0},
};

static const double reference_torques[STATES][JOINTS] = {
    {0, -6.1049793161502901, 0.12976516944306268, -2.9211559500853213, 0.0034301511793215778,
     -0.53648150477306344, -0.028939511370873069},
    {0.46434100798012889, 6.3705599437082894, 0.35838220573390211, 3.6857467015278571,
     0.19265444740403875, 0.71176434790767917, 0.022454598886598294},
    {3.0133260052072419, -15.886049933834908, -4.2372906751665136, 4.6157372357251107,
     0.17807489860605621, 0.98543655048281154, -0.053042364925385006},
};

/* Pose of link7-root with respect to link0-root: the columns x, y, z of the rotation, then the
 * position. */
static const double reference_poses[STATES][POSE] = {
    {0.54166277298414922, -0.66667893959172142, -0.51199671079801035, -0.66667893959172153,
     -0.71170036905359524, 0.221408618156194, -0.51199671079801035, 0.221408618156194,
     -0.82996240393055409, 0.24516925065538719, -0.099651982404516476, 1.0753469939654274},
    {-0.37846568940210579, -0.81252124216447075, 0.44336548464770492, -0.59389794253951644,
     -0.15423524349050421, -0.78961808712361325, 0.70996405246513583, -0.56215720283291759,
     -0.42418194623339617, -0.33209390146355749, 0.097511908787567103, 1.0018704061934924},
    {-0.12816162606577713, 0.62064843740520992, -0.77354386737317449, 0.95379913531412641,
     0.29084726920179649, 0.075333096789408527, 0.2717384902405261, -0.728150659646978,
     -0.62924940188884593, -0.13366167146415336, 0.53508624937261207, 0.47323649176080335},
};

int main(void) {
  double worst_torque = 0, worst_pose = 0;
  if (gen3_rnea_IN_SIZE != 3 * JOINTS || gen3_rnea_OUT_SIZE != JOINTS ||
      gen3_fpk_IN_SIZE != JOINTS || gen3_fpk_OUT_SIZE != POSE) {
    fprintf(stderr, "the generated functions have other inputs and outputs than expected\n");
    return 1;
  }
  for (int s = 0; s < STATES; ++s) {
    double torque[JOINTS], pose[POSE];
    gen3_rnea(states[s], torque);
    gen3_fpk(states[s], pose);

    printf("\nstate %d        torque [N m]            reference\n", s + 1);
    for (int j = 0; j < JOINTS; ++j) {
      printf("  joint%d  %22.15f %22.15f\n", j + 1, torque[j], reference_torques[s][j]);
      worst_torque = fmax(worst_torque, fabs(torque[j] - reference_torques[s][j]));
    }
    printf("  end effector at (%.9f, %.9f, %.9f) m\n", pose[3], pose[7], pose[11]);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        const double expected = reference_poses[s][3 * column + row];
        worst_pose = fmax(worst_pose, fabs(pose[4 * row + column] - expected));
      }
    }
  }
  printf("\nlargest error: torque %.1e N m, pose %.1e\n", worst_torque, worst_pose);
  return !(worst_torque < 1e-12 && worst_pose < 1e-12);
}
