#include "figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sinew::cli {
namespace {

constexpr double kWidth = 860, kLeft = 84, kRight = 20, kTop = 46, kBottom = 48;
constexpr double kPanelHeight = 150, kGap = 18;
constexpr double kPlotWidth = kWidth - kLeft - kRight;
constexpr int kPixels = static_cast<int>(kPlotWidth);

constexpr std::array<const char*, 7> kColours = {"#1f4e9c", "#c8501e", "#2a7d4f", "#7a3b8f",
                                                 "#9a7b00", "#00788c", "#7f7f7f"};
constexpr std::array<const char*, 7> kShades = {"#eef2f9", "#fbe9df", "#f6f0d8", "#e3f2e6",
                                                "#f1e6f4", "#e1f1f4", "#efefef"};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // Never empty, with a little air.
  Range widened() const {
    if (low > high) return {-1, 1};
    const double air = high > low ? 0.06 * (high - low) : std::max(1e-3, 0.1 * std::abs(low));
    return {low - air, high + air};
  }
};

// 1, 2 or 5 times a power of ten, so that about `wanted` of them fit.
double tick_step(const Range& range, double wanted) {
  const double raw = (range.high - range.low) / wanted;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw) return factor * power;
  return 10 * power;
}

std::string tick_label(double value, double step) {
  if (std::abs(value) < step * 1e-6) value = 0;
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  return std::abs(value) >= 1e6 ? fmt::format("{:g}", value)
                                : fmt::format("{:.{}f}", value, digits);
}

class Painter {
 public:
  explicit Painter(const Figure& figure) : figure_(figure) {
    for (const double time : figure.times) time_.add(time);
    if (!(time_.high > time_.low)) time_ = {0, 1};
  }

  std::string paint() {
    const double height = kTop + kBottom + panels_height();
    svg_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
        "height=\"{1}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        "<text x=\"{2}\" y=\"18\" font-size=\"14\">{3}</text>\n",
        kWidth, height, kLeft, escaped(figure_.title));
    paint_phases();
    for (std::size_t i = 0; i < figure_.panels.size(); ++i) paint_panel(i);
    paint_time_axis(kTop + panels_height());
    return svg_ + "</svg>\n";
  }

 private:
  double panels_height() const {
    const auto count = static_cast<double>(figure_.panels.size());
    return count * kPanelHeight + std::max(0.0, count - 1) * kGap;
  }
  double x(double time) const {
    return kLeft + (time - time_.low) / (time_.high - time_.low) * kPlotWidth;
  }

  void paint_phases() {
    for (std::size_t i = 0; i < figure_.phases.size(); ++i) {
      const double from = std::max(figure_.phases[i].from, time_.low);
      const double to = i + 1 < figure_.phases.size() ? figure_.phases[i + 1].from : time_.high;
      if (!(to > from)) continue;
      svg_ += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\" fill=\"{}\"/>\n"
          "<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\" fill=\"#555\">{}</text>\n",
          x(from), kTop, x(to) - x(from), panels_height(), kShades[i % kShades.size()],
          (x(from) + x(to)) / 2, kTop - 8, escaped(figure_.phases[i].name));
    }
  }

  void paint_panel(std::size_t index) {
    const Panel& panel = figure_.panels[index];
    const double top = kTop + static_cast<double>(index) * (kPanelHeight + kGap);
    Range values;
    for (const Curve& curve : panel.curves)
      for (const double value : curve.values) values.add(value);
    values = values.widened();
    const auto y = [&](double value) {
      return top + (values.high - value) / (values.high - values.low) * kPanelHeight;
    };
    const double step = tick_step(values, 4);
    for (double at = std::ceil(values.low / step) * step; at <= values.high; at += step)
      svg_ += fmt::format(
          "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#ccc\" "
          "stroke-width=\"0.6\"/><text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
          kLeft, kLeft + kPlotWidth, y(at), kLeft - 6, y(at) + 4, tick_label(at, step));
    svg_ += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n"
        "<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        kLeft, top, kPlotWidth, kPanelHeight, top + kPanelHeight / 2, escaped(panel.label));
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
      const char* colour = kColours[i % kColours.size()];
      paint_curve(panel.curves[i], y, colour);
      if (panel.curves.size() > 1)
        svg_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"{}\">{}</text>\n",
                            kLeft + kPlotWidth - 6, top + 15 + 14 * static_cast<double>(i), colour,
                            escaped(panel.curves[i].name));
    }
  }

  template <typename Vertical>
  void paint_curve(const Curve& curve, const Vertical& y, const char* colour) {
    std::string points;
    const auto end_line = [&] {
      if (!points.empty())
        svg_ += fmt::format(
            "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.3\" points=\"{}\"/>\n", colour,
            points);
      points.clear();
    };
    const auto draw = [&](double time, double value) {
      points += fmt::format("{:.1f},{:.2f} ", x(time), y(value));
    };
    std::size_t at = 0;
    while (at < curve.values.size()) {
      if (!std::isfinite(curve.values[at])) {
        end_line();
        ++at;
        continue;
      }
      const int pixel = pixel_of(at);
      std::size_t low = at, high = at;
      for (; at < curve.values.size() && pixel_of(at) == pixel && std::isfinite(curve.values[at]);
           ++at) {
        if (curve.values[at] < curve.values[low]) low = at;
        if (curve.values[at] > curve.values[high]) high = at;
      }
      draw(figure_.times[std::min(low, high)], curve.values[std::min(low, high)]);
      if (low != high) draw(figure_.times[std::max(low, high)], curve.values[std::max(low, high)]);
    }
    end_line();
  }
  int pixel_of(std::size_t at) const {
    return static_cast<int>((figure_.times[at] - time_.low) / (time_.high - time_.low) * kPixels);
  }

  void paint_time_axis(double y) {
    const double step = tick_step(time_, 8);
    for (double at = std::ceil(time_.low / step) * step; at <= time_.high; at += step)
      svg_ += fmt::format(
          "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#888\"/>"
          "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>\n",
          x(at), y, y + 4, y + 18, tick_label(at, step));
    svg_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">time [s]</text>\n",
                        kLeft + kPlotWidth / 2, y + 38);
  }

  const Figure& figure_;
  Range time_;
  std::string svg_;
};

}  // namespace

std::string to_svg(const Figure& figure) { return Painter(figure).paint(); }

}  // namespace sinew::cli
