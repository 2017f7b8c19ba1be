#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/doctor/format.h"
#include "lapwing/gpu/devices.h"
#include "lapwing/io/mesh_file.h"
#include "messages.h"

namespace lapwing::cli {
namespace {

void print_devices() {
  std::printf("devices (for --device)\n");
  std::printf("  %-5s %s, %u threads, float64\n", "cpu", "the CPU, without Vulkan", thread_count());
  try {
    for (const gpu::DeviceDescription& d : gpu::list_devices()) {
      std::printf("  %-5zu %s, %s, Vulkan %s, %s%s\n", d.index, printable(d.name).c_str(),
                  d.type.c_str(), d.api_version.c_str(), printable(d.driver).c_str(),
                  d.float64 ? ", float64" : ", float32");
      if (!d.rejected.empty()) std::printf("        not usable: %s\n", d.rejected.c_str());
    }
  } catch (const GpuError& error) {
    std::printf("  no Vulkan device: %s\n", error.what());
  }
}

}  // namespace

void add_info(CLI::App& app) {
  auto* command = app.add_subcommand("info", "the devices that can run an edit, and a mesh's size");
  auto mesh = std::make_shared<std::string>();
  command->add_option("MESH", *mesh, "OBJ, OFF, PLY, STL or glTF");
  command->callback([mesh] {
    std::printf("lapwing %s\n", LAPWING_VERSION);
    print_devices();
    if (mesh->empty()) return;
    const Mesh loaded = read_mesh(*mesh);
    std::printf("%s\n%s", shown(*mesh).c_str(), format(check(loaded).statistics).c_str());
  });
}

}  // namespace lapwing::cli
