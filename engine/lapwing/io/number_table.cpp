// NPY: "A Simple File Format for NumPy Arrays", numpy.lib.format, versions 1 to 3.
#include "lapwing/io/number_table.h"

#include <algorithm>
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
#include "lapwing/io/text_scanner.h"
#include "lapwing/io/writing.h"

namespace lapwing {
namespace {

std::string lowered(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool is_npy(const std::filesystem::path& path) {
  return lowered(path.extension().string()) == ".npy";
}

bool is_separator(char c) {
  return c == ',' || c == ';' || c == ' ' || c == '\t' || c == '\r';
}

[[noreturn]] void fail_too_many(const std::string& name) {
  throw InputError(name + ": more than " + std::to_string(kMostTableRows) +
                   " rows; check that this is the right file");
}

// Splits a header line into names.
std::vector<std::string> read_names(std::string_view line) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : lowered(line) + ",") {
    if (c == '"' || c == '\'') continue;
    if (!is_separator(c)) {
      name += c;
    } else if (!name.empty()) {
      names.push_back(std::exchange(name, {}));
    }
  }
  return names;
}

// Adds the numbers of a line to the table. If a field is no number, returns it in `bad`.
bool read_fields(std::string_view line, NumberTable& table, std::string_view& bad) {
  const char* here = line.data();
  const char* const end = here + line.size();
  while (true) {
    while (here != end && is_separator(*here)) ++here;
    if (here == end) return true;
    const char* stop = here;
    while (stop != end && !is_separator(*stop)) ++stop;
    double value = 0.0;
    if (parse_number(here, stop, value) != stop) {
      bad = {here, static_cast<std::size_t>(stop - here)};
      return false;
    }
    table.numbers.push_back(value);
    table.offsets.push_back(static_cast<std::uint64_t>(here - table.bytes->view().data()));
    here = stop;
  }
}

void read_text(NumberTable& table) {
  const std::string& name = table.name;
  std::string_view text = table.bytes->view();
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::size_t line_number = 0;
  while (!text.empty()) {
    ++line_number;
    const std::size_t length = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, length);
    text.remove_prefix(std::min(length + 1, text.size()));
    if (line.starts_with('#')) continue;
    std::string_view bad;
    const bool is_header = table.row_count() == 0;
    if (!read_fields(line, table, bad)) {
      const bool any_number = table.numbers.size() > table.starts.back();
      if (is_header && !any_number) {
        table.header = read_names(line);
        continue;
      }
      throw InputError(name + ":" + std::to_string(line_number) + ": expected a number, found \"" +
                       std::string(bad.substr(0, 40)) + "\"");
    }
    if (table.numbers.size() == table.starts.back()) continue;
    table.starts.push_back(table.numbers.size());
    table.lines.push_back(line_number);
    if (table.row_count() > kMostTableRows) fail_too_many(name);
  }
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
  const auto rows = read_whole(shape);
  const auto columns = read_whole(shape);
  if (!rows || !columns || read_whole(shape)) fail("expected two dimensions");
  read.rows = *rows;
  read.columns = *columns;
  if (read.rows > kMostTableRows) fail_too_many(name);
  const std::size_t numbers = (bytes.size() - read.begin) / read.bytes;
  if (read.columns > 0 && read.rows > numbers / read.columns) {
    fail("the file ends within its " + std::to_string(read.rows) + " rows");
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

bool is_equal(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

std::string text_with(const NumberTable& table, std::span<const double> numbers) {
  const std::string_view old = table.bytes->view();
  std::string text;
  std::uint64_t copied = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (is_equal(numbers[k], table.numbers[k])) continue;
    text.append(old, copied, table.offsets[k] - copied);
    append_number(text, numbers[k]);
    double ignored = 0.0;
    const char* const end =
        parse_number(old.data() + table.offsets[k], old.data() + old.size(), ignored);
    copied = static_cast<std::uint64_t>(end - old.data());
  }
  text.append(old, copied);
  return text;
}

std::string npy_with(const NumberTable& table, std::span<const double> numbers) {
  std::string bytes(table.bytes->view());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (is_equal(numbers[k], table.numbers[k])) continue;
    if (!table.type) {
      throw InputError(table.name +
                       ": its numbers are integers, but moved points need floats; save the table "
                       "as floats");
    }
    store_number(bytes.data() + table.offsets[k], numbers[k], *table.type, table.encoding);
  }
  return bytes;
}

}  // namespace

std::string NumberTable::place(std::size_t row) const {
  if (!lines.empty()) return name + ":" + std::to_string(lines[row]);
  return name + ", row " + std::to_string(row);
}

NumberTable read_number_table(const std::filesystem::path& path) {
  NumberTable table{.name = path.string()};
  table.bytes = std::make_shared<const FileBytes>(FileBytes::read(path));
  if (!is_number_table(path)) {
    throw InputError(table.name + ": expected a table with the extension .csv, .txt, .tsv or .npy");
  }
  if (is_npy(path)) {
    read_npy(table);
  } else {
    read_text(table);
  }
  if (table.row_count() == 0) throw InputError(table.name + ": the table has no rows");
  return table;
}

bool is_number_table(const std::filesystem::path& path) {
  const std::string ending = lowered(path.extension().string());
  return ending == ".csv" || ending == ".txt" || ending == ".tsv" || ending == ".npy";
}

std::string with_numbers(const NumberTable& table, std::span<const double> numbers) {
  return table.encoding == Encoding::ascii ? text_with(table, numbers) : npy_with(table, numbers);
}

}  // namespace lapwing
