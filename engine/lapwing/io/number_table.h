#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/io/file_bytes.h"
#include "lapwing/io/mesh_format.h"

namespace lapwing {

/// Numbers in rows, which may differ in length.
struct NumberTable {
  std::string name;  ///< of the file, as messages begin
  std::vector<double> numbers;
  std::vector<std::size_t> starts{0};  ///< row r is numbers[starts[r], starts[r + 1])
  std::vector<std::size_t> lines;      ///< of each row in a text file, from 1; empty for .npy
  /// What a text file names its columns, in small letters and without quotes; empty without a
  /// header.
  std::vector<std::string> header;

  std::shared_ptr<const FileBytes> bytes;  ///< the file
  std::vector<std::uint64_t> offsets;      ///< of each number in it
  std::optional<Scalar> type;              ///< of the numbers of a .npy file of floats
  Encoding encoding = Encoding::ascii;

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

/// Whether the ending of `path` is that of a table.
bool is_number_table(const std::filesystem::path& path);

/// The file of `table` with `numbers` in place of its own; what is equal keeps its bytes. In text
/// they are printed so that they read back exactly. Throws InputError where a .npy file of integers
/// would have to hold others.
std::string with_numbers(const NumberTable& table, std::span<const double> numbers);

}  // namespace lapwing
