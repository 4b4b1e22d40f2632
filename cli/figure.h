// A figure of curves over time: panels one above the other that share the time axis, and shaded
// phases behind them. Written as SVG, by hand: a few hundred numbers need no plotting library.
#pragma once

#include <string>
#include <vector>

namespace sinew::cli {

struct Curve {
  std::string name;
  std::vector<double> values;  // one for each time; what is not finite leaves a gap
};

struct Panel {
  std::string label;  // of its vertical axis, with the unit: "velocity [m/s]"
  std::vector<Curve> curves;
};

// From one time to another; the last phase ends with the figure.
struct Phase {
  double from = 0;
  std::string name;
};

struct Figure {
  std::string title;
  std::vector<double> times;  // [s], growing
  std::vector<Panel> panels;
  std::vector<Phase> phases;
};

// Curves are thinned to what can be seen: the least and the greatest value of every pixel.
std::string to_svg(const Figure& figure);

}  // namespace sinew::cli
