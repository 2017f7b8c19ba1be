#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lapwing {

/// Numbers in rows, which may differ in length.
struct NumberTable {
  std::string name;  ///< of the file, as messages begin
  std::vector<double> numbers;
  std::vector<std::size_t> starts{0};  ///< row r is numbers[starts[r], starts[r + 1])
  std::vector<std::size_t> lines;      ///< of each row in a text file, from 1; empty for .npy

  std::size_t row_count() const { return starts.size() - 1; }
  std::span<const double> row(std::size_t r) const {
    return std::span(numbers).subspan(starts[r], starts[r + 1] - starts[r]);
  }
  /// "landmarks.csv:7" or "landmarks.npy, row 6", to begin a message with.
  std::string place(std::size_t row) const;
};

/// No table has more.
inline constexpr std::size_t kMostTableRows = 5'000'000;

/// Reads `path`, by its ending: .csv (.txt, .tsv; fields separated by commas, semicolons, tabs or
/// blanks, a first line without a number is a header, empty lines and those that begin with # are
/// passed over) or .npy (numpy.save of an array (rows, columns) of floats or integers, 8 to 64
/// bits, C order). Throws IoError where it cannot be read, InputError, naming the line or byte,
/// where it is no such table, has no row or more than kMostTableRows.
NumberTable read_number_table(const std::filesystem::path& path);

}  // namespace lapwing
