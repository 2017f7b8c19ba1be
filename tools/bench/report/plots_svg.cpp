#include "report/measurements.h"
#include "report/page.h"
#include "report/plots.h"
#include "report/theme.h"

namespace lapwing::bench {
namespace {

constexpr double kColumn = 480;
constexpr double kMargin = 20;

// Of one device, side by side below its name.
std::optional<Svg> row_of(const Report& report, const std::string& device) {
  constexpr double kDeviceHeading = 26;
  std::vector<Svg> pictures;
  if (auto plot = scaling_plot(report, device, Lines::waits, kColumn)) pictures.push_back(*plot);
  if (auto plot = stages_plot(report, device, kColumn)) pictures.push_back(*plot);
  if (pictures.empty()) return std::nullopt;
  double height = 0.0;
  for (const Svg& picture : pictures) height = std::max(height, picture.height());
  Svg row(2 * kColumn + kMargin, kDeviceHeading + height);
  row.text({0, 13}, "On " + device, "quiet", Anchor::start);
  double x = 0.0;
  for (const Svg& picture : pictures) {
    row.place(picture, {x, kDeviceHeading});
    x += kColumn + kMargin;
  }
  return row;
}

}  // namespace

std::string plots_svg(const Report& report) {
  std::vector<Svg> rows;
  double height = kMargin;
  for (const std::string& device : devices_of(report)) {
    auto row = row_of(report, device);
    if (!row) continue;
    height += row->height() + kMargin;
    rows.push_back(*std::move(row));
  }
  Svg svg(2 * kColumn + 3 * kMargin, height);
  svg.rectangle({0, 0}, svg.width(), svg.height(), "paper");
  double y = kMargin;
  for (const Svg& row : rows) {
    svg.place(row, {kMargin, y});
    y += row.height() + kMargin;
  }
  return svg.element("How Lapwing's times grow with the mesh, and what preparations consist of",
                     light_theme());
}

}  // namespace lapwing::bench
