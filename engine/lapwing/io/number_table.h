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
  std::string name;  ///< of the file, for messages
  std::vector<double> numbers;
  std::vector<std::size_t> starts{0};  ///< row r is numbers[starts[r], starts[r + 1])
  std::vector<std::size_t> lines;      ///< line of each row in a text file, from 1; empty for .npy
  /// Column names of a text file, in lower case and without quotes; empty without a header.
  std::vector<std::string> header;

  std::shared_ptr<const FileBytes> bytes;  ///< the file
  std::vector<std::uint64_t> offsets;      ///< first byte of each number
  std::optional<Scalar> type;              ///< number type of a .npy file of floats
  Encoding encoding = Encoding::ascii;

  std::size_t row_count() const { return starts.size() - 1; }
  std::span<const double> row(std::size_t r) const {
    return std::span(numbers).subspan(starts[r], starts[r + 1] - starts[r]);
  }
  /// Returns "landmarks.csv:7" or "landmarks.npy, row 6", for messages.
  std::string place(std::size_t row) const;
};

/// Largest number of rows.
inline constexpr std::size_t kMostTableRows = 5'000'000;

/// Reads a table; the extension of `path` selects the format. In .csv, .txt and .tsv files, fields
/// are separated by commas, semicolons, tabs or blanks. A first line without a number is a header.
/// Empty lines and lines that begin with # are skipped. A .npy file holds an array (rows, columns)
/// of floats or integers of 8 to 64 bits in C order, as from numpy.save. Throws IoError if the file
/// cannot be read. Throws InputError, with the line of text files, if it is malformed or has no row
/// or more than kMostTableRows.
NumberTable read_number_table(const std::filesystem::path& path);

/// Whether `path` has the extension of a table.
bool is_number_table(const std::filesystem::path& path);

/// Returns the file of `table` with `numbers` in place of its own; equal numbers keep their bytes.
/// In text they are printed so that they read back exactly. Throws InputError if numbers of a .npy
/// file of integers changed.
std::string with_numbers(const NumberTable& table, std::span<const double> numbers);

}  // namespace lapwing
