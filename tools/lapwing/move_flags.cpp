#include "move_flags.h"

#include <CLI/CLI.hpp>

#include "region_text.h"

namespace lapwing::cli {
namespace {

using Json = nlohmann::ordered_json;

Json move_json(const MoveFlags& a) {
  if (!a.matrix.empty()) return {{"matrix", a.matrix}};
  Json move = Json::object();
  if (!a.translate.empty()) move["translate"] = a.translate;
  if (!a.rotate.empty()) {
    move["rotate"] = {{"axis", Json::array({a.rotate[0], a.rotate[1], a.rotate[2]})},
                      {"degrees", a.rotate[3]}};
  }
  if (a.scale != 1.0) move["scale"] = a.scale;
  if (!a.pivot.empty()) move["pivot"] = a.pivot;
  return move;
}

}  // namespace

CLI::Option* MoveFlags::add_to(CLI::App& command) {
  auto* option = command.add_option("--handle", handle, kRegionHelp);
  command.add_option("--translate", translate, "X,Y,Z")->delimiter(',')->expected(3);
  command.add_option("--rotate", rotate, "AXIS_X,AXIS_Y,AXIS_Z,DEGREES")
      ->delimiter(',')
      ->expected(4);
  command.add_option("--scale", scale, "of the handle about its pivot");
  command.add_option("--pivot", pivot, "X,Y,Z; the handle's centroid if not given")
      ->delimiter(',')
      ->expected(3);
  command.add_option("--matrix", matrix, "12 or 16 numbers by rows, in place of the above")
      ->delimiter(',')
      ->expected(12, 16);
  return option;
}

Json MoveFlags::json() const {
  return {{"region", region_json("--handle", handle)}, {"move", move_json(*this)}};
}

}  // namespace lapwing::cli
