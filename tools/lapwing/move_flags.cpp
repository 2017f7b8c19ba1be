#include "move_flags.h"

namespace lapwing::cli {

using Json = nlohmann::ordered_json;

void MoveFlags::add_to(CLI::App& command, const std::string& what,
                       const std::string& default_pivot) {
  command.add_option("--translate", translate, "X,Y,Z")->delimiter(',')->expected(3);
  command.add_option("--rotate", rotate, "AXIS_X,AXIS_Y,AXIS_Z,DEGREES")
      ->delimiter(',')
      ->expected(4);
  command.add_option("--scale", scale, "S or X,Y,Z; scale " + what + " about its pivot")
      ->delimiter(',')
      ->expected(1, 3);
  command.add_option("--pivot", pivot, "X,Y,Z; " + default_pivot + " if not given")
      ->delimiter(',')
      ->expected(3);
  command.add_option("--matrix", matrix, "12 or 16 numbers by rows, instead of the options above")
      ->delimiter(',')
      ->expected(12, 16);
}

bool MoveFlags::are_given() const {
  return !translate.empty() || !rotate.empty() || !pivot.empty() || !matrix.empty() ||
         !scale.empty();
}

Json MoveFlags::json() const {
  if (!matrix.empty()) return {{"matrix", matrix}};
  Json move = Json::object();
  if (!translate.empty()) move["translate"] = translate;
  if (!rotate.empty()) {
    move["rotate"] = {{"axis", Json::array({rotate[0], rotate[1], rotate[2]})},
                      {"degrees", rotate[3]}};
  }
  if (scale.size() == 1) move["scale"] = scale[0];
  if (scale.size() > 1) move["scale"] = scale;
  if (!pivot.empty()) move["pivot"] = pivot;
  return move;
}

}  // namespace lapwing::cli
