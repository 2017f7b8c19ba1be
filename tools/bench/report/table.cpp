#include "report/table.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/printable_text.h"
#include "report/number_text.h"

namespace lapwing::bench {
namespace {

// Widths in characters.
constexpr std::size_t kStage = 30;
constexpr std::size_t kNumber = 8;
constexpr std::size_t kSpread = 8;
constexpr std::size_t kLimit = 6;
constexpr std::size_t kRatio = kTerminalLine - 2 - kStage - 4 * kNumber - kSpread - kLimit;

std::string median_cell(const std::vector<double>& ms) {
  return padded_left(ms.empty() ? "-" : short_number(median_of(ms)), kNumber);
}

// Returns half the distance between the quartiles, as a fraction of the median.
std::string spread_cell(const std::vector<double>& ms) {
  const Spread spread = spread_of(ms);
  if (ms.size() < 2 || !(spread.median > 0.0)) return padded_left("", kSpread);
  return padded_left("+-" + percent((spread.high - spread.low) / 2.0 / spread.median), kSpread);
}

std::string ratio_cell(const Report& report, const Measurement& m) {
  std::string text;
  for (const Measurement* peer : peers_of(report, m)) {
    if (m.wall_ms.empty() || peer->wall_ms.empty()) continue;
    const double ratio = median_of(m.wall_ms) / median_of(peer->wall_ms);
    text += "  " + short_number(ratio) + " of " + peer->by;
  }
  return clipped(text, kRatio);
}

std::string row(const Report& report, const Measurement& m) {
  const std::string name = m.is_ours() ? m.stage : m.stage + ", " + m.by;
  const double share = share_of_limit(report, m);
  std::string text = "  " + padded_right(clipped(name, kStage), kStage);
  text += median_cell(m.wall_ms) + spread_cell(m.clock_ms());
  text += median_cell(m.cpu_ms) + median_cell(m.device_ms);
  const auto megabytes = (m.peak_bytes + 500'000) / 1'000'000;
  text += padded_left(m.peak_bytes > 0 ? grouped(megabytes) : "-", kNumber);
  text += padded_left(share > 0.0 ? percent(share) : "-", kLimit);
  return text + ratio_cell(report, m) + "\n";
}

std::string name_of(const Measurement& subject) {
  return subject.mesh + ", " + grouped(subject.vertices) + " vertices";
}

std::string block(const Report& report, const Measurement& subject, const std::string& device) {
  std::string rows;
  for (const Measurement& m : report.measurements) {
    if (same_subject(m, subject) && m.device == device) rows += row(report, m);
  }
  if (rows.empty()) return "";
  return clipped(name_of(subject) + ", on " + device, kTerminalLine) + "\n  " +
         padded_right("ms", kStage) + padded_left("median", kNumber) +
         padded_left("spread", kSpread) + padded_left("cpu", kNumber) +
         padded_left("device", kNumber) + padded_left("peak MB", kNumber) +
         padded_left("limit", kLimit) + "  ratio\n" + rows + "\n";
}

std::string line_of(const Target& target) {
  const std::string bound =
      (target.is_floor ? ", at least " : ", at most ") + short_number(target.at_most);
  return clipped("  " + padded_right(target.met() ? "met" : "NOT met", 9) +
                     padded_right(short_number(target.measured) + bound, 24) + target.name + ", " +
                     target.on,
                 kTerminalLine) +
         "\n";
}

// A rate of 0 means that it was not measured. The float64 rate of a device without 64-bit floats is
// not measured, nor are the rates of a CPU without a BLAS.
std::string matmul_text(const Limits& limits) {
  const bool has_float64 = limits.matmul_gflops_float64 > 0.0;
  const double rate = has_float64 ? limits.matmul_gflops_float64 : limits.matmul_gflops_float32;
  if (!(rate > 0.0)) return "; products of matrices are not measured without a BLAS";
  return ", multiplies matrices at " + short_number(rate) + " GFLOP/s" +
         (has_float64 ? "" : " in float32");
}

std::string limit_lines(const Report& report) {
  std::string text;
  for (const Limits& limits : report.limits) {
    text += clipped(limits.device, 32) + " (" + limits.type + "): copies " +
            short_number(limits.copy_gb_per_s) + " GB/s" + matmul_text(limits) + "\n";
  }
  return text.empty() ? "" : text + "\n";
}

constexpr const char* kScreenLegend = R"(
CPU, device: ms of Lapwing, median of the runs; ratio: that over the time of the peer
peer, ms: what the stage is compared with, and its time; met: whether the target of the ratio is met

)";

constexpr const char* kTableLegend =
    R"(median, spread: wall time of a run, and half the distance between its quartiles
cpu, device: processor time of all threads, and time by the clock of the device
peak MB: memory while it runs; limit: share of the peak rates of the device
ratio: time of Lapwing over that of the peer

)";

// The table of Lapwing's stages on one mesh. Each stage is compared with the peer in its target, or
// with a peer that measured the same stage.
class Screen {
 public:
  explicit Screen(const Report& report) : report_(report) {
    for (const Measurement& m : report.measurements) {
      if (m.is_ours() && !m.wall_ms.empty()) rows_.push_back(&m);
      if (m.device != kProcessor && device_.empty()) device_ = m.device;
    }
  }

  std::string text() const {
    if (rows_.empty()) return "The report has no times.\n";
    const auto on_target =
        std::ranges::find_if(rows_, [](const Measurement* m) { return m->mesh == kTargetMesh; });
    const Measurement& main =
        on_target != rows_.end() ? **on_target : **std::ranges::max_element(rows_, {}, vertices);
    std::string text = clipped("Medians in ms on " + name_of(main), kTerminalLine) + "\n";
    text += clipped("CPU: " + report_.host.processor + ", " + std::to_string(report_.host.threads) +
                        " threads" + (device_.empty() ? "" : "; device: " + device_),
                    kTerminalLine) +
            "\n";
    text += "\n" + heading();
    std::vector<std::string> stages;
    for (const Measurement* m : rows_) {
      if (std::ranges::find(stages, m->stage) == stages.end()) stages.push_back(m->stage);
    }
    for (const std::string& stage : stages) {
      if (has(stage, main)) text += line(stage, main, stage);
    }
    for (const std::string& stage : stages) {
      if (has(stage, main)) continue;
      const Measurement& largest = largest_subject(stage);
      text += line(stage, largest, stage + ", " + largest.mesh + " " + grouped(largest.vertices));
    }
    const auto met = std::count_if(report_.targets.begin(), report_.targets.end(),
                                   [](const Target& target) { return target.met(); });
    return text + kScreenLegend + std::to_string(met) + " of " +
           std::to_string(report_.targets.size()) +
           " targets are met; --all-columns lists them and all numbers.\n";
  }

 private:
  static constexpr std::size_t kName = 32;
  static constexpr std::size_t kPeer = 27;
  static constexpr std::size_t kTime = 7;
  static constexpr std::size_t kPeerTime = 6;

  // The measurement with which a stage is compared.
  struct Peer {
    std::string name;
    double ms = 0.0;
  };

  static std::string ratio_text(double ratio) {
    // Ratios below 1 are printed with three decimals.
    const std::string text = short_number(std::round(1e3 * ratio) / 1e3);
    return ratio < 1.0 ? text.substr(0, 5) : text;
  }

  static std::string heading() {
    std::string text = padded_right("stage", kName);
    for (const char* title : {"CPU", "ratio", "device", "ratio"}) text += padded_left(title, kTime);
    return text + "  " + padded_right("peer", kPeer) + padded_left("ms", kPeerTime) + "  met\n";
  }

  static std::size_t vertices(const Measurement* m) { return m->vertices; }

  const Measurement& largest_subject(const std::string& stage) const {
    return **std::ranges::max_element(
        rows_, {}, [&](const Measurement* m) { return m->stage == stage ? m->vertices : 0; });
  }

  // Returns Lapwing's measurement of a stage, or null.
  const Measurement* find(const std::string& stage, const Measurement& subject,
                          const std::string& device) const {
    const auto found = std::ranges::find_if(rows_, [&](const Measurement* m) {
      return m->stage == stage && m->device == device && same_subject(*m, subject);
    });
    return found != rows_.end() ? *found : nullptr;
  }

  bool has(const std::string& stage, const Measurement& subject) const {
    return find(stage, subject, kProcessor) != nullptr || find(stage, subject, device_) != nullptr;
  }

  // Returns the target of this stage if its bound is a ratio to a peer ("STAGE / PEER"), else null.
  const Target* target_of(const Measurement& m) const {
    for (const Target& target : report_.targets) {
      if (target.name.starts_with(m.stage + " / ") && target.on == m.mesh + ", " + m.device) {
        return &target;
      }
    }
    return nullptr;
  }

  // Returns the peer in the stage's target. If there is no target, returns the fastest peer that
  // measured the same stage.
  Peer peer_of(const Measurement& m) const {
    const Target* const target = target_of(m);
    if (target != nullptr && target->measured > 0.0) {
      std::string name = target->name.substr(m.stage.size() + 3);
      if (name.starts_with(kLapwing)) name.replace(0, std::string(kLapwing).size(), "own");
      return {name, median_of(m.wall_ms) / target->measured};
    }
    Peer best;
    for (const Measurement* peer : peers_of(report_, m)) {
      const double ms = median_of(peer->wall_ms);
      if (ms > 0.0 && (best.name.empty() || ms < best.ms)) best = {peer->by, ms};
    }
    return best;
  }

  std::string line(const std::string& stage, const Measurement& subject,
                   const std::string& name) const {
    std::string text = padded_right(clipped(name, kName), kName);
    Peer shown;
    std::string verdict;
    for (const std::string& device : {std::string(kProcessor), device_}) {
      const Measurement* const m = find(stage, subject, device);
      if (m == nullptr) {
        text += padded_left("", 2 * kTime);
        continue;
      }
      const Peer peer = peer_of(*m);
      const double ms = median_of(m->wall_ms);
      text += padded_left(short_number(ms), kTime) +
              padded_left(peer.ms > 0.0 ? ratio_text(ms / peer.ms) : "", kTime);
      if (shown.name.empty()) shown = peer;
      if (const Target* const target = target_of(*m)) {
        if (verdict.empty() || !target->met()) verdict = target->met() ? "yes" : "NO";
      }
    }
    if (!shown.name.empty()) {
      text += "  " + padded_right(clipped(shown.name, kPeer - 1), kPeer) +
              padded_left(short_number(shown.ms), kPeerTime) + "  " + verdict;
    }
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  }

  const Report& report_;
  std::vector<const Measurement*> rows_;  // Lapwing's measurements with times
  std::string device_;                    // the first device that is not the CPU
};

}  // namespace

std::string screen_of(const Report& report) {
  return Screen(report).text();
}

std::string table_of(const Report& report) {
  std::string text = limit_lines(report);
  for (const Measurement* subject : subjects_of(report)) {
    for (const std::string& device : devices_of(report)) text += block(report, *subject, device);
  }
  if (!report.measurements.empty()) text += kTableLegend;
  if (report.targets.empty()) return text;
  text += "Targets\n";
  for (const Target& target : report.targets) text += line_of(target);
  return text + "\n";
}

}  // namespace lapwing::bench
