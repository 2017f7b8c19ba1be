#include "flag_visitor.h"

#include <algorithm>
#include <cmath>

#include <CLI/CLI.hpp>

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

// The flags for the weight of a mix.
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
    if (!field.empty()) return {{"field", vertex_property("--field", mesh, field)}};
    if (distance_to.empty()) {
      throw CLI::RequiredError("one of --domain-v, --distance-to and --field");
    }
    return {{"distance_to", region_json("--distance-to", distance_to)}, {"width", width}};
  }
};

}  // namespace

std::filesystem::path StepFiles::recipe_folder() const {
  return recipe.empty() ? std::filesystem::current_path()
                        : std::filesystem::absolute(recipe).parent_path();
}

std::string StepFiles::from_recipe(const std::string& path) const {
  return std::filesystem::proximate(std::filesystem::absolute(path), recipe_folder()).string();
}

std::string FlagVisitor::flag(const StepKey& key) const {
  std::string name(key.flag.empty() ? key.name : key.flag);
  std::replace(name.begin(), name.end(), '_', '-');
  return prefix_.empty() ? "--" + name : "--" + prefix_ + "-" + name;
}

std::function<void(Json)> FlagVisitor::setter(const StepKey& key) const {
  return [draft = draft_, place = place_of(key)](Json value) {
    draft->given.emplace_back(place, std::move(value));
  };
}

void FlagVisitor::set_at_end(const StepKey& key,
                             std::function<Json(const Json&, const StepFiles&)> value) {
  draft_->at_end.emplace_back(
      [place = place_of(key), value = std::move(value)](Json& step, const StepFiles& files) {
        Json json = value(step, files);
        if (!json.is_null()) step[place] = std::move(json);
      });
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
  const auto set = [set = setter(key), whole](const double& number) {
    set(whole ? Json(static_cast<std::int64_t>(number)) : Json(number));
  };
  auto* option = command_.add_option_function<double>(flag(key), set, help_of(key));
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
  const auto set = [set = setter(key)] { set(true); };
  finish(key, command_.add_flag_callback(flag(key), set, help_of(key)));
}

void FlagVisitor::choose(const StepKey& key, std::size_t& chosen,
                         const std::vector<std::string_view>& names) {
  if (!key.off_flag.empty()) {
    add_off(key, names.back());
    return;
  }
  auto* option = command_.add_option_function<std::string>(flag(key), setter(key), help_of(key));
  option->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
  finish(key, option, std::string(names[chosen]));
}

void FlagVisitor::add_off(const StepKey& key, Json value) {
  const std::string prefix = prefix_.empty() ? "--" : "--" + prefix_ + "-";
  const auto set = [set = setter(key), value] { set(value); };
  auto* option = command_.add_flag_callback(prefix + std::string(key.off_flag), set,
                                            std::string(key.off_help));
  if (!scopes_.empty()) scopes_.back().off = option;
}

void FlagVisitor::add_region(const StepKey& key, const std::string& help,
                             const std::string& fallback) {
  const std::string name = flag(key);
  const auto set = [set = setter(key), name](const std::string& text) {
    set(region_json(name, text));
  };
  if (!key.flag_default.empty()) set(std::string(key.flag_default));
  finish(key, command_.add_option_function<std::string>(name, set, help), fallback);
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
  finish(key, flags->add_to(command_, form == HandleForm::graded));
  set_at_end(key, [flags](const Json&, const StepFiles& files) { return flags->json(files.mesh); });
}

void FlagVisitor::targets(const StepKey& key, TargetSpec&) {
  auto file = std::make_shared<std::string>();
  auto hard = std::make_shared<bool>(false);
  auto* option =
      command_.add_option("--targets", *file, "a table, .csv or .npy: " + std::string(key.help));
  command_.add_flag("--hard-targets", *hard, "reach the targets exactly")->needs(option);
  set_at_end(key, [file, hard](const Json& step, const StepFiles& files) {
    if (file->empty()) {
      if (!step.contains("handles")) throw CLI::RequiredError("one of --handle and --targets");
      return Json();
    }
    Json targets{{"file", files.from_recipe(*file)}};
    if (*hard) targets["hard"] = true;
    return targets;
  });
}

void FlagVisitor::stiffness(const StepKey& key, std::vector<StiffnessSpec>&) {
  auto parts = std::make_shared<std::vector<std::pair<std::string, std::string>>>();
  auto field = std::make_shared<std::string>();
  command_
      .add_option(
          flag(key), *parts,
          "FACTOR REGION, repeated for each part; FACTOR is a number from 0.01 to 100, or rigid: " +
              help_of(key))
      ->type_name("FACTOR REGION");
  command_.add_option(flag(key) + "-field", *field,
                      "vertex property of MESH with the factor of each vertex; inf is rigid");
  set_at_end(key, [parts, field, name = flag(key)](const Json&, const StepFiles& files) {
    Json list;
    if (!field->empty()) {
      Json factors = Json::array();
      for (const double factor : vertex_property(name + "-field", files.mesh, *field)) {
        factors.push_back(factor == kRigidStiffness ? Json("rigid") : Json(factor));
      }
      list.push_back({{"region", {{"all", true}}}, {"factor", {{"field", std::move(factors)}}}});
    }
    for (const auto& [factor, region] : *parts) {
      double number = 0.0;
      const bool is_number = CLI::detail::lexical_cast(factor, number);
      list.push_back({{"region", region_json(name, region)},
                      {"factor", is_number ? Json(number) : Json(factor)}});
    }
    return list;
  });
}

void FlagVisitor::mirror(const StepKey& key, std::optional<MirrorSpec>&) {
  const std::string name = flag(key);
  const auto set = [set = setter(key), name](const std::string& text) {
    set(mirror_json(name, text));
  };
  finish(key, command_.add_option_function<std::string>(
                  name, set, std::string(kMirrorHelp) + ": " + std::string(key.help)));
}

void FlagVisitor::carry(const StepKey& key, std::vector<CarrySpec>&) {
  auto carried = std::make_shared<std::vector<std::string>>();
  command_.add_option(flag(key), *carried, "FILE, repeated for each: " + help_of(key))
      ->type_name("FILE")
      ->expected(1)
      ->take_all();
  set_at_end(key, [carried](const Json&, const StepFiles& files) {
    Json list;
    for (const std::string& file : *carried) list.push_back(files.from_recipe(file));
    return list;
  });
}

void FlagVisitor::pairs(const StepKey& key, std::vector<VertexPair>&) {
  auto pairs = std::make_shared<std::vector<std::vector<Index>>>();
  command_.add_option(flag(key), *pairs, "S,T: " + help_of(key))
      ->delimiter(',')
      ->type_size(2)
      ->expected(-1);
  set_at_end(key, [pairs](const Json&, const StepFiles&) {
    return pairs->empty() ? Json() : Json(*pairs);
  });
}

void FlagVisitor::weight(const StepKey& key, MixWeight&) {
  auto flags = std::make_shared<WeightFlags>();
  flags->add_to(command_);
  set_at_end(key, [flags](const Json&, const StepFiles& files) { return flags->json(files.mesh); });
}

void FlagVisitor::file(const StepKey& key, std::filesystem::path&) {
  auto path = std::make_shared<std::string>();
  // In a list such as the sources of a mix, the flag of the file is the name of the item.
  command_.add_option(prefix_.empty() ? flag(key) : "--" + prefix_, *path, help_of(key));
  set_at_end(key, [path](const Json&, const StepFiles& files) {
    return path->empty() ? Json() : Json(files.from_recipe(*path));
  });
}

void FlagVisitor::part(const StepKey& key, std::filesystem::path&, std::optional<RegionSpec>&) {
  auto mesh = std::make_shared<std::string>();
  auto region = std::make_shared<std::string>();
  command_.add_option("--part", *mesh,
                      "a mesh with a boundary loop; with --part-region any mesh, by default MESH "
                      "itself");
  command_.add_option("--part-region", *region, kRegionHelp);
  set_at_end(key, [mesh, region](const Json&, const StepFiles& files) {
    Json part;
    if (!mesh->empty()) part["mesh"] = files.from_recipe(*mesh);
    if (!region->empty()) part["region"] = region_json("--part-region", *region);
    if (part.empty()) throw CLI::RequiredError("--part or --part-region");
    return part;
  });
}

void FlagVisitor::place(const StepKey& key, PartPlace&, const StepKey& snap_key, bool& snap) {
  auto flags = std::make_shared<PlaceFlags>();
  flags->add_to(command_);
  boolean(snap_key, snap);
  set_at_end(key, [flags, snap_place = place_of(snap_key)](const Json& step, const StepFiles&) {
    return flags->json(step.contains(snap_place));
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
