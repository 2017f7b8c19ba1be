#include "lapwing/recipe/key_visitor.h"
#include "lapwing/recipe/step.h"

namespace lapwing {

void describe(RemeshRequest& step, KeyVisitor& visitor) {
  visitor.where(step.where);
  visitor.region({.name = "region",
                  .help = "the region whose triangles are replaced; its boundary stays fixed",
                  .required = true,
                  .flag_default = "all"},
                 step.region);
  visitor.number({.name = "length",
                  .help = "the edge length of the new triangles",
                  .absent = "`scale` is used"},
                 step.length, kAboveZero);
  visitor.number({.name = "scale",
                  .help = "the edge length, in mean edge lengths of the region",
                  .flag = "scale"},
                 step.scale,
                 {.least = 0.0, .takes_least = false, .slider_from = 0.1, .slider_to = 10.0});
  visitor.whole({.name = "iterations", .help = "number of passes over the region"},
                step.options.iterations, {.least = 1.0, .most = 100.0});
  visitor.number({.name = "feature_degrees",
                  .help = "edges whose faces meet at more than this angle are kept"},
                 step.options.feature_angle_degrees,
                 {.least = 0.0, .most = 180.0, .slider_to = 180.0});
}

void describe(DecimateRequest& step, KeyVisitor& visitor) {
  visitor.where(step.where);
  visitor.number(
      {.name = "share", .help = "the approximate fraction of the vertices that are kept"},
      step.share,
      {.least = 0.0, .most = 1.0, .takes_least = false, .slider_from = 0.01, .slider_to = 1.0});
}

void describe(SubdivideRequest& step, KeyVisitor& visitor) {
  visitor.where(step.where);
  visitor.whole({.name = "times", .help = "how many times each triangle is cut into four"},
                step.times, {.least = 1.0, .most = 8.0, .slider_to = 4.0});
  visitor.boolean(
      {.name = "smooth",
       .help = "smooth the shape by Loop's scheme; otherwise the shape does not change"},
      step.smooth);
}

void describe(FillRequest& step, KeyVisitor& visitor) {
  visitor.where(step.where);
  visitor.region({.name = "region",
                  .help = "holes without a rim vertex in this region stay open",
                  .required = true,
                  .flag_default = "all"},
                 step.region);
  visitor.choice({.name = "shape",
                  .help = "`flat` adds triangles between the rim's vertices; `smooth` also adds "
                          "vertices, and continues the surrounding surface"},
                 step.shape, {{FillShape::flat, "flat"}, {FillShape::smooth, "smooth"}});
  visitor.whole({.name = "largest",
                 .help = "holes with more rim vertices than this stay open; 0 for no limit"},
                step.largest, kFromZero);
  visitor.boolean({.name = "borders",
                   .help = "also fill the borders of open sheets: the longest loop of each part "
                           "that is flatter than a hemisphere"},
                  step.borders);
}

void describe(WrapStep& step, KeyVisitor& visitor) {
  visitor.file({.name = "scan", .help = "the mesh to cover", .required = true}, step.scan);
  visitor.landmarks(
      {.name = "landmarks",
       .help = "points of the template and the corresponding points of the scan: rows of vertex, "
               "x, y, z, or of px, py, pz, x, y, z for the point of the template closest to p; a "
               "weight may follow. A file contains such rows, or the points of one surface",
       .absent = "none"},
      step.landmarks);
  visitor.boolean({.name = "hard",
                   .help = "landmarks are reached exactly; otherwise in the least-squares sense"},
                  step.hard);
  visitor.boolean(
      {.name = "aligned", .help = "the template is already in place; do not align it first"},
      step.aligned);
  visitor.stiffness(
      {.name = "stiffness",
       .help = "parts of the template that are stiffer or softer than the rest, as in "
               "a deform step",
       .absent = "none"},
      step.stiffness);
  visitor.mirror({.name = "mirror",
                  .help = "the plane in which the template is symmetric, as in a deform step; the "
                          "result is symmetric, too",
                  .absent = "none"},
                 step.mirror);
  visitor.boolean({.name = "detail",
                   .help = "at the end, move each vertex that has a counterpart exactly onto the "
                           "scan"},
                  step.detail);
}

}  // namespace lapwing
