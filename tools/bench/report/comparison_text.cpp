#include <algorithm>

#include "report/compare.h"
#include "report/measurements.h"
#include "report/number_text.h"

namespace lapwing::bench {
namespace {

// Widths in characters.
constexpr std::size_t kVerdict = 8;
constexpr std::size_t kRowName = 31;
constexpr std::size_t kWhat = 14;
constexpr std::size_t kNumbers = 36;  // two of a hundred thousand million
constexpr std::size_t kPercent = 8;
static_assert(2 + kVerdict + kRowName + kWhat + kNumbers + kPercent <= kTerminalLine);

bool is_time(const Change& change) {
  return change.what == "wall ms" || change.what == "device ms";
}

const char* word(const Change& change) {
  if (change.verdict == Verdict::better) return is_time(change) ? "faster" : "better";
  return is_time(change) ? "slower" : "worse";
}

std::string row_name(const RowKey& row) {
  return row.by == kOurselves ? row.stage : row.stage + ", " + row.by;
}

std::string heading(const RowKey& row) {
  return clipped(row.mesh + ", " + grouped(row.vertices) + " vertices, on " + row.device,
                 kTerminalLine) +
         "\n";
}

bool same_block(const RowKey& a, const RowKey& b) {
  return a.device == b.device && a.mesh == b.mesh && a.vertices == b.vertices;
}

std::string number(const Change& change, double value) {
  return is_time(change) ? short_number(value) : grouped(static_cast<std::uint64_t>(value));
}

// What ends up in a row's cells, without the spaces that empty ones leave at its end.
std::string line_of(const char* word, const RowKey& row, const std::string& rest) {
  std::string line = "  " + padded_right(word, kVerdict) +
                     padded_right(clipped(row_name(row), kRowName - 2), kRowName) + rest;
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string line_of(const Change& change) {
  const std::string numbers = number(change, change.before) + " -> " + number(change, change.after);
  return line_of(word(change), change.row,
                 padded_right(change.what, kWhat) + padded_right(numbers, kNumbers) +
                     padded_left(change_in_percent(change.before, change.after), kPercent));
}

std::string line_of(const Missing& missing) {
  std::string what = missing.count;
  if (missing.fails) what += missing.count.empty() ? "with its counts (worse)" : " (worse)";
  return line_of(missing.was_there ? "gone" : "new", missing.row, what);
}

template <class Item>
std::string lines_of(const std::vector<Item>& items) {
  std::string text;
  const RowKey* block = nullptr;
  for (const Item& item : items) {
    if (block == nullptr || !same_block(*block, item.row)) text += heading(item.row);
    block = &item.row;
    text += line_of(item);
  }
  return text;
}

// At most kTerminalLine wide, broken between words.
std::string wrapped(const std::string& sentence) {
  std::string text;
  std::size_t column = 0;
  for (std::size_t at = 0; at < sentence.size();) {
    const std::size_t end = std::min(sentence.find(' ', at), sentence.size());
    const std::string next = sentence.substr(at, end - at);
    const bool fits = column + 1 + character_count(next) <= kTerminalLine;
    text += (column == 0 ? "" : fits ? " " : "\n  ") + next;
    column =
        fits ? column + (column > 0 ? 1 : 0) + character_count(next) : 2 + character_count(next);
    at = end + 1;
  }
  return text + "\n";
}

std::string verdict_line(const Comparison& comparison) {
  static const char* const kWords[] = {"same", "better", "worse"};
  const auto how_many = [&](const char* name) {
    return std::count_if(comparison.changes.begin(), comparison.changes.end(),
                         [&](const Change& change) { return word(change) == std::string(name); });
  };
  const auto gone = std::count_if(comparison.missing.begin(), comparison.missing.end(),
                                  [](const Missing& missing) { return missing.fails; });
  return std::string("Verdict: ") + kWords[static_cast<std::size_t>(comparison.verdict)] +
         " (counts: " + std::to_string(how_many("worse")) + " rose, " + std::to_string(gone) +
         " gone, " + std::to_string(how_many("better")) +
         " fell; times: " + std::to_string(how_many("slower")) + " slower, " +
         std::to_string(how_many("faster")) + " faster)\n";
}

}  // namespace

std::string text_of(const Comparison& comparison) {
  std::string text = lines_of(comparison.changes) + lines_of(comparison.missing);
  if (!text.empty()) text += "\n";
  for (const std::string& note : comparison.notes) text += wrapped(note);
  text += "Unchanged: " + grouped(comparison.same_counts) + " counts, " +
          grouped(comparison.same_times) + " times.\n";
  return text + verdict_line(comparison);
}

}  // namespace lapwing::bench
