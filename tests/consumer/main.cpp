// Lifts the middle of a generated sheet, with no file opened.
#include <cstdio>
#include <lapwing/lapwing.h>
#include <lapwing/mesh/shapes.h>

int main() {
  using namespace lapwing;
  const Mesh sheet = grid(10, 10);
  DeformRequest lift;
  lift.roi = {AllVertices{}};
  lift.handles = {{{ListedVertices{{60}}}, SimilarityMove{.translate = {0.0, 0.0, 0.3}}}};
  lift.parameters.hard = true;
  const Deformed lifted = deform(sheet, lift);
  for (const std::string& warning : lifted.warnings) std::printf("%s\n", warning.c_str());
  const Positions& p = lifted.mesh.positions;
  std::printf("middle at %.3f\n", p[60].z());
  return p[60].z() == 0.3 && p[0].z() == 0.0 ? 0 : 1;
}
