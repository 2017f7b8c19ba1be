# Functions that run recipes and draw images, for tools/classics, tools/coats and tools/transplants.

# begin NAME ARGUMENTS...: sets `lapwing` ($LAPWING, or the program in build/release), `out` (the
# output folder build/NAME), `models` (the folder of models) and `arguments` (for `lapwing run`).

begin() {
  cd "$(dirname "${BASH_SOURCE[0]}")/../.."
  lapwing=${LAPWING:-build/release/bin/lapwing}
  [ -x "$lapwing" ] || { echo "There is no $lapwing; build it as tools/demo does." >&2; exit 1; }
  models=build/models/cgal/meshes
  out=build/$1
  arguments=("${@:2}")
  mkdir -p "$out"
}

need_models() {
  [ -d "$models" ] || { echo "No $models: tools/setup/fetch-models build/models cgal." >&2; exit 1; }
}

# run_recipe RECIPE [options of lapwing run]: runs tools/recipes/RECIPE.json and writes its report.
run_recipe() {
  echo "== $1"
  "$lapwing" run "tools/recipes/$1.json" --report "$out/$1.json" "${@:2}" "${arguments[@]}"
}

# picture MESH NAME [options of lapwing render]: draws an image of a mesh, NAME.png.
picture() { "$lapwing" render "$1" -o "$out/$2.png" "${@:3}"; }
