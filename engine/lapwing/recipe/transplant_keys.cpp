#include "lapwing/recipe/key_visitor.h"
#include "lapwing/recipe/step.h"

namespace lapwing {

void describe(TransplantParameters& parameters, KeyVisitor& visitor) {
  visitor.object({.name = "transition",
                  .help = "the detail blends from the host's to the part's within this geodesic "
                          "distance of the part's loop; a narrow transition is sharp, a wide one "
                          "soft",
                  .absent = "half the hole's radius or the largest that fits, smooth"},
                 parameters.transition, ObjectForm::optional);
  visitor.group({.name = "belt",
                 .help = "beyond the transition, on both sides, vertices are free over `padding` "
                         "and held over `width`; farther away no bit changes",
                 .absent = "half and a quarter of the transition"},
                parameters.padding || parameters.belt, [&](KeyVisitor& inside) {
                  inside.number({.name = "padding",
                                 .help = "width of the free zone beyond the transition",
                                 .absent = "half the transition"},
                                parameters.padding, kFromZero);
                  inside.number({.name = "width",
                                 .help = "width of the held zone beyond the padding",
                                 .absent = "a quarter of the transition",
                                 .flag = "belt"},
                                parameters.belt, kAboveZero);
                });
  describe(parameters.weights, visitor);
  visitor.choice(
      {.name = "sampling", .help = "how the Laplacians of the replaced region are sampled"},
      parameters.sampling,
      {{MappedSampling::one_ring, "one_ring"}, {MappedSampling::linear, "linear"}});
  visitor.choice({.name = "remesh",
                  .help = "make the triangles between the loops and over the transition uniform if "
                          "the meshes' scales differ or the strip is wide; `none` keeps the part's "
                          "triangles and the strip",
                  .off_flag = "no-remesh",
                  .off_help = "keep the triangles around the seam, however uneven they are"},
                 parameters.remesh, {{Remeshing::automatic, "auto"}, {Remeshing::none, "none"}});
}

void describe(TransplantStep& step, KeyVisitor& visitor) {
  visitor.where(step.where);
  visitor.part(
      {.name = "part",
       .help = "a mesh with a boundary loop, or a region cut from a mesh; without `mesh`, from "
               "the mesh itself",
       .required = true},
      step.part, step.part_region);
  visitor.whole({.name = "loop",
                 .help = "the boundary loop to join; loops are numbered by their smallest vertices",
                 .absent = "the longest"},
                step.loop);
  visitor.place({.name = "place",
                 .help = "`auto` fits the part's loop to the hole, rotated by `rotate_degrees` "
                         "about the hole's normal and scaled by `scale`, or not scaled with "
                         "`keep_size`. A move, as in deform, starts from the part's position in "
                         "its file; its pivot is the centre of the loop"},
                step.place,
                {.name = "snap",
                 .help = "after a move, bring the loop onto the surface by the smallest motion"},
                step.snap);
  visitor.region({.name = "target_region",
                  .help = "the region that is replaced; its boundary must be one loop",
                  .required = true},
                 step.target_region);
  describe(step.parameters, visitor);
}

}  // namespace lapwing
