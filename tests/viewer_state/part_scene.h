#pragma once

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "run/transplant_runs.h"
#include "tools/place_tool.h"
#include "viewer_state/sphere_scene.h"

namespace lapwing::viewer::test {

/// A unit sphere in a file, and a finger that stands on z = 0, in another folder.
class SphereAndFinger {
 public:
  SphereAndFinger() {
    std::filesystem::create_directories(sphere().parent_path());
    std::filesystem::create_directories(finger().parent_path());
    write_mesh(icosphere(4), sphere());
    write_mesh(lapwing::test::finger(24, 20, 0.2, 0.5), finger());
    host.state = open_state(read_mesh(sphere()));
    host.surface = std::make_shared<const SurfaceSnap>(host.state.rest->topology().triangles,
                                                       host.state.rest->positions, "the sphere");
  }

  std::filesystem::path sphere() const { return folder_ / "targets" / "sphere.ply"; }
  std::filesystem::path finger() const { return folder_ / "parts" / "finger.ply"; }
  std::filesystem::path folder() const { return folder_.path(); }
  TransplantDraft draft() const {
    return draft_with(std::make_shared<const TransplantPart>(read_transplant_part(finger())),
                      bounds_of(host.state.rest->positions).diagonal());
  }

  TransplantHost host;

 private:
  TemporaryFolder folder_;
};

}  // namespace lapwing::viewer::test
