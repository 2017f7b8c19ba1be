#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

/// Moves the loose parts of a region with the surface. Each part moves by the rigid motion that
/// best fits its contacts (weighted least squares; Kabsch 1976). It also scales with the prescribed
/// stretch at the contacts. The contact of a vertex of the part is the closest point on the rest of
/// the mesh. The weight of a contact decreases with its distance. The weight is 0 if the distance
/// exceeds that of the nearest contact by more than kContactBand times the part's size. Vertices of
/// the part that are in the belt or in handles have a much larger weight.
class LooseParts {
 public:
  LooseParts() = default;  ///< no loose parts
  /// Finds the contacts, in O(m log m) for m triangles. `region` and `rest` must outlive the
  /// object.
  LooseParts(const EditRegion& region, std::span<const Eigen::Vector3d> rest,
             const Topology& topology);

  bool empty() const { return parts_.empty(); }

  /// Sets the displacements of the loose parts in `u`, so that they follow the surface. All lists
  /// are per vertex of the mesh. `prescribed` contains the displacements of anchors. `scales`
  /// contains the mean scale of each S_i; it is empty if all scales are 1. Displacements of parts
  /// that do not move are exactly 0.
  void carry(std::span<const Eigen::Vector3d> prescribed, std::span<const double> scales,
             std::span<Eigen::Vector3d> u) const;

  /// Like `carry`, but to first order, for the columns of a linear response. `growth` is the scale
  /// minus 1.
  void carry_linear(std::span<const Eigen::Vector3d> prescribed, std::span<const double> growth,
                    std::span<Eigen::Vector3d> u) const;

  /// Translates each part by the mean displacement at its contacts.
  void carry_straight(std::span<const Eigen::Vector3d> prescribed,
                      std::span<Eigen::Vector3d> u) const;

 private:
  // A vertex whose displacement determines the motion of a part.
  struct Guide {
    Index vertex = 0;
    bool is_anchor = false;
    double weight = 0.0;  ///< the weights of a part sum to 1
  };
  struct Part {
    const VertexSet* vertices = nullptr;
    std::vector<Guide> guides;
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the guides
  };
  // The motion of a part's guides.
  struct Lead {
    std::vector<Eigen::Vector3d> displacements;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  };

  static Lead lead(const Part& part, std::span<const Eigen::Vector3d> prescribed,
                   std::span<const Eigen::Vector3d> u);

  std::span<const Eigen::Vector3d> rest_;
  std::vector<Part> parts_;
};

inline constexpr double kContactBand = 0.1;

}  // namespace lapwing
