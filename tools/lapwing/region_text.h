#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "lapwing/deform/modifiers/mirror.h"
#include "lapwing/region/region_spec.h"

namespace lapwing::cli {

/// Converts a region after a flag to the JSON of a recipe. The text is one of
///     all | 3,17,256 | disk:VERTEX,RADIUS | near:X,Y,Z,RADIUS | box:X,Y,Z,X,Y,Z | fraction:F
/// or JSON. Throws a CLI::ValidationError that names `flag`.
nlohmann::ordered_json region_json(const std::string& flag, const std::string& text);

/// Converts a region after a flag, as `region_json` does, to a RegionSpec.
RegionSpec region_spec(const std::string& flag, const std::string& text);

/// The forms of a region, for the help text of a flag.
inline constexpr const char* kRegionHelp =
    "all | 3,17,256 | disk:VERTEX,RADIUS | near:X,Y,Z,RADIUS | box:X,Y,Z,X,Y,Z | recipe JSON";

/// Converts a mirror plane after a flag to the JSON of a recipe. The text is one of
///     auto | x | y | z | POINT_X,Y,Z,NORMAL_X,Y,Z
/// Throws a CLI::ValidationError that names `flag`.
nlohmann::ordered_json mirror_json(const std::string& flag, const std::string& text);

/// Converts the argument of a mirror flag to a MirrorSpec, as `mirror_json` does.
MirrorSpec mirror_spec(const std::string& flag, const std::string& text);

inline constexpr const char* kMirrorHelp = "auto | x | y | z | POINT_X,Y,Z,NORMAL_X,Y,Z";

/// Returns the values of the vertex property `name` in the file `mesh`. `lapwing peel` and other
/// programs write vertex properties. If the file does not contain the property, throws an
/// InputError that names `flag`.
std::vector<double> vertex_property(const std::string& flag, const std::string& mesh,
                                    const std::string& name);

}  // namespace lapwing::cli
