#include "state/carried_object.h"

#include <algorithm>

#include "lapwing/deform/modifiers/joined_request.h"

namespace lapwing::viewer {

std::shared_ptr<const AttachmentFile> open_carried(const std::filesystem::path& file,
                                                   const std::filesystem::path& save) {
  auto opened = std::make_shared<AttachmentFile>(file);
  opened->save = save;
  // Compute the topology while the user waits. This throws if a face refers to a missing vertex.
  if (opened->mesh() != nullptr) opened->mesh()->topology();
  return opened;
}

bool any_follows(std::span<const CarriedObject> objects) {
  return std::ranges::any_of(objects, &CarriedObject::follows);
}

std::vector<CarrySpec> carry_specs(std::span<const CarriedObject> objects) {
  std::vector<CarrySpec> specs;
  for (const CarriedObject& object : objects) {
    if (object.follows) specs.push_back({object.file(), object.rest->save});
  }
  return specs;
}

std::vector<AttachmentFile> carried_at_rest(std::span<const CarriedObject> objects) {
  std::vector<AttachmentFile> files;
  for (const CarriedObject& object : objects) files.push_back(*object.rest);
  return files;
}

CarriedFiles share(std::vector<AttachmentFile> files) {
  CarriedFiles shared;
  for (AttachmentFile& file : files) {
    shared.push_back(std::make_shared<const AttachmentFile>(std::move(file)));
  }
  return shared;
}

Deformed deformed_of(const Mesh& rest, const JoinedSurface* joined, const EditRegion& region,
                     Positions positions, std::vector<Eigen::Matrix3d> rest_stretch) {
  Deformed deformed;
  deformed.mesh = rest;
  deformed.mesh.positions = std::move(positions);
  deformed.region = region;
  deformed.rest_stretch = std::move(rest_stretch);
  if (joined != nullptr) give_back_seams(*joined, rest, "deform", deformed);
  return deformed;
}

}  // namespace lapwing::viewer
