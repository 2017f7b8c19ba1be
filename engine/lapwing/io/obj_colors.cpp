#include "lapwing/io/obj_colors.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

namespace lapwing {

void ObjColors::add(std::size_t vertex, const Eigen::Vector4d& numbers) {
  behind_positions_.resize(vertex, kNoColor);
  behind_positions_.push_back(numbers);
}

bool ObjColors::add_comment(std::string_view comment, Tally& uneditable) {
  constexpr std::string_view kKeyword = "MRGB ";
  constexpr std::size_t kDigits = 8;
  if (!comment.starts_with(kKeyword)) return false;
  comment.remove_prefix(std::min(comment.find_first_not_of(' ', kKeyword.size()), comment.size()));
  const bool is_hexadecimal =
      comment.find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
  if (comment.size() % kDigits != 0 || !is_hexadecimal) return false;
  for (; !comment.empty(); comment.remove_prefix(kDigits)) {
    std::uint32_t word = 0;
    std::from_chars(comment.data(), comment.data() + kDigits, word, 16);
    const auto channel = [word](unsigned shift) {
      return static_cast<float>(word >> shift & 0xFFU) / 255.0F;
    };
    in_comments_.emplace_back(channel(16), channel(8), channel(0), 1.0F);
    if (word >> 24U != 0xFFU) uneditable.add("masked vertices");
  }
  return true;
}

// Four numbers after a position are either w r g b or r g b a. They are w r g b if the first of
// them is 1 at all vertices.
void ObjColors::separate_weights() {
  const auto has_four = [](const Eigen::Vector4d& color) { return !std::isnan(color[3]); };
  const bool are_weights = std::ranges::all_of(
      behind_positions_,
      [&](const Eigen::Vector4d& color) { return !has_four(color) || color[0] == 1.0; });
  if (!are_weights) return;
  for (Eigen::Vector4d& color : behind_positions_) {
    if (has_four(color)) color = Eigen::Vector4d(color[1], color[2], color[3], kNoColor[3]);
  }
}

std::vector<Eigen::Vector4f> ObjColors::finish(std::size_t vertex_count, Tally& uneditable) {
  if (!behind_positions_.empty()) {
    separate_weights();
    behind_positions_.resize(vertex_count, kNoColor);
    return unit_colors(behind_positions_);
  }
  if (in_comments_.empty()) return {};
  if (in_comments_.size() > vertex_count) {
    uneditable.add("colours (#MRGB) of vertices that do not exist",
                   in_comments_.size() - vertex_count);
  }
  in_comments_.resize(vertex_count, Eigen::Vector4f::Ones());
  return std::move(in_comments_);
}

}  // namespace lapwing
