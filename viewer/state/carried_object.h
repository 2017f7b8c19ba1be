#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "lapwing/deform/deform.h"
#include "lapwing/run/attachment_file.h"

namespace lapwing::viewer {

/// A file that follows the surface, or that followed it in an earlier step.
struct CarriedObject {
  std::shared_ptr<const AttachmentFile> opened;  ///< with the positions in the file
  std::shared_ptr<const AttachmentFile> rest;    ///< with the positions before the open step
  bool follows = true;                           ///< whether the file follows the open step

  const std::filesystem::path& file() const { return rest->file(); }
  bool operator==(const CarriedObject&) const = default;
};

/// The carried files after a step.
using CarriedFiles = std::vector<std::shared_ptr<const AttachmentFile>>;

/// Reads a file that follows the surface. It is later saved to `save`, or to its default path if
/// `save` is empty. Both paths are absolute. Throws the errors of AttachmentFile.
std::shared_ptr<const AttachmentFile> open_carried(const std::filesystem::path& file,
                                                   const std::filesystem::path& save = {});

bool any_follows(std::span<const CarriedObject> objects);

/// Returns the entries for `DeformRequest::carry`, one per object that follows the open step.
std::vector<CarrySpec> carry_specs(std::span<const CarriedObject> objects);

/// Convert carried objects to the files of a RunResult, and these files to shared files.
std::vector<AttachmentFile> carried_at_rest(std::span<const CarriedObject> objects);
CarriedFiles share(std::vector<AttachmentFile> files);

/// Returns the input of an AttachmentDeformer. The edit of `region` moved the vertices of `rest` to
/// `positions`. If `joined` is not null, `region` and `rest_stretch` refer to `joined->surface`.
Deformed deformed_of(const Mesh& rest, const JoinedSurface* joined, const EditRegion& region,
                     Positions positions, std::vector<Eigen::Matrix3d> rest_stretch);

}  // namespace lapwing::viewer
