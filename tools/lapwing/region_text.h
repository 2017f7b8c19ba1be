#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "lapwing/region/region_spec.h"

namespace lapwing::cli {

/// Returns the recipe's JSON for a region written after a flag:
///     all | 3,17,256 | disk:VERTEX,RADIUS | near:X,Y,Z,RADIUS | box:X,Y,Z,X,Y,Z | fraction:F
/// or JSON itself. Throws CLI::ValidationError naming `flag`.
nlohmann::ordered_json region_json(const std::string& flag, const std::string& text);

/// The same as a RegionSpec.
RegionSpec region_spec(const std::string& flag, const std::string& text);

/// Help text of such a flag.
inline constexpr const char* kRegionHelp =
    "all | 3,17,256 | disk:VERTEX,RADIUS | near:X,Y,Z,RADIUS | box:X,Y,Z,X,Y,Z | recipe JSON";

/// Returns the recipe's JSON for a mirror plane: auto | x | y | z | POINT_X,Y,Z,NORMAL_X,Y,Z.
/// Throws CLI::ValidationError naming `flag`.
nlohmann::ordered_json mirror_json(const std::string& flag, const std::string& text);

inline constexpr const char* kMirrorHelp = "auto | x | y | z | POINT_X,Y,Z,NORMAL_X,Y,Z";

/// Returns the values of the vertex property `name` of the file `mesh`. `lapwing peel` and other
/// programs write such properties. If the file lacks the property, throws an InputError that names
/// `flag`.
std::vector<double> vertex_property(const std::string& flag, const std::string& mesh,
                                    const std::string& name);

}  // namespace lapwing::cli
