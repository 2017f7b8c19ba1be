#include "handle_flags.h"

#include <CLI/CLI.hpp>

#include "region_text.h"

namespace lapwing::cli {

CLI::Option* HandleFlags::add_to(CLI::App& command) {
  auto* option = command.add_option("--handle", handle, kRegionHelp);
  move.add_to(command, "the handle", "the handle's centroid");
  return option;
}

nlohmann::ordered_json HandleFlags::json() const {
  return {{"region", region_json("--handle", handle)}, {"move", move.json()}};
}

}  // namespace lapwing::cli
