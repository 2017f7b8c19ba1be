#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// Carries the loose parts of a region along: each moves rigidly, by the motion that fits the
/// surface at its contacts best (weighted least squares of points; Kabsch 1976), and grows with the
/// scale asked of the surface there. Contacts are where the rest of the mesh is nearest to the
/// part: the closest points of its vertices, counting less the farther they are, to none at
/// kContactBand of the part's size farther than the nearest. What belt or handle hold of the part
/// counts much more.
class LooseParts {
 public:
  LooseParts() = default;  ///< none
  /// Finds the contacts, O(m log m) in the triangles. `region` and `rest` must outlive the object.
  LooseParts(const EditRegion& region, std::span<const Eigen::Vector3d> rest,
             const Topology& topology);

  bool empty() const { return parts_.empty(); }

  /// Displaces the parts with the surface, which is displaced by `u` over the whole mesh; their
  /// anchors are asked to go by `wanted`. `scales` are the mean scales of the S_i,
  /// per vertex of the mesh; none for 1.
  /// Where nothing moves the bits are kept.
  void carry(std::span<const Eigen::Vector3d> wanted, std::span<const double> scales,
             std::span<Eigen::Vector3d> u) const;

  /// The same to first order, so that columns of a response can be carried; `growth` is the
  /// scale less 1.
  void carry_linear(std::span<const Eigen::Vector3d> wanted, std::span<const double> growth,
                    std::span<Eigen::Vector3d> u) const;

  /// Without turning: by the mean displacement at the contacts.
  void carry_straight(std::span<const Eigen::Vector3d> wanted, std::span<Eigen::Vector3d> u) const;

 private:
  // A vertex whose displacement tells how a part moves.
  struct Guide {
    Index vertex = 0;
    bool is_anchor = false;
    double weight = 0.0;  ///< those of a part sum to 1
  };
  struct Part {
    const VertexSet* vertices = nullptr;
    std::vector<Guide> guides;
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the guides
  };
  // Where the guides of a part go.
  struct Lead {
    std::vector<Eigen::Vector3d> displacements;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  };

  static Lead lead(const Part& part, std::span<const Eigen::Vector3d> wanted,
                   std::span<const Eigen::Vector3d> u);

  std::span<const Eigen::Vector3d> rest_;
  std::vector<Part> parts_;
};

inline constexpr double kContactBand = 0.1;

}  // namespace lapwing
