#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "lapwing/io/reading.h"

namespace lapwing {

/// Collects the vertex colours of an OBJ file. The file stores them after the positions, or in
/// comments that ZBrush writes.
class ObjColors {
 public:
  /// Adds the numbers after the position of `vertex`: r g b, r g b a or w r g b. Missing numbers
  /// are NaN.
  void add(std::size_t vertex, const Eigen::Vector4d& numbers);
  /// Adds the colours in a comment such as "MRGB ff0080ffff000000". Each vertex has two hexadecimal
  /// digits for the mask, red, green and blue. Returns false if the comment has another form.
  bool add_comment(std::string_view comment, Tally& uneditable);

  /// Returns one colour per vertex, or an empty list if the file has no colours.
  std::vector<Eigen::Vector4f> finish(std::size_t vertex_count, Tally& uneditable);

 private:
  void separate_weights();

  std::vector<Eigen::Vector4d> behind_positions_;
  std::vector<Eigen::Vector4f> in_comments_;
};

}  // namespace lapwing
