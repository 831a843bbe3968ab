#include "client/cli/accuracy_svg.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "client/cli/table.h"

namespace truepose::cli {
namespace {

// In pixels.
constexpr double kLongestSide = 320, kMargin = 60, kGap = 40, kTitle = 70, kScaleWidth = 110;
constexpr int kScaleSteps = 40, kScaleLabels = 5;

struct Colour {
  double r, g, b;
};

// Dark blue to yellow, even in lightness: also told apart on a grey print and by the colour-blind.
constexpr std::array<Colour, 5> kColours = {
    {{0, 32, 81}, {60, 77, 110}, {127, 124, 117}, {187, 175, 113}, {253, 234, 69}}};

std::string ColourAt(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (kColours.size() - 1);
  const auto i = std::min(static_cast<size_t>(at), kColours.size() - 2);
  const double f = at - static_cast<double>(i);
  const Colour &a = kColours[i], &b = kColours[i + 1];
  return absl::StrFormat("#%02x%02x%02x", std::lround(a.r + f * (b.r - a.r)),
                         std::lround(a.g + f * (b.g - a.g)), std::lround(a.b + f * (b.b - a.b)));
}

std::string Text(double x, double y, const std::string& anchor, const std::string& text) {
  return absl::StrFormat("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n", x, y, anchor,
                         absl::StrReplaceAll(text, {{"&", "&amp;"}, {"<", "&lt;"}}));
}

std::string Rectangle(double x, double y, double width, double height, const std::string& fill) {
  return absl::StrFormat(
      "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", x, y, width,
      height, fill);
}

class Picture {
 public:
  explicit Picture(const v1::AccuracyMap& map)
      : map_(map), spec_(map.spec()), box_(map.spec().box()) {
    const double longest = std::max({WidthM(), HeightM(), 1e-9});
    width_ = std::max(kLongestSide * WidthM() / longest, 40.0);
    height_ = std::max(kLongestSide * HeightM() / longest, 40.0);
  }

  std::string Svg(const std::string& title) const {
    const double width = 2 * kMargin + spec_.points_z() * (width_ + kGap) + kScaleWidth;
    const double height = kTitle + height_ + 2 * kMargin;
    std::string svg = absl::StrFormat(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
        "viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\" font-size=\"12\">\n",
        width, height, width, height);
    absl::StrAppend(&svg, Rectangle(0, 0, width, height, "#ffffff"),
                    Text(kMargin, 24, "start", title), Text(kMargin, 44, "start", Summary()));
    for (int slice = 0; slice < spec_.points_z(); ++slice) absl::StrAppend(&svg, Slice(slice));
    return absl::StrCat(svg, Scale(width - kScaleWidth), "</svg>\n");
  }

 private:
  double WidthM() const { return box_.max_x_m() - box_.min_x_m(); }
  double HeightM() const { return box_.max_y_m() - box_.min_y_m(); }

  std::string Summary() const {
    return absl::StrCat("95 % of position errors below: ", Fixed(map_.position_95_mm(), 3),
                        " mm over all places, ", Fixed(map_.best_95_mm(), 3), " to ",
                        Fixed(map_.worst_95_mm(), 3), " mm");
  }

  // A map that is the same everywhere is all of the scale's lower end.
  double ShareOf(double value_mm) const {
    const double range = map_.worst_95_mm() - map_.best_95_mm();
    return range > 0 ? (value_mm - map_.best_95_mm()) / range : 0;
  }

  double LeftOf(int slice) const { return kMargin + slice * (width_ + kGap); }
  static double Top() { return kTitle + 20; }

  // x to the right, y upwards.
  std::string Place(const v1::AccuracyMapPoint& point, int slice, int i, int j) const {
    const double w = width_ / spec_.points_x(), h = height_ / spec_.points_y();
    const double x = LeftOf(slice) + i * w, y = Top() + height_ - (j + 1) * h;
    if (point.reached())
      return Rectangle(x, y, w + 0.3, h + 0.3, ColourAt(ShareOf(point.position_95_mm())));
    return absl::StrFormat(
        "<path d=\"M%.1f %.1fl%.1f %.1fm0 %.1fl%.1f %.1f\" stroke=\"#bbbbbb\" fill=\"none\"/>\n", x,
        y, w, h, -h, -w, h);
  }

  std::string Slice(int slice) const {
    const int nx = spec_.points_x(), ny = spec_.points_y();
    std::string svg;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        absl::StrAppend(&svg, Place(map_.points((slice * ny + j) * nx + i), slice, i, j));
    absl::StrAppend(
        &svg,
        absl::StrFormat("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
                        "stroke=\"#333333\"/>\n",
                        LeftOf(slice), Top(), width_, height_));
    return svg + Labels(slice);
  }

  std::string Labels(int slice) const {
    const double left = LeftOf(slice), bottom = Top() + height_;
    const double z = map_.points(slice * spec_.points_x() * spec_.points_y()).z_m();
    std::string svg = absl::StrCat(
        Text(left + width_ / 2, Top() - 8, "middle", absl::StrCat("z ", Fixed(z, 3), " m")),
        Text(left, bottom + 16, "start", Fixed(box_.min_x_m(), 2)),
        Text(left + width_ / 2, bottom + 32, "middle", "x m"),
        Text(left + width_, bottom + 16, "end", Fixed(box_.max_x_m(), 2)));
    if (slice > 0) return svg;
    absl::StrAppend(&svg, Text(left - 6, bottom, "end", Fixed(box_.min_y_m(), 2)),
                    Text(left - 6, Top() + height_ / 2, "end", "y m"),
                    Text(left - 6, Top() + 10, "end", Fixed(box_.max_y_m(), 2)));
    return svg;
  }

  std::string Scale(double left) const {
    std::string svg = Text(left - 20, Top() - 8, "start", "95 %, mm");
    const double h = height_ / kScaleSteps;
    for (int i = 0; i < kScaleSteps; ++i)
      absl::StrAppend(&svg, Rectangle(left - 20, Top() + height_ - (i + 1) * h, 20, h + 0.3,
                                      ColourAt((i + 0.5) / kScaleSteps)));
    for (int i = 0; i < kScaleLabels; ++i) {
      const double share = static_cast<double>(i) / (kScaleLabels - 1);
      const double value = map_.best_95_mm() + share * (map_.worst_95_mm() - map_.best_95_mm());
      absl::StrAppend(&svg,
                      Text(left + 6, Top() + height_ * (1 - share) + 4, "start", Fixed(value, 3)));
    }
    return svg;
  }

  const v1::AccuracyMap& map_;
  const v1::AccuracyMapSpec& spec_;
  const v1::BoxDomain& box_;
  double width_, height_;  // of a slice
};

}  // namespace

std::string AccuracySvg(const v1::AccuracyMap& map, const std::string& title) {
  return Picture(map).Svg(title);
}

}  // namespace truepose::cli
