#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/deform/deform.h"
#include "lapwing/step/carried_file.h"

namespace lapwing::viewer {

/// A file that follows the surface, or did in an earlier step.
struct CarriedObject {
  std::shared_ptr<const CarriedFile> opened;  ///< as it was read
  std::shared_ptr<const CarriedFile> rest;    ///< where the open step finds it
  bool follows = true;                        ///< the open step takes it along; else it stays

  const std::filesystem::path& file() const { return rest->file(); }
  bool operator==(const CarriedObject&) const = default;
};

/// Files as some step leaves them.
using CarriedFiles = std::vector<std::shared_ptr<const CarriedFile>>;

/// Reads `file`, to be shown and carried, and saved as `save` unless that is empty; both are
/// absolute. Throws what CarriedFile does.
std::shared_ptr<const CarriedFile> open_carried(const std::filesystem::path& file,
                                                const std::filesystem::path& save = {});

bool any_follows(std::span<const CarriedObject> objects);

/// Those that follow as a deform step names them.
std::vector<CarrySpec> carry_specs(std::span<const CarriedObject> objects);

/// As a run has them between steps, and back.
std::vector<CarriedFile> carried_at_rest(std::span<const CarriedObject> objects);
CarriedFiles share(std::vector<CarriedFile> files);

/// As much of what `deform` makes of `rest` as a SurfaceCarrier asks for, where an edit of `region`
/// put the vertices at `positions` and its handles ask for these scales. With `joined` region and
/// scales are those of the surface that `rest` is with its seams joined.
Deformed deformed_of(const Mesh& rest, const JoinedSurface* joined, const EditRegion& region,
                     Positions positions, std::vector<Eigen::Matrix3d> rest_stretch);

}  // namespace lapwing::viewer
