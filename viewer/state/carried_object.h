#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/deform/deform.h"
#include "lapwing/run/attachment_file.h"

namespace lapwing::viewer {

/// A file that follows the surface, or did in an earlier step.
struct CarriedObject {
  std::shared_ptr<const AttachmentFile> opened;  ///< as it was read
  std::shared_ptr<const AttachmentFile> rest;    ///< where the open step finds it
  bool follows = true;                           ///< whether it follows the open step

  const std::filesystem::path& file() const { return rest->file(); }
  bool operator==(const CarriedObject&) const = default;
};

/// Files as a step leaves them.
using CarriedFiles = std::vector<std::shared_ptr<const AttachmentFile>>;

/// Reads `file` to show and carry it. It is saved as `save`, unless that is empty. Both paths are
/// absolute. Throws what AttachmentFile throws.
std::shared_ptr<const AttachmentFile> open_carried(const std::filesystem::path& file,
                                                   const std::filesystem::path& save = {});

bool any_follows(std::span<const CarriedObject> objects);

/// Returns the objects that follow, as a deform step names them.
std::vector<CarrySpec> carry_specs(std::span<const CarriedObject> objects);

/// Converts to the files that a run has between steps, and back.
std::vector<AttachmentFile> carried_at_rest(std::span<const CarriedObject> objects);
CarriedFiles share(std::vector<AttachmentFile> files);

/// Returns the input of an AttachmentDeformer for an edit of `region` that moved the vertices of
/// `rest` to `positions`. If `joined` is not null, `region` and `rest_stretch` refer to
/// `joined->surface`.
Deformed deformed_of(const Mesh& rest, const JoinedSurface* joined, const EditRegion& region,
                     Positions positions, std::vector<Eigen::Matrix3d> rest_stretch);

}  // namespace lapwing::viewer
