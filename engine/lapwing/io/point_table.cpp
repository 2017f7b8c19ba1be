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

PointColumns columns_of(const NumberTable& table) {
  const std::size_t count = table.row(0).size();
  if (const auto position = find(kPosition, table)) {
    if (table.header.size() != count) {
      throw InputError(table.place(0) + ": expected " + std::to_string(table.header.size()) +
                       " numbers, one for each column that the first line names, got " +
                       std::to_string(count));
    }
    return {*position, find(kNormal, table), find(kRotation, table)};
  }
  PointColumns columns;
  if (count == 6) columns.normal = {3, 4, 5};
  if (count == 7) columns.rotation = {3, 4, 5, 6};
  if (count == 3 || count == 6 || count == 7) return columns;
  throw InputError(table.place(0) +
                   ": expected 3 numbers (a point x, y, z), 6 (a point and a normal) or 7 (a point "
                   "and a quaternion w, x, y, z), or a first line that names the columns x, y and "
                   "z; got " +
                   std::to_string(count));
}

template <std::size_t N>
Eigen::Vector<double, static_cast<int>(N)> values_at(const NumberTable& table, std::size_t r,
                                                     const std::array<std::size_t, N>& columns,
                                                     std::string_view what) {
  Eigen::Vector<double, static_cast<int>(N)> values;
  for (std::size_t k = 0; k < N; ++k) {
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
  const std::size_t count = table.row(0).size();
  for (std::size_t r = 0; r < table.row_count(); ++r) {
    if (table.row(r).size() != count) {
      throw InputError(table.place(r) + ": expected " + std::to_string(count) +
                       " numbers, as in the first row, got " + std::to_string(table.row(r).size()));
    }
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
