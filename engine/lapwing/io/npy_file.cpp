#include "lapwing/io/npy_file.h"

#include "lapwing/io/binary_numbers.h"

namespace lapwing {

std::string npy_bytes(std::span<const Eigen::Vector3d> rows, Scalar type) {
  // The header ends at a multiple of this many bytes, with a line feed.
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kBeforeHeader = 10;
  std::string header = "{'descr': '<f" + std::to_string(size_of(type)) +
                       "', 'fortran_order': False, 'shape': (" + std::to_string(rows.size()) +
                       ", 3), }";
  header.append(kAlignment - (kBeforeHeader + header.size() + 1) % kAlignment, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() % 256);
  bytes += static_cast<char>(header.size() / 256);
  bytes += header;

  std::size_t at = bytes.size();
  bytes.resize(at + 3 * rows.size() * size_of(type));
  for (const Eigen::Vector3d& row : rows) {
    for (const double number : row) {
      store_number(bytes.data() + at, number, type, Encoding::little_endian);
      at += size_of(type);
    }
  }
  return bytes;
}

}  // namespace lapwing
