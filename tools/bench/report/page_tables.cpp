#include "report/page_tables.h"

#include "report/growth.h"
#include "report/measurements.h"
#include "report/number_text.h"
#include "report/svg.h"

namespace lapwing::bench {
namespace {

std::string cell(std::string_view text) {
  return "<td>" + escaped(text) + "</td>";
}

std::string number_cell(std::string_view text) {
  return "<td class=\"n\">" + escaped(text) + "</td>";
}

// `columns` with a leading "#" are of numbers.
std::string table(const std::vector<std::string>& columns, const std::string& rows) {
  std::string head;
  for (const std::string& column : columns) {
    const bool is_number = column.starts_with("#");
    head += (is_number ? "<th class=\"n\">" : "<th>") + escaped(column.substr(is_number ? 1 : 0)) +
            "</th>";
  }
  return "<div class=\"wide\"><table><thead><tr>" + head + "</tr></thead>\n<tbody>\n" + rows +
         "</tbody></table></div>\n";
}

std::string gigabytes(std::uint64_t bytes) {
  return short_number(static_cast<double>(bytes) / 1e9) + " GB";
}

std::string rate(double value) {
  return value > 0.0 ? short_number(value) : "-";
}

std::string line(const char* name, const std::string& value) {
  return "<dt>" + std::string(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
}

std::string limits_table(const Report& report) {
  std::string rows;
  for (const Limits& limits : report.limits) {
    rows += "<tr>" + cell(limits.device) + cell(limits.type) + cell(limits.driver) +
            number_cell(rate(limits.copy_gb_per_s)) +
            number_cell(rate(limits.matmul_gflops_float32)) +
            number_cell(rate(limits.matmul_gflops_float64)) + "</tr>\n";
  }
  if (rows.empty()) return "";
  return table({"Device", "Kind", "Driver", "#copies, GB/s", "#float32 products, GFLOP/s",
                "#float64 products, GFLOP/s"},
               rows);
}

std::string median_number_cell(const std::vector<double>& ms) {
  return number_cell(ms.empty() ? "-" : short_number(spread_of(ms).median));
}

std::string counts_text(const Counts& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    text += (text.empty() ? "" : ", ") + name + " " + grouped(count);
  }
  return text;
}

std::string measurement_row(const Report& report, const Measurement& m) {
  const std::vector<double>& runs = clock_of(m);
  const Spread spread = spread_of(runs);
  const double share = share_of_limit(report, m);
  return "<tr>" + cell(m.mesh) + number_cell(grouped(m.vertices)) + cell(m.device) + cell(m.stage) +
         cell(m.by) + number_cell(grouped(runs.size())) + median_number_cell(m.wall_ms) +
         number_cell(short_number(spread.low) + " to " + short_number(spread.high)) +
         number_cell(short_number(spread.least) + " to " + short_number(spread.most)) +
         median_number_cell(m.cpu_ms) + median_number_cell(m.device_ms) +
         number_cell(m.peak_bytes > 0 ? grouped((m.peak_bytes + 500'000) / 1'000'000) : "-") +
         number_cell(share > 0.0 ? percent(share) : "-") + cell(counts_text(m.counts)) + "</tr>\n";
}

}  // namespace

std::string host_html(const Report& report) {
  const Host& host = report.host;
  return "<dl>\n" + line("Date", report.date) + line("Commit", report.commit) +
         line("Command", report.command) +
         line("Processor", host.processor + ", " + std::to_string(host.threads) + " threads") +
         line("Memory", gigabytes(host.memory_bytes)) + line("System", host.system) +
         line("Compiler", host.compiler) + "</dl>\n" + limits_table(report);
}

std::string targets_html(const Report& report) {
  std::string rows;
  for (const Target& target : report.targets) {
    rows +=
        target.met() ? "<tr><td class=\"met\">met</td>" : "<tr><td class=\"missed\">NOT met</td>";
    rows +=
        cell(target.name) + cell(target.on) + number_cell(short_number(target.measured)) +
        number_cell((target.is_floor ? "at least " : "at most ") + short_number(target.at_most)) +
        "</tr>\n";
  }
  return rows.empty() ? "" : table({"", "Target", "On", "#Measured", "#Asked for"}, rows);
}

std::string growths_html(const Report& report) {
  std::string rows;
  for (const Growth& growth : growths_of(report)) {
    rows += "<tr>" + cell(growth.device) + cell(growth.stage) + cell(growth.by) +
            number_cell(in_words(growth)) + number_cell(std::to_string(growth.sizes)) + "</tr>\n";
  }
  return rows.empty() ? "" : table({"Device", "Stage", "By", "#Growth", "#Sizes"}, rows);
}

std::string measurements_html(const Report& report) {
  std::string rows;
  for (const Measurement& m : report.measurements) rows += measurement_row(report, m);
  if (rows.empty()) return "";
  return table({"Mesh", "#Vertices", "Device", "Stage", "By", "#Runs", "#Median ms", "#Quartiles",
                "#Extremes", "#CPU ms", "#Device ms", "#Peak MB", "#Of limit", "Counts"},
               rows);
}

}  // namespace lapwing::bench
