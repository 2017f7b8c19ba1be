#include "report/page.h"

#include "report/measurements.h"
#include "report/page_tables.h"
#include "report/plots.h"
#include "report/svg.h"
#include "report/theme.h"

namespace lapwing::bench {
namespace {

constexpr double kPlotWidth = 960;
constexpr double kHalfWidth = 470;   // of scaling plots, which stand in pairs
constexpr double kThirdWidth = 306;  // of those beside peers

const char* const kStyle = R"(
:root{color-scheme:light dark}
body{margin:0 auto;max-width:1000px;padding:16px;font:15px/1.45 system-ui,"Segoe UI",Helvetica,Arial,sans-serif;background:#fff;color:#1b1f24}
h1{font-size:24px;margin:8px 0} h2{font-size:19px;margin:28px 0 8px} h3{font-size:15px;margin:18px 0 6px}
p{max-width:46em} dl{display:grid;grid-template-columns:max-content 1fr;gap:2px 16px} dt{opacity:.7} dd{margin:0;overflow-wrap:anywhere}
table{border-collapse:collapse;font-size:13px;font-variant-numeric:tabular-nums} th{text-align:left;vertical-align:bottom}
th,td{padding:3px 10px 3px 0;border-bottom:1px solid #8884} .n{text-align:right} td{white-space:nowrap}
.wide{overflow-x:auto} .met{color:#117733;font-weight:600} .missed{color:#b3261e;font-weight:600}
.plots{display:flex;flex-wrap:wrap;gap:16px 20px} .plot{max-width:100%;height:auto}
)";

const char* const kDarkStyle =
    "body{background:#14171b;color:#e8eaed} .met{color:#5ec47f} .missed{color:#ff8a80}\n";

const char* const kPrintStyle =
    "@media print{body{max-width:none;padding:0;font-size:11pt} table{font-size:7pt} "
    "th,td{padding-right:5px} .wide{overflow:visible} svg,tr{break-inside:avoid} "
    "h2,h3{break-after:avoid} .plots{display:block} .plots .plot{max-width:49%} "
    ".plots .plot:only-child{max-width:100%} td{white-space:normal}}\n";

std::string section(const char* heading, const char* explanation, const std::string& content) {
  if (content.empty()) return "";
  return "<section>\n<h2>" + std::string(heading) + "</h2>\n<p>" + explanation + "</p>\n" +
         content + "</section>\n";
}

std::string folded(const char* summary, const std::string& content) {
  if (content.empty()) return "";
  return "<details><summary>" + std::string(summary) + "</summary>\n" + content + "</details>\n";
}

std::string element(const std::optional<Svg>& plot, const std::string& label) {
  return plot ? plot->element(label) : "";
}

std::string on_every_device(const Report& report,
                            std::string (*plots)(const Report&, const std::string&)) {
  std::string html;
  for (const std::string& device : devices_of(report)) {
    const std::string of_device = plots(report, device);
    if (of_device.empty()) continue;
    html += "<h3>On " + escaped(device) + "</h3>\n<div class=\"plots\">\n" + of_device + "</div>\n";
  }
  return html;
}

std::string scaling_plots(const Report& report, const std::string& device) {
  std::string html;
  for (const Lines lines : {Lines::waits, Lines::preparation, Lines::kernels}) {
    html += element(scaling_plot(report, device, lines, kHalfWidth),
                    "Time over number of vertices on " + device);
  }
  return html;
}

std::string plots_beside_peers(const Report& report, const std::string& device) {
  std::string html;
  for (const Svg& plot : peer_plots(report, device, kThirdWidth)) {
    html += plot.element("Our times and others' over number of vertices on " + device);
  }
  return html;
}

std::string stages_plots(const Report& report, const std::string& device) {
  return element(stages_plot(report, device, kPlotWidth),
                 "Shares of the stages of a preparation on " + device);
}

std::string style() {
  return kStyle + light_theme() + "@media screen and (prefers-color-scheme:dark){\n" + kDarkStyle +
         dark_theme() + "}\n" + kPrintStyle;
}

std::string sections(const Report& report) {
  return section("Targets", "What was asked for, and what this run gave.", targets_html(report)) +
         section(
             "How times grow",
             "Medians of wall times (of kernels, of the device's own), with error bars from one "
             "quartile to the other. Lines join the sizes of one mesh where there are three or "
             "more; marks beside them are other meshes. n^1.5 behind a name: over all meshes, time "
             "grows as the 1.5th power of the number of vertices.",
             on_every_device(report, scaling_plots) +
                 folded("Growth in numbers", growths_html(report))) +
         section("What preparations consist of",
                 "Each stage alone, as a share of their sum. What a device does not do itself is "
                 "shown as the processor does it.",
                 on_every_device(report, stages_plots)) +
         section(
             "Beside others",
             "The same work by others, on the processor whatever ours runs on. Bars to the left "
             "of 1: we are faster. Dashed lines are theirs.",
             element(ratios_plot(report, kPlotWidth), "Ratios of our times to others'") +
                 on_every_device(report, plots_beside_peers)) +
         section(
             "Beside what the device can do",
             "Operations over the rate of float64 products of large matrices, or bytes that must "
             "be moved over the rate of large copies, whichever is the larger share. What stays in "
             "caches can be faster than large copies: more than 100%.",
             element(limits_plot(report, kPlotWidth), "Shares of the devices' limits")) +
         section(
             "All measurements",
             "Milliseconds. Quartiles and extremes are of the wall time, or of the device's own "
             "where nothing else was measured.",
             measurements_html(report));
}

}  // namespace

std::string page_of(const Report& report) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
         "<title>lapwing-bench, " +
         escaped(report.date) + "</title>\n<style>" + style() +
         "</style>\n</head>\n<body>\n<h1>lapwing-bench</h1>\n" + host_html(report) +
         sections(report) + "</body>\n</html>\n";
}

}  // namespace lapwing::bench
