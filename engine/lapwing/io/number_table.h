#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/file_bytes.h"
#include "lapwing/io/mesh_format.h"

namespace lapwing {

/// A field of a table that is not a number, such as a name.
struct TextField {
  std::size_t field = 0;  ///< index into NumberTable::numbers
  std::string_view text;  ///< refers to the bytes of the file
};

/// A table of numbers and texts. Its rows may differ in length.
struct NumberTable {
  std::string name;                    ///< name of the file, for messages
  std::vector<double> numbers;         ///< one per field; NaN for text
  std::vector<TextField> texts;        ///< the fields that are not numbers, in order
  std::vector<std::size_t> starts{0};  ///< row r is numbers[starts[r], starts[r + 1])
  std::vector<std::size_t> lines;      ///< line of each row in a text file, from 1; empty for .npy
  /// Column names of a text file, in lower case and without quotes; empty without a header.
  std::vector<std::string> header;
  /// Whether the header is a comment of 3D Slicer. If so, the rows may have more or fewer fields
  /// than the header.
  bool header_is_comment = false;

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
  /// Returns the text of a field, or nullopt if the field is a number.
  std::optional<std::string_view> text_at(std::size_t row, std::size_t column) const;
  /// If the field is not a number, throws an InputError with its location and its text.
  void require_number(std::size_t row, std::size_t column) const;
  /// Ends the current row. Throws InputError if the table now has too many rows.
  void end_row(std::size_t line);
};

/// The range of numeric columns in a table that also has columns of names or labels.
struct NumberColumns {
  std::size_t first = 0;   ///< number of text columns before the numbers
  std::size_t behind = 0;  ///< number of text columns after the numbers

  std::span<const double> of_row(const NumberTable& table, std::size_t row) const;
};

/// Counts the columns at the start and at the end of the table that contain text in every row.
/// Throws InputError, with the line, if a row has no numbers or if another field is text.
NumberColumns number_columns(const NumberTable& table);

/// Largest number of rows.
inline constexpr std::size_t kMostTableRows = 5'000'000;

/// Reads a table. The extension of `path` selects the format. In .csv, .txt, .tsv and .fcsv files,
/// the first line decides whether semicolons, commas, tabs or blanks separate the fields. Fields
/// may be in quotation marks. If the first line has no numbers, it is a header. Empty lines
/// and lines that begin with # are skipped, but a comment "# columns = ..." of 3D Slicer is a
/// header. A .mrk.json file of Slicer is a table of its control points. A .npy file contains an
/// array (rows, columns) of floats or of integers of 8 to 64 bits, in C order, as numpy.save writes
/// it. Throws IoError if the file cannot be read. Throws InputError if the file is malformed, has
/// no rows, or has more than kMostTableRows.
NumberTable read_number_table(const std::filesystem::path& path);

/// Returns the extension of a table in lower case, such as ".csv" or ".mrk.json". Returns "" if
/// `path` has none of the extensions of tables.
std::string_view table_extension(const std::filesystem::path& path);

/// Returns the file of `table`, in which `numbers` replace the old numbers. Equal numbers keep
/// their bytes. Text files store new numbers with enough digits to read them back exactly. Throws
/// InputError if numbers of a .npy file of integers changed.
std::string with_numbers(const NumberTable& table, std::span<const double> numbers);

/// Returns the header of a .npy file (version 1.0) for a little-endian array in C order. `type` is
/// float32 or float64.
std::string npy_header(std::span<const std::size_t> shape, Scalar type);
/// Returns the bytes of the rows in a .npy file.
std::string npy_rows(std::span<const Eigen::Vector3d> rows, Scalar type);
/// Returns a .npy file (version 1.0) of an array of shape (rows.size(), 3), little endian, in C
/// order. `type` is float32 or float64.
std::string npy_bytes(std::span<const Eigen::Vector3d> rows, Scalar type);

}  // namespace lapwing
