#include "examples.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace lapwing::cli {
namespace {

struct Examples {
  std::string_view command;
  std::string_view lines;
};

constexpr std::array kExamples{
    Examples{"lapwing", R"(
  lapwing shape tube -o tube.obj
  lapwing deform tube.obj --handle box:-1,-1,5.5,1,1,7 --rotate 0,1,0,40 --save bent.obj)"},
    Examples{"lapwing shape", R"(
  lapwing shape tube -o tube.obj
  lapwing shape bumpy-plane -o bumps.ply)"},
    Examples{"lapwing deform", R"(
  lapwing shape tube -o tube.obj
  lapwing deform tube.obj --handle box:-1,-1,5.5,1,1,7 --rotate 0,1,0,40 --save bent.obj
  lapwing deform tube.obj --handle box:-1,-1,5.5,1,1,7 --translate 1,0,0 \
    --handle box:-1,-1,2.8,1,1,3.2 --translate -1,0,0 --save wave.obj)"},
    Examples{"lapwing run", R"(
  lapwing shape tube -o tube.obj
  lapwing deform tube.obj --handle box:-1,-1,5.5,1,1,7 --rotate 0,1,0,40 --recipe bend.json
  lapwing run bend.json --save bent.obj
  lapwing run bend.json --report report.json --strict)"},
    Examples{"lapwing batch", R"(
  lapwing shape tube -o tube.obj
  lapwing deform tube.obj --handle box:-1,-1,5.5,1,1,7 --rotate 0,1,0,40 --recipe bend.json
  echo '{"id": "a", "set": {"/steps/0/handles/0/move/rotate/degrees": 20}}' > jobs.jsonl
  lapwing batch jobs.jsonl --recipe bend.json -o results
  lapwing batch jobs.jsonl --recipe bend.json -o arrays --displacements float32)"},
    Examples{"lapwing keys", R"(
  lapwing keys
  lapwing keys deform)"},
    Examples{"lapwing coat", R"(
  lapwing shape tube -o tube.obj
  lapwing shape bumpy-plane -o bumps.ply
  lapwing coat tube.obj --target-patch near:0.5,0,3,0.4 --source bumps.ply \
    --source-patch near:0.5,0.5,0,0.2 --detail-size 0.1 --save coated.obj
  lapwing coat tube.obj --target-patch near:0.5,0,3,0.4 --source-patch near:0.5,0,1,0.4 \
    --detail-size 0.2 --amplitude -1 --save engraved.obj)"},
    Examples{"lapwing mix", R"(
  lapwing shape tube -o tube.obj
  lapwing mix tube.obj --target-patch near:0.5,0,3,0.4 \
    --first-patch near:0.5,0,1,0.4 --first-detail-size 0.2 \
    --second-patch near:0.5,0,5,0.4 --second-detail-size 0.2 \
    --distance-to near:0.5,0,3,0.1 --width 0.2 --save spot.obj
  lapwing mix tube.obj --target-patch near:0.5,0,3,0.4 \
    --first-patch near:0.5,0,1,0.4 --first-detail-size 0.2 \
    --second-patch near:0.5,0,5,0.4 --second-detail-size 0.2 \
    --domain square --domain-v 0.3,0.7 --save ramp.obj)"},
    Examples{"lapwing transplant", R"(
  lapwing shape tube -o tube.obj
  lapwing shape bumpy-plane -o bumps.ply
  lapwing transplant bumps.ply --target-region near:0.5,0.5,0,0.1 \
    --part-region box:-1,-1,4,1,1,7 --part tube.obj --save horn.ply
  lapwing transplant bumps.ply --target-region near:0.5,0.5,0,0.1 \
    --part-region box:-1,-1,4,1,1,7 --part tube.obj --fit-rotate 30 --save turned.ply)"},
    Examples{"lapwing peel", R"(
  lapwing shape bumpy-plane -o bumps.ply
  lapwing peel bumps.ply --detail-size 0.2 -o smooth.ply
  lapwing peel bumps.ply --detail-size 0.2 --coating height -o heights.ply)"},
    Examples{"lapwing wrap", R"(
  lapwing shape tube -o template.ply
  lapwing deform template.ply --handle near:0,0,6,1 --translate 1,0,0 --save bent.ply
  lapwing remesh bent.ply --scale 0.8 -o scan.ply
  lapwing wrap template.ply scan.ply -o wrapped.ply
  lapwing wrap template.ply scan.ply --aligned --strict -o placed.ply)"},
    Examples{"lapwing transfer", R"(
  lapwing shape tube -o rest.ply
  lapwing deform rest.ply --handle near:0,0,6,1 --rotate 0,1,0,40 --save bent.ply
  lapwing deform rest.ply --handle near:0,0,6,1 --translate 1,0,0 --save moved.ply
  lapwing subdivide rest.ply -o target.ply
  lapwing wrap target.ply rest.ply --aligned -o on-rest.ply
  lapwing transfer rest.ply bent.ply --onto target.ply --aligned -o bent-target.ply
  lapwing transfer rest.ply bent.ply moved.ply --onto target.ply \
    --correspondence on-rest.ply -o poses)"},
    Examples{"lapwing decimate", R"(
  lapwing shape bumpy-plane -o bumps.ply
  lapwing decimate bumps.ply --share 0.2 --save coarse.ply
  lapwing decimate bumps.ply --share 0.05 --recipe coarser.json --save coarser.ply)"},
    Examples{"lapwing cut", R"(
  lapwing shape tube -o tube.obj
  lapwing cut tube.obj --region near:0.5,0,3,0.4 -o patch.obj
  lapwing cut tube.obj --region box:-1,-1,4,1,1,7 -o end.obj --rest stump.obj)"},
    Examples{"lapwing parts", R"(
  lapwing shape tube -o tube.obj
  lapwing cut tube.obj --region near:0.5,0,3,0.4 -o patch.obj
  lapwing parts add library patch.obj
  lapwing parts list library)"},
    Examples{"lapwing parts list", R"(
  lapwing shape tube -o tube.obj
  lapwing parts add library tube.obj
  lapwing parts list library
  lapwing parts list library --no-pictures)"},
    Examples{"lapwing parts add", R"(
  lapwing shape tube -o tube.obj
  lapwing parts add library tube.obj
  lapwing parts add library tube.obj --name pipe --loop 1)"},
    Examples{"lapwing parts show", R"(
  lapwing shape tube -o tube.obj
  lapwing parts add library tube.obj
  lapwing parts show library tube
  lapwing parts show library tube -o tube.png)"},
    Examples{"lapwing render", R"(
  lapwing shape tube -o tube.obj
  lapwing deform tube.obj --handle box:-1,-1,5.5,1,1,7 --rotate 0,1,0,40 --save bent.obj
  lapwing render bent.obj --view right -o bent.png
  lapwing render bent.obj --rest tube.obj --color rotation -o turned.png)"},
    Examples{"lapwing check", R"(
  lapwing shape tube -o tube.obj
  lapwing check tube.obj
  lapwing check tube.obj --fix repaired.obj
  lapwing check tube.obj --fix closed.obj --fill-holes smooth)"},
    Examples{"lapwing convert", R"(
  lapwing shape tube -o tube.obj
  lapwing convert tube.obj tube.glb
  lapwing convert tube.obj tube.ply --ascii)"},
    Examples{"lapwing info", R"(
  lapwing info
  lapwing shape tube -o tube.obj
  lapwing info tube.obj)"},
    Examples{"lapwing subdivide", R"(
  lapwing shape tube -o tube.obj
  lapwing subdivide tube.obj -o finer.obj
  lapwing subdivide tube.obj --smooth --times 2 -o smoother.obj)"},
    Examples{"lapwing remesh", R"(
  lapwing shape tube -o tube.obj
  lapwing remesh tube.obj --length 0.1 -o even.obj
  lapwing remesh tube.obj --region near:0.5,0,3,0.4 --scale 0.5 -o finer.obj)"},
    Examples{"lapwing parameterize", R"(
  lapwing shape tube -o tube.obj
  lapwing parameterize tube.obj --region near:0.5,0,3,0.4 -o uvs.obj
  lapwing parameterize tube.obj --region near:0.5,0,3,0.4 --domain square --picture square.png)"},
};

void add(CLI::App& app, const std::string& command) {
  const auto* found = std::ranges::find(kExamples, command, &Examples::command);
  if (found == kExamples.end()) throw std::logic_error("no examples of `" + command + "`");
  const std::string others = app.get_footer();
  app.footer(others + (others.empty() ? "" : "\n\n") + "Examples:" + std::string(found->lines));
  for (CLI::App* sub : app.get_subcommands({})) add(*sub, command + " " + sub->get_name());
}

}  // namespace

void add_examples(CLI::App& app) {
  add(app, app.get_name());
}

}  // namespace lapwing::cli
