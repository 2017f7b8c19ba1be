// NPY: "A Simple File Format for NumPy Arrays", numpy.lib.format, versions 1 to 3.
#include "lapwing/io/number_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/io/binary_numbers.h"
#include "lapwing/io/file_bytes.h"
#include "lapwing/io/source_file.h"
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/text_table.h"

namespace lapwing {

namespace {

[[noreturn]] void fail_too_many(const std::string& name) {
  throw InputError(name + ": more than " + std::to_string(kMostTableRows) +
                   " rows; check that this is the right file");
}

struct NpyHeader {
  char kind = 'f';  ///< f, i or u
  std::size_t bytes = 8;
  Encoding encoding = Encoding::little_endian;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t begin = 0;  ///< first byte of the numbers
};

// Returns the text behind `key` in the dictionary of the header.
std::string_view after_key(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  std::string_view rest = header.substr(at + key.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(" :"), rest.size()));
  return rest;
}

std::optional<std::size_t> read_whole(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" (,"), text.size()));
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

NpyHeader read_header(const std::string& name, std::string_view bytes) {
  const auto fail = [&](const std::string& what) {
    throw InputError(name + ": " + what +
                     "; save rows and columns of numbers with numpy.save(file, array)");
  };
  if (bytes.size() < 12 || !bytes.starts_with("\x93NUMPY")) fail("not an NPY file");
  const bool is_short = bytes[6] == 1;
  const std::size_t at = is_short ? 10 : 12;
  std::size_t length = 0;
  for (std::size_t k = at; k-- > 8;) length = 256 * length + static_cast<unsigned char>(bytes[k]);
  if (length > bytes.size() - at) fail("the file ends within its header");
  const std::string_view header = bytes.substr(at, length);

  NpyHeader read;
  read.begin = at + length;
  const std::string_view type = after_key(header, "'descr'");
  constexpr std::string_view kKinds = "fiu";
  if (type.size() < 4 || kKinds.find(type[2]) == std::string_view::npos) {
    fail("expected floats or integers");
  }
  read.kind = type[2];
  read.bytes = static_cast<std::size_t>(type[3] - '0');
  read.encoding = type[1] == '>' ? Encoding::big_endian : Encoding::little_endian;
  const bool fits = read.bytes == 4 || read.bytes == 8 ||
                    (read.kind != 'f' && (read.bytes == 1 || read.bytes == 2));
  if (!fits || type[4] != type[0])
    fail("expected floats of 32 or 64 bits, or integers of 8 to 64 bits");
  if (!after_key(header, "'fortran_order'").starts_with("False")) {
    fail("the array is in Fortran order, expected C order (numpy.ascontiguousarray)");
  }
  std::string_view shape = after_key(header, "'shape'");
  std::vector<std::size_t> sizes;
  while (const auto size = read_whole(shape)) sizes.push_back(*size);
  if (sizes.size() != 2) fail("expected two dimensions");
  read.rows = sizes[0];
  read.columns = sizes[1];
  if (read.rows > kMostTableRows) fail_too_many(name);
  const std::size_t numbers = (bytes.size() - read.begin) / read.bytes;
  if (read.columns > 0 && read.rows > numbers / read.columns) {
    fail("the file ends before the last of its " + std::to_string(read.rows) + " rows");
  }
  return read;
}

double load(const char* from, const NpyHeader& header) {
  if (header.kind == 'f') {
    return load_number(from, header.bytes == 4 ? Scalar::float32 : Scalar::float64,
                       header.encoding);
  }
  // Any number of bytes, the most significant first.
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < header.bytes; ++k) {
    const bool forward = header.encoding == Encoding::big_endian;
    bits = bits << 8U | static_cast<unsigned char>(from[forward ? k : header.bytes - 1 - k]);
  }
  if (header.kind == 'u') return static_cast<double>(bits);
  const std::size_t unused = 64 - 8 * header.bytes;
  return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
}

void read_npy(NumberTable& table) {
  const std::string_view bytes = table.bytes->view();
  const NpyHeader header = read_header(table.name, bytes);
  table.encoding = header.encoding;
  if (header.kind == 'f') table.type = header.bytes == 4 ? Scalar::float32 : Scalar::float64;
  const char* from = bytes.data() + header.begin;
  for (std::size_t r = 0; r < header.rows; ++r) {
    for (std::size_t c = 0; c < header.columns; ++c, from += header.bytes) {
      table.numbers.push_back(load(from, header));
      table.offsets.push_back(static_cast<std::uint64_t>(from - bytes.data()));
    }
    table.starts.push_back(table.numbers.size());
  }
}

std::string in_quotes(std::string_view text) {
  return '"' + std::string(text.substr(0, 40)) + '"';
}

bool is_equal(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

}  // namespace

std::string NumberTable::place(std::size_t row) const {
  if (!lines.empty()) return name + ":" + std::to_string(lines[row]);
  return name + ", row " + std::to_string(row);
}

std::optional<std::string_view> NumberTable::text_at(std::size_t row, std::size_t column) const {
  const auto at = std::ranges::lower_bound(texts, starts[row] + column, {}, &TextField::field);
  if (at == texts.end() || at->field != starts[row] + column) return std::nullopt;
  return at->text;
}

void NumberTable::require_number(std::size_t row, std::size_t column) const {
  const auto text = text_at(row, column);
  if (!text) return;
  const bool has_name = column < header.size();
  throw InputError(place(row) + ": expected a number in column " +
                   (has_name ? in_quotes(header[column]) : std::to_string(column + 1)) +
                   ", found " + (text->empty() ? "nothing" : in_quotes(*text)) +
                   std::string(hint_of_decimal_comma(*text)) +
                   (header.empty() ? "; correct it (a first or last column without numbers is text)"
                                   : "; correct it"));
}

void NumberTable::end_row(std::size_t line) {
  starts.push_back(numbers.size());
  lines.push_back(line);
  if (row_count() > kMostTableRows) fail_too_many(name);
}

std::span<const double> NumberColumns::of_row(const NumberTable& table, std::size_t row) const {
  std::span<const double> numbers = table.row(row).subspan(first);
  numbers = numbers.first(numbers.size() - behind);
  // Remove text fields at the end. A separator at the end of a line adds an empty text field.
  while (!numbers.empty() && table.text_at(row, first + numbers.size() - 1)) {
    numbers = numbers.first(numbers.size() - 1);
  }
  return numbers;
}

NumberColumns number_columns(const NumberTable& table) {
  if (table.texts.empty()) return {};
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  NumberColumns columns{kAll, kAll};
  for (std::size_t r = 0; r < table.row_count(); ++r) {
    const std::size_t count = table.row(r).size();
    std::size_t first = 0;
    while (first < count && table.text_at(r, first)) ++first;
    if (first == count) {
      const std::string_view found = table.text_at(r, 0).value_or("");
      throw InputError(table.place(r) + ": expected numbers, found " + in_quotes(found) +
                       std::string(hint_of_decimal_comma(found)) +
                       "; only the first line may name the columns");
    }
    std::size_t behind = 0;
    while (table.text_at(r, count - 1 - behind)) ++behind;
    columns = {std::min(columns.first, first), std::min(columns.behind, behind)};
  }
  for (std::size_t r = 0; r < table.row_count(); ++r) {
    std::size_t end = table.row(r).size() - columns.behind;
    while (table.text_at(r, end - 1) == "") --end;
    for (std::size_t c = columns.first; c < end; ++c) table.require_number(r, c);
  }
  return columns;
}

NumberTable read_number_table(const std::filesystem::path& path) {
  NumberTable table{.name = path.string()};
  table.bytes = std::make_shared<const FileBytes>(FileBytes::read_data(path));
  const std::string_view extension = table_extension(path);
  if (extension.empty()) {
    throw InputError(table.name +
                     ": expected a table with the extension .csv, .txt, .tsv, .npy, .fcsv or "
                     ".mrk.json");
  }
  if (extension == ".npy") {
    read_npy(table);
  } else if (extension == ".mrk.json") {
    read_markups(table);
  } else {
    read_text_table(table);
  }
  if (table.row_count() == 0) throw InputError(table.name + ": the table has no rows");
  return table;
}

std::string_view table_extension(const std::filesystem::path& path) {
  const std::string name = lowered(path.filename().string());
  for (const std::string_view extension : {".csv", ".txt", ".tsv", ".npy", ".fcsv", ".mrk.json"}) {
    if (name.ends_with(extension)) return extension;
  }
  return {};
}

std::string with_numbers(const NumberTable& table, std::span<const double> numbers) {
  FilePatch patch(table.bytes->view(), table.encoding);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (is_equal(numbers[k], table.numbers[k])) continue;
    if (!table.type && table.encoding != Encoding::ascii) {
      throw InputError(table.name +
                       ": its numbers are integers, but moved points need floats; save the table "
                       "as floats");
    }
    patch.set_number(table.offsets[k], numbers[k], table.type.value_or(Scalar::float64));
  }
  return patch.apply();
}

std::string npy_header(std::span<const std::size_t> shape, Scalar type) {
  // The header ends at a multiple of this many bytes, with a line feed.
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kBeforeHeader = 10;
  std::string header =
      "{'descr': '<f" + std::to_string(size_of(type)) + "', 'fortran_order': False, 'shape': (";
  for (std::size_t k = 0; k < shape.size(); ++k) {
    header += (k > 0 ? ", " : "") + std::to_string(shape[k]);
  }
  header += "), }";
  header.append(kAlignment - (kBeforeHeader + header.size() + 1) % kAlignment, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() % 256);
  bytes += static_cast<char>(header.size() / 256);
  return bytes + header;
}

std::string npy_rows(std::span<const Eigen::Vector3d> rows, Scalar type) {
  std::string bytes(3 * rows.size() * size_of(type), '\0');
  std::size_t at = 0;
  for (const Eigen::Vector3d& row : rows) {
    for (const double number : row) {
      store_number(bytes.data() + at, number, type, Encoding::little_endian);
      at += size_of(type);
    }
  }
  return bytes;
}

std::string npy_bytes(std::span<const Eigen::Vector3d> rows, Scalar type) {
  return npy_header(std::array{rows.size(), std::size_t{3}}, type) + npy_rows(rows, type);
}

}  // namespace lapwing
