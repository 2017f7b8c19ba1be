#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "lapwing/base/errors.h"
#include "navigation/keymap.h"
#include "preferences/preferences.h"
#include "ui/viewer_app.h"
#include "window/main_loop.h"
#include "window/window.h"

namespace lapwing::viewer {
namespace {

// As the command line's.
enum ExitCode : int { kDone = 0, kUsage = 2, kInput = 3, kSolver = 4, kDevice = 5, kFile = 6 };

struct Arguments {
  std::string file;
  std::vector<std::string> carry;
  std::string device = "auto";
  std::string screenshot;
  std::string size;
};

std::optional<VkExtent2D> parse_size(const std::string& text) {
  if (text.empty()) return {};
  VkExtent2D size{};
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    if (height.ec == std::errc() && height.ptr == end) return size;
  }
  throw CLI::ValidationError("--size", "expected WIDTHxHEIGHT, as in 1280x960, got " + text);
}

void show(const Arguments& arguments) {
  const auto size = parse_size(arguments.size);
  // A picture that is ordered does not depend on who orders it.
  const bool is_order = !arguments.screenshot.empty();
  KeptFiles kept{.journals = journal_folder()};
  if (!is_order) {
    kept.preferences = preferences_file();
    kept.recent = recent_files_path();
  }
  const Preferences preferences = read_preferences(kept.preferences).preferences;
  Window window("Lapwing", preferences.window_width, preferences.window_height);
  window.exit_when_display_goes(kDevice);
  WindowGraphics graphics(window, arguments.device);
  auto context = graphics.open_device();
  ViewerApp app(context, std::move(kept));
  if (!arguments.file.empty()) {
    app.open(arguments.file, {arguments.carry.begin(), arguments.carry.end()});
  }
  if (is_order) {
    app.order({arguments.screenshot, size});
  } else {
    app.offer_interrupted();
  }
  try {
    run_main_loop(window, graphics, std::move(context), app);
  } catch (const GpuError& error) {
    if (is_order) throw;
    throw GpuError(std::string(error.what()) +
                   "; your edit is kept, and the next start offers to restore it");
  }
}

int fail(const std::exception& error, ExitCode code) {
  std::fprintf(stderr, "lapwing-viewer: %s\n", error.what());
  return code;
}

int run(CLI::App& parser, int argc, char** argv) {
  try {
    parser.parse(argc, argv);
    return kDone;
  } catch (const CLI::ParseError& error) {
    return parser.exit(error) == 0 ? kDone : kUsage;
  } catch (const WindowError& error) {
    return fail(error, kDevice);
  } catch (const GpuError& error) {
    return fail(error, kDevice);
  } catch (const SolverError& error) {
    return fail(error, kSolver);
  } catch (const InputError& error) {
    return fail(error, kInput);
  } catch (const Error& error) {
    return fail(error, kFile);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(error, kFile);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "lapwing-viewer: out of memory; open a smaller mesh\n");
    return kSolver;
  }
}

}  // namespace
}  // namespace lapwing::viewer

int main(int argc, char** argv) {
  using namespace lapwing::viewer;
  CLI::App parser("Shows a mesh, or the result of a recipe, in a window.", "lapwing-viewer");
  parser.set_version_flag("--version", LAPWING_VERSION);
  parser.footer(
      "Exit codes: 0 done, 2 usage, 3 mesh or recipe, 4 solver, 5 display or device, 6 file.");
  Arguments arguments;
  bool list_controls = false;
  auto* file =
      parser.add_option("FILE", arguments.file, "OBJ, OFF, PLY, STL, glTF or a recipe (.json)");
  parser
      .add_option("--carry", arguments.carry,
                  "FILE: a mesh, point cloud or table of points that follows the surface; repeat "
                  "the option for more files")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->needs(file);
  parser
      .add_option("--device", arguments.device, "auto, an index or a part of a name (lapwing info)")
      ->capture_default_str();
  auto* screenshot = parser.add_option("--screenshot", arguments.screenshot,
                                       "save a picture (PNG) after the first frame, and quit");
  parser
      .add_option("--size", arguments.size, "WIDTHxHEIGHT of the picture; the window's by default")
      ->needs(screenshot);
  parser.add_flag("--controls", list_controls,
                  "print the mouse and keyboard controls as a Markdown table, and quit");
  parser.callback([&] {
    if (list_controls) {
      std::fputs(controls_table().c_str(), stdout);
    } else {
      show(arguments);
    }
  });
  return run(parser, argc, argv);
}
