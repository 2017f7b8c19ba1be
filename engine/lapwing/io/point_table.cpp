#include "lapwing/io/point_table.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

template <std::size_t N>
using Names = std::array<std::string_view, N>;
constexpr Names<3> kPosition{"x", "y", "z"};
// 3D Slicer uses these names when it exports control points.
constexpr Names<3> kPositionRas{"r", "a", "s"};
constexpr Names<3> kPositionLps{"l", "p", "s"};
constexpr Names<3> kNormal{"nx", "ny", "nz"};
constexpr Names<4> kRotation{"qw", "qx", "qy", "qz"};

// Returns the columns of these names, nullopt if none exist. Throws InputError if only some do.
template <std::size_t N>
std::optional<std::array<std::size_t, N>> find(const Names<N>& names, const NumberTable& table) {
  std::array<std::size_t, N> columns{};
  std::string_view missing;
  std::size_t found = 0;
  for (std::size_t k = 0; k < N; ++k) {
    const auto at = std::find(table.header.begin(), table.header.end(), names[k]);
    if (at == table.header.end()) {
      missing = names[k];
    } else {
      columns[k] = static_cast<std::size_t>(at - table.header.begin());
      ++found;
    }
  }
  if (found == 0) return std::nullopt;
  if (found == N) return columns;
  throw InputError(table.name + ": its first line names " + std::to_string(found) + " of the " +
                   std::to_string(N) + " columns that belong together; add \"" +
                   std::string(missing) + "\"");
}

std::optional<std::array<std::size_t, 3>> find_position(const NumberTable& table) {
  for (const Names<3>& names : {kPosition, kPositionRas, kPositionLps}) {
    const bool has_all = std::ranges::all_of(
        names, [&](std::string_view name) { return std::ranges::count(table.header, name) > 0; });
    if (has_all) return find(names, table);
  }
  return find(kPosition, table);
}

// Throws InputError if row `r` and the header line have different numbers of fields. Ignores extra
// empty fields, because some programs end each line with a separator.
void require_width(const NumberTable& table, std::size_t r) {
  const std::size_t named = table.header.size();
  std::size_t count = table.row(r).size();
  while (count > named && table.text_at(r, count - 1) == "") --count;
  if (count == named || table.header_is_comment) return;
  throw InputError(table.place(r) + ": expected " + std::to_string(named) +
                   " fields, one for each column that the first line names, got " +
                   std::to_string(count));
}

// Quotes the text fields in the first row, for the end of an error message.
std::string text_beside(const NumberTable& table) {
  std::string list;
  for (const TextField& text : table.texts) {
    if (text.field >= table.starts[1]) break;
    list +=
        (list.empty() ? " and the text \"" : ", \"") + std::string(text.text.substr(0, 40)) + '"';
  }
  return list;
}

// Derives the columns from the number of values in the first row, for tables whose header does not
// name the columns.
PointColumns columns_by_count(const NumberTable& table) {
  const NumberColumns numbers = number_columns(table);
  const std::size_t count = numbers.of_row(table, 0).size();
  if (count != 3 && count != 6 && count != 7) {
    throw InputError(table.place(0) +
                     ": expected 3 numbers (a point x, y, z), 6 (a point and a normal) or 7 (a "
                     "point and a quaternion w, x, y, z), or a first line that names the columns "
                     "x, y and z; got " +
                     std::to_string(count) + text_beside(table));
  }
  for (std::size_t r = 0; r < table.row_count(); ++r) {
    const std::size_t other = numbers.of_row(table, r).size();
    if (other == count) continue;
    throw InputError(table.place(r) + ": expected " + std::to_string(count) +
                     " numbers, as in the first row, got " + std::to_string(other));
  }
  const std::size_t at = numbers.first;
  PointColumns columns{.position = {at, at + 1, at + 2}};
  if (count == 6) columns.normal = {at + 3, at + 4, at + 5};
  if (count == 7) columns.rotation = {at + 3, at + 4, at + 5, at + 6};
  return columns;
}

PointColumns columns_of(const NumberTable& table) {
  const auto position = find_position(table);
  if (!position) return columns_by_count(table);
  for (std::size_t r = 0; r < table.row_count(); ++r) require_width(table, r);
  return {*position, find(kNormal, table), find(kRotation, table)};
}

template <std::size_t N>
Eigen::Vector<double, static_cast<int>(N)> values_at(const NumberTable& table, std::size_t r,
                                                     const std::array<std::size_t, N>& columns,
                                                     std::string_view what) {
  Eigen::Vector<double, static_cast<int>(N)> values;
  for (std::size_t k = 0; k < N; ++k) {
    if (columns[k] >= table.row(r).size()) {
      throw InputError(table.place(r) + ": the row ends before column \"" +
                       table.header[columns[k]] + "\"");
    }
    table.require_number(r, columns[k]);
    values[static_cast<Eigen::Index>(k)] = table.row(r)[columns[k]];
  }
  if (values.allFinite()) return values;
  throw InputError(table.place(r) + ": its " + std::string(what) + " is not finite");
}

template <std::size_t N>
void put_values(const auto& values, const std::array<std::size_t, N>& columns,
                std::span<double> row) {
  for (std::size_t k = 0; k < N; ++k) row[columns[k]] = values[static_cast<Eigen::Index>(k)];
}

}  // namespace

PointTable read_point_table(const std::filesystem::path& path) {
  PointTable points{.table = read_number_table(path)};
  const NumberTable& table = points.table;
  points.columns = columns_of(table);
  for (std::size_t r = 0; r < table.row_count(); ++r) {
    points.positions.push_back(values_at(table, r, points.columns.position, "position"));
    if (points.columns.normal) {
      points.normals.push_back(values_at(table, r, *points.columns.normal, "normal"));
    }
    if (points.columns.rotation) {
      const Eigen::Vector4d q = values_at(table, r, *points.columns.rotation, "quaternion");
      points.rotations.emplace_back(q[0], q[1], q[2], q[3]);
    }
  }
  return points;
}

std::string bytes_of(const PointTable& points) {
  const NumberTable& table = points.table;
  std::vector<double> numbers = table.numbers;
  for (std::size_t r = 0; r < table.row_count(); ++r) {
    const std::span<double> row =
        std::span(numbers).subspan(table.starts[r], table.starts[r + 1] - table.starts[r]);
    put_values(points.positions[r], points.columns.position, row);
    if (points.columns.normal) put_values(points.normals[r], *points.columns.normal, row);
    if (points.columns.rotation) {
      const Quaterniond& q = points.rotations[r];
      put_values(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()), *points.columns.rotation, row);
    }
  }
  return with_numbers(table, numbers);
}

}  // namespace lapwing
