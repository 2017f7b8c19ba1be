#include "state/kept_results.h"

#include <algorithm>
#include <cstring>
#include <fstream>

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPositionBytes = 3 * sizeof(double);
constexpr std::size_t kVertexBytes = sizeof(Index) + kPositionBytes;

}  // namespace

std::uint64_t result_key(const Draft& draft) {
  Recipe recipe;
  recipe.mesh = "mesh";
  recipe.steps = draft.steps;
  recipe.steps.emplace_back(draft.open);
  // Computes the 64-bit FNV-1a hash.
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : to_json(recipe)) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return hash;
}

std::string bytes_of(const MovedVertices& moved) {
  const std::size_t count = moved.vertices.size();
  std::string bytes(count * kVertexBytes, '\0');
  std::memcpy(bytes.data(), moved.vertices.data(), count * sizeof(Index));
  char* to = bytes.data() + count * sizeof(Index);
  for (const Eigen::Vector3d& position : moved.positions) {
    std::memcpy(to, position.data(), kPositionBytes);
    to += kPositionBytes;
  }
  return bytes;
}

std::optional<MovedVertices> read_result(const fs::path& path, const KeptResult& where) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || where.start > size || where.vertices > (size - where.start) / kVertexBytes) {
    return std::nullopt;
  }
  const auto count = static_cast<std::size_t>(where.vertices);
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(where.start));
  MovedVertices moved;
  moved.vertices.resize(count);
  moved.positions.resize(count);
  in.read(reinterpret_cast<char*>(moved.vertices.data()),
          static_cast<std::streamsize>(count * sizeof(Index)));
  for (Eigen::Vector3d& position : moved.positions) {
    in.read(reinterpret_cast<char*>(position.data()), kPositionBytes);
  }
  const bool is_ascending =
      std::ranges::adjacent_find(moved.vertices, std::greater_equal<>()) == moved.vertices.end();
  const bool is_finite = std::ranges::all_of(
      moved.positions, [](const Eigen::Vector3d& position) { return position.allFinite(); });
  if (!in || !is_ascending || !is_finite) return std::nullopt;
  return moved;
}

}  // namespace lapwing::viewer
