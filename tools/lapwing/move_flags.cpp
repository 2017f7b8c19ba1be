#include "move_flags.h"

#include <utility>

#include "region_text.h"

namespace lapwing::cli {
namespace {

using Json = nlohmann::ordered_json;
using Place = Json::json_pointer;

// Sets `object[place]`. Throws CLI::ValidationError if it is already set, because `flag` was given
// twice.
void set_once(Json& object, const std::string& flag, const Place& place, Json value) {
  if (object.contains(place)) {
    throw CLI::ValidationError(flag, "is given twice for one move; put the next --handle first");
  }
  object[place] = std::move(value);
}

}  // namespace

void add_move_flags(CLI::App& command, const std::string& what, const std::string& default_pivot,
                    const std::function<Json&()>& move) {
  const auto add = [&](const std::string& flag, const char* key, const std::string& help) {
    const auto set = [=](const std::vector<double>& numbers) {
      Json value = numbers;
      if (flag == "--scale" && numbers.size() == 1) value = numbers[0];
      if (flag == "--rotate") {
        value = {{"axis", {numbers[0], numbers[1], numbers[2]}}, {"degrees", numbers[3]}};
      }
      set_once(move(), flag, Place(key), std::move(value));
    };
    return command.add_option_function<std::vector<double>>(flag, set, help)
        ->delimiter(',')
        ->trigger_on_parse();
  };
  add("--translate", "/translate", "X,Y,Z")->expected(3);
  add("--rotate", "/rotate", "AXIS_X,AXIS_Y,AXIS_Z,DEGREES")->expected(4);
  add("--scale", "/scale", "S or X,Y,Z; scale " + what + " about its pivot")->expected(1, 3);
  add("--pivot", "/pivot", "X,Y,Z; " + default_pivot + " if not given")->expected(3);
  add("--matrix", "/matrix", "12 or 16 numbers by rows, instead of the options above")
      ->expected(12, 16);
}

Json& HandleFlags::current() {
  if (handles_.empty()) handles_.push_back({{"move", Json::object()}});
  return handles_.back();
}

template <class Value>
CLI::Option* HandleFlags::add_flag(CLI::App& command, const std::string& name, const char* place,
                                   const std::string& help) {
  const auto set = [this, name, place](const Value& value) {
    set_once(current(), name, Place(place), value);
  };
  return command.add_option_function<Value>(name, set, help)->trigger_on_parse();
}

CLI::Option* HandleFlags::add_to(CLI::App& command, bool graded) {
  const auto begin = [this](const std::string& region) {
    if (current().contains("region")) handles_.push_back({{"move", Json::object()}});
    current()["region"] = region_json("--handle", region);
  };
  auto* handle = command
                     .add_option_function<std::string>(
                         "--handle", begin,
                         std::string("the part that you move; may be given several times, each "
                                     "followed by the options of its move: ") +
                             kRegionHelp)
                     ->trigger_on_parse();
  add_move_flags(command, "the handle", "the handle's centroid",
                 [this]() -> Json& { return current()["move"]; });
  if (!graded) return handle;
  add_flag<double>(command, "--falloff", "/falloff/width",
                   "length beyond the handle over which its weight fades")
      ->check(CLI::PositiveNumber);
  add_flag<std::string>(command, "--falloff-profile", "/falloff/profile", "profile of the falloff")
      ->check(CLI::IsMember({"smooth", "linear"}))
      ->default_str("smooth");
  add_flag<std::string>(command, "--handle-field", "/weight/field",
                        "vertex property of MESH with the weight of the handle, 0 to 1");
  add_flag<std::string>(command, "--orientation", "/orientation",
                        "of the handle: kept as its move sets it, or free to follow the surface")
      ->check(CLI::IsMember({"kept", "free"}))
      ->default_str("kept");
  return handle;
}

Json HandleFlags::json(const std::string& mesh) const {
  if (handles_.empty()) return {};
  Json list = Json::array();
  for (Json handle : handles_) {
    if (!handle.contains("region")) throw CLI::RequiredError("--handle");
    const bool fades = handle.contains("falloff");
    if (fades && !handle["falloff"].contains("width")) {
      throw CLI::RequiresError("--falloff-profile", "--falloff");
    }
    if (handle.contains("weight")) {
      if (fades) throw CLI::ExcludesError("--handle-field", "--falloff");
      Json& field = handle["weight"]["field"];
      field = vertex_property("--handle-field", mesh, field.get<std::string>());
    }
    list.push_back(std::move(handle));
  }
  return list;
}

void PlaceFlags::add_to(CLI::App& command) {
  add_move_flags(command, "the part", "the centre of its loop", [this]() -> Json& { return move; });
  command.add_option("--fit-rotate", degrees,
                     "fit the part to the hole, then rotate it by DEGREES about the hole's "
                     "normal");
  command
      .add_option("--fit-scale", scale,
                  "fit the part to the hole, then scale it about the hole's centre")
      ->check(CLI::PositiveNumber);
  command.add_flag("--keep-size", keep_size, "fit the part without scaling it");
}

Json PlaceFlags::json(bool snap) const {
  const bool fitted = degrees || scale || keep_size;
  const bool moved = !move.empty() || snap;
  if (moved && fitted) {
    throw CLI::ExcludesError("--fit-rotate, --fit-scale and --keep-size",
                             "--translate, --rotate, --scale, --pivot, --matrix and --snap");
  }
  if (moved) return move;
  Json fit = Json::object();
  if (degrees) fit["rotate_degrees"] = *degrees;
  if (scale) fit["scale"] = *scale;
  if (keep_size) fit["keep_size"] = true;
  return {{"auto", fit}};
}

}  // namespace lapwing::cli
