#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/report.h"
#include "report/svg.h"

namespace lapwing::bench {

/// Which lines a scaling plot has.
enum class Lines {
  preparation,  ///< our stages of reading and of preparing an edit
  waits,        ///< what else of ours a user waits for
  kernels       ///< our stages "kernel ..."
};

/// Median times over numbers of vertices, both logarithmic, a line for every stage that was
/// measured on `device`, each with its name and growth at its end; error bars reach from one
/// quartile to the other. Nothing where no line has two sizes.
std::optional<Svg> scaling_plot(const Report& report, const std::string& device, Lines lines,
                                double width);

/// The same for each stage that others did too: our line, and theirs, dashed, whatever they ran on.
std::vector<Svg> peer_plots(const Report& report, const std::string& device, double width);

/// What share of the preparation each stage is, a bar for every mesh and size, with times inside.
/// Stages that were not measured on `device` are those of the processor. Nothing where `device` has
/// none of them.
std::optional<Svg> stages_plot(const Report& report, const std::string& device, double width);

/// Our times over our peers', logarithmic about 1: a bar for the largest mesh that both did, marks
/// for the smaller ones. Nothing without peers.
std::optional<Svg> ratios_plot(const Report& report, double width);

/// What share of its device's limit each stage reaches, the highest first: a bar for the largest
/// mesh, marks for the smaller ones. Nothing where no share is known.
std::optional<Svg> limits_plot(const Report& report, double width);

}  // namespace lapwing::bench
