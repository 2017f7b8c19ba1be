#include "report/compare_times.h"

#include <algorithm>
#include <cmath>

#include "report/measurements.h"
#include "report/number_text.h"
#include "report/rank_test.h"

namespace lapwing::bench {
namespace {

constexpr double kProbability = 0.01;
constexpr double kFalseShare = 0.05;      // of the times that are called changed
constexpr double kSmallestChange = 0.05;  // of a median: less is of no use to anyone
constexpr double kLimitsAgree = 0.10;

// The runs of one time before and after, and by what those after may be multiplied for their
// device.
struct Times {
  RowKey row;
  const char* what;
  const std::vector<double>* before;
  const std::vector<double>* after;
  std::vector<double> scales;
};

// By one clock: how probable it is that nothing changed, and what changed if something did.
struct Judgement {
  double probability = 1.0;
  Verdict verdict = Verdict::same;  // by the medians alone
};

Judgement judge(const std::vector<double>& before, std::vector<double> after, double scale) {
  for (double& ms : after) ms *= scale;
  const Spread old_times = spread_of(before);
  const Spread new_times = spread_of(after);
  const double by = std::abs(new_times.median - old_times.median);
  const double noise = std::max(old_times.high - old_times.low, new_times.high - new_times.low);
  Judgement judgement{rank_test(before, after), Verdict::same};
  if (by > kSmallestChange * old_times.median && by > noise) {
    judgement.verdict = new_times.median > old_times.median ? Verdict::worse : Verdict::better;
  }
  return judgement;
}

// What all clocks agree on, as sure as the least sure of them.
Judgement judge(const Times& times) {
  Judgement all = judge(*times.before, *times.after, 1.0);
  for (const double scale : times.scales) {
    const Judgement one = judge(*times.before, *times.after, scale);
    all.probability = std::max(all.probability, one.probability);
    if (one.verdict != all.verdict) all.verdict = Verdict::same;
  }
  return all;
}

const Limits* limits_of(const Report& report, const std::string& device) {
  Measurement on;
  on.device = device;
  return limits_of(report, on);
}

// Rates of after over before; empty where all of them agree or are not known.
std::vector<double> limit_scales(const Report& before, const Report& after,
                                 const std::string& device) {
  const Limits* const old_limits = limits_of(before, device);
  const Limits* const new_limits = limits_of(after, device);
  if (old_limits == nullptr || new_limits == nullptr) return {};
  std::vector<double> scales;
  bool agree = true;
  for (const auto rate :
       {&Limits::copy_gb_per_s, &Limits::matmul_gflops_float32, &Limits::matmul_gflops_float64}) {
    if (!(old_limits->*rate > 0.0) || !(new_limits->*rate > 0.0)) continue;
    scales.push_back(new_limits->*rate / old_limits->*rate);
    agree = agree && std::abs(scales.back() - 1.0) <= kLimitsAgree;
  }
  if (agree) scales.clear();
  return scales;
}

void note_limits(const std::map<std::string, std::vector<double>>& scales, Comparison& comparison) {
  for (const auto& [device, of_device] : scales) {
    if (of_device.empty()) continue;
    const auto [least, most] = std::minmax_element(of_device.begin(), of_device.end());
    const double factor = std::abs(std::log(*least)) > std::abs(std::log(*most)) ? *least : *most;
    comparison.notes.push_back(
        "The limits of " + device + " changed, one of them by " + change_in_percent(1.0, factor) +
        " (a busy machine, or another): only what changed by more is judged.");
  }
}

// So few runs that even the clearest change of one time alone would be put down to chance.
void note_few_runs(const std::vector<Times>& compared, Comparison& comparison) {
  const double bound = std::min(kProbability, kFalseShare / static_cast<double>(compared.size()));
  const auto too_few = [&](std::size_t before, std::size_t after) {
    return smallest_rank_test(before, after) >= bound;
  };
  const auto affected = std::count_if(compared.begin(), compared.end(), [&](const Times& times) {
    return too_few(times.before->size(), times.after->size());
  });
  if (affected == 0) return;
  std::size_t enough = 1;
  while (too_few(enough, enough)) ++enough;
  comparison.notes.push_back(std::to_string(affected) + " of " + std::to_string(compared.size()) +
                             " times have so few runs that a change of one alone cannot be told "
                             "from chance; with " +
                             std::to_string(enough) + " runs (--repeats) it can.");
}

void judge_times(const std::vector<Times>& compared, Comparison& comparison) {
  std::vector<Judgement> judgements;
  std::vector<double> probabilities;
  for (const Times& times : compared) {
    judgements.push_back(judge(times));
    probabilities.push_back(judgements.back().probability);
  }
  const double threshold = discovery_threshold(probabilities, kFalseShare);
  for (std::size_t k = 0; k < compared.size(); ++k) {
    const Times& times = compared[k];
    const auto& [probability, verdict] = judgements[k];
    if (verdict == Verdict::same || probability >= kProbability || probability > threshold) {
      ++comparison.same_times;
    } else {
      comparison.changes.push_back({times.row, times.what, spread_of(*times.before).median,
                                    spread_of(*times.after).median, verdict});
    }
  }
  note_few_runs(compared, comparison);
}

bool same_processor(const Report& before, const Report& after, Comparison& comparison) {
  const Host& a = before.host;
  const Host& b = after.host;
  if (a.processor == b.processor && a.threads == b.threads) return true;
  comparison.notes.push_back("Times are not judged: one report is of " + a.processor + " with " +
                             std::to_string(a.threads) + " threads, the other of " + b.processor +
                             " with " + std::to_string(b.threads) + ".");
  return false;
}

// What both reports have of one clock; nothing where one of them lacks it.
void add_times(const RowPair& row, const char* what, std::vector<double> Measurement::*ms,
               const std::vector<double>& scales, std::vector<Times>& times) {
  const std::vector<double>& before = row.before->*ms;
  const std::vector<double>& after = row.after->*ms;
  if (before.empty() || after.empty()) return;
  times.push_back({row.key, what, &before, &after, scales});
}

}  // namespace

void compare_times(const Report& before, const Report& after, const std::vector<RowPair>& rows,
                   Comparison& comparison) {
  if (!same_processor(before, after, comparison)) return;
  std::map<std::string, std::vector<double>> scales;
  std::vector<Times> times;
  for (const RowPair& row : rows) {
    const std::string& device = row.key.device;
    if (!scales.contains(device)) scales[device] = limit_scales(before, after, device);
    add_times(row, "wall ms", &Measurement::wall_ms, scales[device], times);
    add_times(row, "device ms", &Measurement::device_ms, scales[device], times);
  }
  note_limits(scales, comparison);
  judge_times(times, comparison);
}

}  // namespace lapwing::bench
