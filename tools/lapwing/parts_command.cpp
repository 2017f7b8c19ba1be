#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/parts/part_library.h"
#include "lapwing/render/part_picture.h"
#include "loop_text.h"
#include "messages.h"
#include "output_files.h"

namespace lapwing::cli {
namespace {

struct PartsArguments {
  std::string folder;
  std::string mesh;
  std::string name;
  std::optional<std::size_t> loop;
  std::string picture;
  std::uint32_t side = 512;
  std::string device = "auto";
  bool no_pictures = false;
};

// Draws the pictures of parts. Opens the device for the first picture that is needed.
class Thumbnails {
 public:
  explicit Thumbnails(const PartsArguments& arguments)
      : device_(arguments.device), off_(arguments.no_pictures) {}

  void renew(const Part& part) {
    if (off_ || picture_is_current(part.mesh_path)) return;
    try {
      if (!picture_may_be_written(part.mesh_path)) {
        note(picture_path(part.mesh_path).string() +
             " was not made by Lapwing and is kept; the part has no picture");
        return;
      }
      if (!context_) context_ = std::make_shared<gpu::Context>(gpu::ContextOptions{device_});
      const Image image = part_picture(context_, part.mesh, part.loops[part.loop], kThumbnailSide);
      write_part_picture(part.mesh_path, image);
    } catch (const GpuError& error) {
      off_ = true;
      note(std::string("parts stay without pictures: ") + error.what());
    } catch (const IoError& error) {
      off_ = true;
      note(std::string("parts stay without pictures: ") + error.what());
    }
  }

 private:
  std::string device_;
  bool off_;
  std::shared_ptr<gpu::Context> context_;
};

void print(const Part& part) {
  std::printf("%s: %zu vertices, %zu faces, loop %zu of %zu: %s\n", shown(part.name).c_str(),
              part.mesh.vertex_count(), part.mesh.face_count(), part.loop, part.loops.size(),
              loop_text(part.loops[part.loop], part.mesh.positions).c_str());
}

void list(const PartsArguments& a) {
  Thumbnails thumbnails(a);
  for (const auto& file : part_files(a.folder)) {
    try {
      const Part part = read_part(file);
      print(part);
      thumbnails.renew(part);
    } catch (const InputError& error) {
      note("skipped " + file.string() + ": " + error.what());
    } catch (const IoError& error) {
      note("skipped " + file.string() + ": " + error.what());
    }
  }
}

void add(const PartsArguments& a) {
  const AddedPart added = add_part(a.folder, a.mesh, a.name, a.loop);
  print_notes(added.report);
  print(added.part);
  if (added.part.loops.size() > 1 && !a.loop) {
    note("the part has " + std::to_string(added.part.loops.size()) +
         " boundary loops and is joined at the longest; choose another with --loop");
  }
  Thumbnails(a).renew(added.part);
}

void show(const PartsArguments& a) {
  OutputFiles files;
  files.writes_picture("--output", a.picture);
  const Part part = find_part(a.folder, a.name);
  std::printf("%s\n", shown(part.mesh_path).c_str());
  print(part);
  for (std::size_t k = 0; k < part.loops.size(); ++k) {
    std::printf("  loop %zu: %s\n", k, loop_text(part.loops[k], part.mesh.positions).c_str());
  }
  if (a.picture.empty()) return;
  const auto context = std::make_shared<gpu::Context>(gpu::ContextOptions{a.device});
  write_png(a.picture, part_picture(context, part.mesh, part.loops[part.loop], a.side));
}

CLI::App* subcommand(CLI::App& parts, PartsArguments& a, const std::string& name,
                     const std::string& help) {
  auto* command = parts.add_subcommand(name, help);
  command->add_option("DIR", a.folder, "the folder of parts")->required();
  command->add_option("--device", a.device, "auto, an index or a part of a name")
      ->capture_default_str();
  return command;
}

}  // namespace

void add_parts(CLI::App& app) {
  auto* parts = app.add_subcommand("parts", "a folder of parts for transplanting, with pictures");
  parts->require_subcommand(1);
  auto a = std::make_shared<PartsArguments>();

  auto* list_command = subcommand(
      *parts, *a, "list", "the parts in a folder: meshes with a boundary loop; updates NAME.png");
  list_command->add_flag("--no-pictures", a->no_pictures, "do not draw pictures");
  list_command->callback([a] { list(*a); });

  auto* add_command = subcommand(*parts, *a, "add", "copy a mesh into the folder as a part");
  add_command->add_option("MESH", a->mesh, "OBJ, OFF, PLY, STL or glTF with a boundary loop")->required();
  add_command->add_option("--name", a->name, "name of the part; by default that of the mesh file");
  add_command->add_option("--loop", a->loop,
                          "number of the boundary loop to join; by default the longest");
  add_command->add_flag("--no-pictures", a->no_pictures, "do not draw a picture");
  add_command->callback([a] { add(*a); });

  auto* show_command = subcommand(*parts, *a, "show", "one part, and a picture of it");
  show_command->add_option("NAME", a->name, "name of the part")->required();
  show_command->add_option("-o,--output", a->picture, "PNG");
  show_command->add_option("--size", a->side, "size of the picture, in pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  show_command->callback([a] { show(*a); });
}

}  // namespace lapwing::cli
