#include "flag_visitor.h"

#include <algorithm>
#include <cmath>

#include <CLI/CLI.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "move_flags.h"
#include "region_text.h"

namespace lapwing::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string help_of(const StepKey& key) {
  std::string help(key.help);
  if (!key.absent.empty()) help.append("; ").append(key.absent).append(" if not given");
  return help;
}

CLI::Validator in(const Range& range, bool whole) {
  return {[range, whole](const std::string& text) {
            double number = 0.0;
            const bool read = CLI::detail::lexical_cast(text, number);
            const bool fits =
                read && range.contains(number) && (!whole || number == std::floor(number));
            return fits ? "" : "expected " + range.words(whole) + ", got " + text;
          },
          ""};
}

// Returns the numbers of a vertex property of the mesh, which `lapwing peel` and other programs
// write.
std::vector<double> property(const std::string& flag, const std::string& mesh,
                             const std::string& name) {
  for (const ExtraAttribute& extra : read_mesh(mesh).attributes().vertex_extras) {
    if (extra.name == name && extra.components == 1) return extra.values;
  }
  throw InputError(flag + ": " + mesh + " has no scalar vertex property \"" + name +
                   "\"; use a PLY file that has one");
}

struct HandleFlags {
  std::string region;
  MoveFlags move;
  double falloff = 0.0;
  std::string profile = "smooth";
  std::string field;
  std::string orientation = "kept";

  void add_orientation(CLI::App& command, CLI::Option& handle) {
    command
        .add_option("--orientation", orientation,
                    "of the handle: kept as its move sets it, or free to follow the surface")
        ->check(CLI::IsMember({"kept", "free"}))
        ->capture_default_str()
        ->needs(&handle);
  }
  void add_falloff(CLI::App& command, CLI::Option& handle) {
    auto* width = command.add_option("--falloff", falloff,
                                     "length beyond the handle over which its weight fades");
    width->check(CLI::PositiveNumber)->needs(&handle);
    command.add_option("--falloff-profile", profile, "profile of the falloff")
        ->check(CLI::IsMember({"smooth", "linear"}))
        ->capture_default_str()
        ->needs(width);
    command
        .add_option("--handle-field", field,
                    "vertex property of MESH with the weight of the handle, 0 to 1")
        ->needs(&handle)
        ->excludes(width);
  }
  Json json(const std::string& mesh) const {
    Json handle{{"region", region_json("--handle", region)}, {"move", move.json()}};
    if (falloff > 0.0) handle["falloff"] = {{"width", falloff}, {"profile", profile}};
    if (!field.empty()) handle["weight"] = {{"field", property("--handle-field", mesh, field)}};
    if (orientation != "kept") handle["orientation"] = orientation;
    return handle;
  }
};

// The flags of a mix's weight.
struct WeightFlags {
  std::vector<double> domain_v;
  std::string distance_to;
  double width = 0.0;
  std::string field;

  void add_to(CLI::App& command) {
    auto* ramp = command
                     .add_option("--domain-v", domain_v,
                                 "A,B: the second source's share goes from 0 to 1 between these "
                                 "values of v in the square domain")
                     ->delimiter(',')
                     ->expected(2);
    auto* distance = command.add_option(
        "--distance-to", distance_to,
        std::string("region of the second source; its share is 0 at --width from it: ") +
            kRegionHelp);
    command.add_option("--width", width, "length, for --distance-to; 0 is a step")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str()
        ->needs(distance);
    auto* painted = command.add_option(
        "--field", field, "vertex property of MESH with the second source's share, 0 to 1");
    ramp->excludes(distance)->excludes(painted);
    distance->excludes(painted);
  }
  Json json(const std::string& mesh) const {
    if (!domain_v.empty()) return {{"domain_v", domain_v}};
    if (!field.empty()) return {{"field", property("--field", mesh, field)}};
    if (distance_to.empty()) {
      throw CLI::RequiredError("one of --domain-v, --distance-to and --field");
    }
    return {{"distance_to", region_json("--distance-to", distance_to)}, {"width", width}};
  }
};

// The flags of a part's place: fitted, or moved.
struct PlaceFlags {
  MoveFlags move;
  std::optional<double> degrees;
  std::optional<double> scale;
  bool keep_size = false;

  void add_to(CLI::App& command) {
    move.add_to(command, "the part", "the centre of its loop");
    command.add_option("--fit-rotate", degrees,
                       "fit the part to the hole, then rotate it by DEGREES about the hole's "
                       "normal");
    command
        .add_option("--fit-scale", scale,
                    "fit the part to the hole, then scale it about the hole's centre")
        ->check(CLI::PositiveNumber);
    command.add_flag("--keep-size", keep_size, "fit the part without scaling it");
  }
  Json json(bool snap) const {
    const bool fitted = degrees || scale || keep_size;
    const bool moved = move.are_given() || snap;
    if (moved && fitted) {
      throw CLI::ExcludesError("--fit-rotate, --fit-scale and --keep-size",
                               "--translate, --rotate, --scale, --pivot, --matrix and --snap");
    }
    if (moved) return move.json();
    Json fit = Json::object();
    if (degrees) fit["rotate_degrees"] = *degrees;
    if (scale) fit["scale"] = *scale;
    if (keep_size) fit["keep_size"] = true;
    return {{"auto", fit}};
  }
};

}  // namespace

std::string FlagVisitor::flag(const StepKey& key) const {
  std::string name(key.flag.empty() ? key.name : key.flag);
  std::replace(name.begin(), name.end(), '_', '-');
  return prefix_.empty() ? "--" + name : "--" + prefix_ + "-" + name;
}

CLI::Option* FlagVisitor::finish(const StepKey& key, CLI::Option* option,
                                 const std::string& fallback) {
  if (!fallback.empty()) option->default_str(fallback);
  if (scopes_.empty()) return option->required(key.required && key.flag_default.empty());
  (key.required ? scopes_.back().required : scopes_.back().others).push_back(option);
  return option;
}

void FlagVisitor::add_number(const StepKey& key, const Range& range, bool whole,
                             const std::string& fallback) {
  const auto keep = [draft = draft_, place = place_of(key), whole](const double& number) {
    draft->given.emplace_back(place,
                              whole ? Json(static_cast<std::int64_t>(number)) : Json(number));
  };
  auto* option = command_.add_option_function<double>(flag(key), keep, help_of(key));
  option->check(in(range, whole))->type_name(whole ? "INT" : "FLOAT");
  finish(key, option, key.required ? "" : fallback);
}

void FlagVisitor::number(const StepKey& key, double& value, const Range& range) {
  add_number(key, range, false, digits(value));
}

void FlagVisitor::number(const StepKey& key, std::optional<double>&, const Range& range) {
  add_number(key, range, false, key.automatic ? "auto" : "");
}

void FlagVisitor::whole(const StepKey& key, int& value, const Range& range) {
  add_number(key, range, true, std::to_string(value));
}

void FlagVisitor::whole(const StepKey& key, std::optional<std::size_t>&) {
  add_number(key, kFromZero, true, "");
}

void FlagVisitor::boolean(const StepKey& key, bool&) {
  const auto keep = [draft = draft_, place = place_of(key)] {
    draft->given.emplace_back(place, true);
  };
  finish(key, command_.add_flag_callback(flag(key), keep, help_of(key)));
}

void FlagVisitor::choose(const StepKey& key, std::size_t& chosen,
                         const std::vector<std::string_view>& names) {
  if (!key.off_flag.empty()) {
    add_off(key, names.back());
    return;
  }
  const auto keep = [draft = draft_, place = place_of(key)](const std::string& name) {
    draft->given.emplace_back(place, name);
  };
  auto* option = command_.add_option_function<std::string>(flag(key), keep, help_of(key));
  option->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
  finish(key, option, std::string(names[chosen]));
}

void FlagVisitor::add_off(const StepKey& key, Json value) {
  const std::string prefix = prefix_.empty() ? "--" : "--" + prefix_ + "-";
  const auto keep = [draft = draft_, place = place_of(key), value] {
    draft->given.emplace_back(place, value);
  };
  auto* option = command_.add_flag_callback(prefix + std::string(key.off_flag), keep,
                                            std::string(key.off_help));
  if (!scopes_.empty()) scopes_.back().off = option;
}

void FlagVisitor::add_region(const StepKey& key, const std::string& help,
                             const std::string& fallback) {
  const std::string name = flag(key);
  const auto keep = [draft = draft_, place = place_of(key), name](const std::string& text) {
    draft->given.emplace_back(place, region_json(name, text));
  };
  if (!key.flag_default.empty()) keep(std::string(key.flag_default));
  finish(key, command_.add_option_function<std::string>(name, keep, help), fallback);
}

void FlagVisitor::region(const StepKey& key, RegionSpec&) {
  add_region(key, std::string(key.help) + ": " + kRegionHelp, std::string(key.flag_default));
}

void FlagVisitor::belt(const StepKey& key, BeltSpec& value) {
  const auto* border = std::get_if<BoundaryAnchors>(&value);
  add_region(key, std::string(key.help) + ": fraction:F | " + kRegionHelp,
             border == nullptr ? "" : "fraction:" + digits(border->fraction));
}

void FlagVisitor::handles(const StepKey& key, std::vector<MovedHandle>&, HandleForm form) {
  auto flags = std::make_shared<HandleFlags>();
  auto* option = command_.add_option("--handle", flags->region,
                                     std::string("the part that you move: ") + kRegionHelp);
  flags->move.add_to(command_, "the handle", "the handle's centroid");
  if (form == HandleForm::graded) {
    flags->add_falloff(command_, *option);
    flags->add_orientation(command_, *option);
  }
  finish(key, option);
  draft_->at_end.emplace_back(
      [flags, place = place_of(key)](Json& step, const StepFlags& step_flags) {
        if (flags->region.empty()) return;
        step[place] = Json::array({flags->json(step_flags.mesh)});
      });
}

void FlagVisitor::targets(const StepKey& key, TargetSpec&) {
  auto file = std::make_shared<std::string>();
  auto hard = std::make_shared<bool>(false);
  auto* option =
      command_.add_option("--targets", *file, "a table, .csv or .npy: " + std::string(key.help));
  command_.add_flag("--hard-targets", *hard, "reach the targets exactly")->needs(option);
  draft_->at_end.emplace_back(
      [file, hard, place = place_of(key)](Json& step, const StepFlags& step_flags) {
        if (file->empty()) {
          if (!step.contains("handles")) throw CLI::RequiredError("one of --handle and --targets");
          return;
        }
        step[place]["file"] = step_flags.from_recipe(*file);
        if (*hard) step[place]["hard"] = true;
      });
}

void FlagVisitor::mirror(const StepKey& key, std::optional<MirrorSpec>&) {
  const std::string name = flag(key);
  const auto keep = [draft = draft_, place = place_of(key), name](const std::string& text) {
    draft->given.emplace_back(place, mirror_json(name, text));
  };
  finish(key, command_.add_option_function<std::string>(
                  name, keep, std::string(kMirrorHelp) + ": " + std::string(key.help)));
}

void FlagVisitor::carry(const StepKey& key, std::vector<CarrySpec>&) {
  auto files = std::make_shared<std::vector<std::string>>();
  command_.add_option(flag(key), *files, "FILE, repeated for each: " + help_of(key))
      ->type_name("FILE")
      ->expected(1)
      ->take_all();
  draft_->at_end.emplace_back([files, place = place_of(key)](Json& step, const StepFlags& flags) {
    for (const std::string& file : *files) step[place].push_back(flags.from_recipe(file));
  });
}

void FlagVisitor::pairs(const StepKey& key, std::vector<VertexPair>&) {
  auto pairs = std::make_shared<std::vector<std::vector<Index>>>();
  command_.add_option(flag(key), *pairs, "S,T: " + help_of(key))
      ->delimiter(',')
      ->type_size(2)
      ->expected(-1);
  draft_->at_end.emplace_back([pairs, place = place_of(key)](Json& step, const StepFlags&) {
    if (!pairs->empty()) step[place] = *pairs;
  });
}

void FlagVisitor::weight(const StepKey& key, MixWeight&) {
  auto flags = std::make_shared<WeightFlags>();
  flags->add_to(command_);
  draft_->at_end.emplace_back(
      [flags, place = place_of(key)](Json& step, const StepFlags& step_flags) {
        step[place] = flags->json(step_flags.mesh);
      });
}

void FlagVisitor::file(const StepKey& key, std::filesystem::path&) {
  auto path = std::make_shared<std::string>();
  // The name of a list item is the flag of its file.
  command_.add_option(prefix_.empty() ? flag(key) : "--" + prefix_, *path, help_of(key));
  draft_->at_end.emplace_back([path, place = place_of(key)](Json& step, const StepFlags& flags) {
    if (!path->empty()) step[place] = flags.from_recipe(*path);
  });
}

void FlagVisitor::part(const StepKey& key, std::filesystem::path&, std::optional<RegionSpec>&) {
  struct PartFlags {
    std::string mesh;
    std::string region;
  };
  auto part = std::make_shared<PartFlags>();
  command_.add_option("--part", part->mesh,
                      "a mesh with a boundary loop; with --part-region any mesh, by default MESH "
                      "itself");
  command_.add_option("--part-region", part->region, kRegionHelp);
  draft_->at_end.emplace_back([part, place = place_of(key)](Json& step, const StepFlags& flags) {
    Json json;
    if (!part->mesh.empty()) json["mesh"] = flags.from_recipe(part->mesh);
    if (!part->region.empty()) json["region"] = region_json("--part-region", part->region);
    if (json.empty()) throw CLI::RequiredError("--part or --part-region");
    step[place] = std::move(json);
  });
}

void FlagVisitor::place(const StepKey& key, PartPlace&, const StepKey& snap_key, bool& snap) {
  auto flags = std::make_shared<PlaceFlags>();
  flags->add_to(command_);
  boolean(snap_key, snap);
  draft_->at_end.emplace_back(
      [flags, place = place_of(key), snaps = place_of(snap_key)](Json& step, const StepFlags&) {
        step[place] = flags->json(step.contains(snaps));
      });
}

bool FlagVisitor::enter(const StepKey& key, bool&, ObjectForm, bool) {
  scopes_.emplace_back();
  if (!key.off_flag.empty()) add_off(key, false);
  path_ /= std::string(key.name);
  return true;
}

void FlagVisitor::leave() {
  path_.pop_back();
  const Scope scope = std::move(scopes_.back());
  scopes_.pop_back();
  for (CLI::Option* option : scope.others) {
    if (scope.off != nullptr) option->excludes(scope.off);
    for (CLI::Option* required : scope.required) option->needs(required);
  }
}

void FlagVisitor::begin_list(const StepKey& key, std::size_t count, const ListWords&) {
  draft_->json[place_of(key)] = std::vector<Json>(count, Json::object());
  path_ /= std::string(key.name);
}

void FlagVisitor::begin_item(std::size_t number, const ListWords& words) {
  path_ /= number;
  prefix_ = words.prefix[number];
}

void FlagVisitor::end_item() {
  path_.pop_back();
  prefix_.clear();
}

void FlagVisitor::end_list(const StepKey&) {
  path_.pop_back();
}

}  // namespace lapwing::cli
