#include "work/window_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace lapwing::viewer {
namespace {

using Words = std::pair<std::string_view, std::string_view>;

// A key with a flag precedes the key of the same name without one.
constexpr std::array kKeyWords{
    KeyWords{"weights", "", "Laplacian weights",
             "Edge weights of the Laplacian. Cotangent: they follow the shape of the triangles. "
             "Uniform: all edges have the same weight."},
    KeyWords{"tolerance", "", "Tolerance",
             "Refining stops when no vertex would move farther than this, in mean edge lengths."},
    KeyWords{"max_iterations", "", "Max iterations", "Refining stops after this many iterations."},
    KeyWords{"detail_length", "", "Detail length",
             "Details smaller than this keep their shape. Larger forms bend and stretch like an "
             "elastic sheet. A fraction of the radius of the region."},
    KeyWords{"response", "", "Linear response",
             "Method of the linear response at the start of a drag. Tangent: from the energy. RSI: "
             "from coordinates that do not depend on rotation and scale."},
    KeyWords{
        "constraint_weight", "", "Constraint weight",
        "Holds the fixed border and the handles softly, with this weight. Off: they miss their "
        "targets by less than 1% of the motion."},
    KeyWords{"hard", "", "Hold exactly", "Holds the fixed border and the handles exactly."},
    KeyWords{"settle", "", "Refine",
             "Minimizes the energy. Off: the linear response, which is accurate for small "
             "rotations only."},
    KeyWords{"commit_every", "", "Split into steps of",
             "Splits a larger rotation into equal steps of at most this many degrees. Each step "
             "starts from the result of the last."},
    KeyWords{"loose", "", "Loose parts",
             "Components that nothing holds in place. Move along: they follow the nearest surface. "
             "Leave: they stay in place. Stop: the edit is not carried out."},
    KeyWords{"seams", "", "Seams",
             "Boundary edges that coincide, as along texture seams. Join: they are edited as one "
             "surface. Leave: they can move apart."},
    KeyWords{"smooth_target", "", "Smooth target",
             "First removes details of the target that are smaller than this. 0 keeps them under "
             "the new "
             "detail."},
    KeyWords{"detail_size", "", "Detail size",
             "Features of the source smaller than this are copied."},
    KeyWords{"amplitude", "", "Amplitude",
             "Height of the detail. 0 adds none, a negative value engraves it."},
    KeyWords{"domain", "", "Domain", "The shape that both patches are mapped to."},
    KeyWords{
        "sampling", "", "Sampling",
        "How the detail is sampled. One-ring: at each target vertex and its neighbours. Linear: by "
        "interpolation, which hides the triangles of the source on a finer target."},
    KeyWords{"scale", "scale", "Scale",
             "Edge length of the new triangles, in mean edge lengths of the surface or region."},
    KeyWords{"length", "", "Edge length",
             "Edge length of the new triangles. Off: \"Scale\" is used."},
    KeyWords{"iterations", "", "Iterations", "Number of passes over the surface."},
    KeyWords{"feature_degrees", "", "Feature angle",
             "Edges whose faces meet at more than this angle, in degrees, are kept."},
    KeyWords{"share", "", "Vertices to keep",
             "Approximate fraction of the vertices that are kept."},
    KeyWords{"times", "", "Levels", "Number of times each triangle is split into four."},
    KeyWords{"smooth", "", "Smooth",
             "Smooths the shape by Loop subdivision. Off: the shape does not change."},
    KeyWords{"shape", "", "Shape",
             "Flat: triangles between the vertices of the rim. Smooth: adds vertices, and "
             "continues the surrounding surface."},
    KeyWords{"largest", "", "Largest hole",
             "Holes with more rim vertices than this stay open. 0 for no limit."},
    KeyWords{"borders", "", "Fill borders",
             "Also fills the borders of open sheets: the longest loop of each part that is flatter "
             "than a hemisphere."},
    KeyWords{"scale", "", "Scale",
             "Size of the detail on the target relative to the source. Off: the local ratio of "
             "lengths."},
    KeyWords{"transition", "", "Transition",
             "Blends the detail over a width of your choice. Off: a width chosen automatically."},
    KeyWords{"width", "transition", "Transition width",
             "Width over which one detail blends into the other. 0 gives a sharp edge."},
    KeyWords{"width", "belt", "Held width", "Width of the held zone beyond the padding."},
    KeyWords{"width", "", "Transition width", ""},
    KeyWords{"profile", "", "Profile",
             "How the detail changes across the transition: smoothly, or at a constant rate."},
    KeyWords{"remesh", "", "Remesh",
             "Subdivides triangles that are too coarse or uneven for the result. Off: keeps the "
             "triangles."},
    KeyWords{"belt", "", "Fixed border",
             "Sets the widths of two zones beyond the transition: the padding, which may move, and "
             "the held zone around it."},
    KeyWords{"padding", "", "Padding", "Width of the zone beyond the transition that may move."},
    KeyWords{"boundary_pairs", "", "Border points", ""},
    KeyWords{"inner_pairs", "", "Inside points", ""},
    KeyWords{"target_patch", "", "Region", ""},
    KeyWords{"target_region", "", "Region", ""},
    KeyWords{"source_patch", "", "Source patch", ""},
    KeyWords{"domain_v", "", "Across the domain", ""},
    KeyWords{"loop", "", "Loop", ""},
    KeyWords{"inside", "", "Side to keep", ""}};

constexpr std::array kChoiceWords{Words{"rsi", "RSI"},     Words{"carry", "Move along"},
                                  Words{"refuse", "Stop"}, Words{"auto", "Automatic"},
                                  Words{"none", "Off"},    Words{"one_ring", "One-ring"}};

constexpr std::array kStageWords{Words{"align", "Aligning"},
                                 Words{"analyze", "Ordering the matrix"},
                                 Words{"assemble", "Assembling the matrix"},
                                 Words{"carry", "Moving attached objects"},
                                 Words{"check", "Checking the mesh"},
                                 Words{"coarse surface", "Building the coarse proxy"},
                                 Words{"collars", "Finding the transition"},
                                 Words{"colours", "Reading colours"},
                                 Words{"constraints", "Setting constraints"},
                                 Words{"decimate", "Decimating"},
                                 Words{"factor", "Factorizing the matrix"},
                                 Words{"fill", "Filling holes"},
                                 Words{"frames", "Computing local frames"},
                                 Words{"laplacian", "Computing the Laplacian"},
                                 Words{"map", "Mapping the patches"},
                                 Words{"normal_matrix", "Assembling the matrix"},
                                 Words{"order", "Ordering the matrix"},
                                 Words{"part", "Placing the part"},
                                 Words{"pattern", "Assembling the matrix"},
                                 Words{"peel", "Extracting detail"},
                                 Words{"preview", "Computing the preview"},
                                 Words{"read", "Reading"},
                                 Words{"remesh", "Remeshing"},
                                 Words{"repair", "Repairing"},
                                 Words{"response", "Computing the linear response"},
                                 Words{"sample", "Sampling detail"},
                                 Words{"scan", "Reading the scan"},
                                 Words{"settle", "Refining"},
                                 Words{"shares", "Computing handle weights"},
                                 Words{"smooth", "Smoothing"},
                                 Words{"solve", "Solving"},
                                 Words{"solve_many", "Solving"},
                                 Words{"source", "Preparing source detail"},
                                 Words{"subdivide", "Subdividing"},
                                 Words{"topology", "Building the topology"},
                                 Words{"wrap", "Wrapping"},
                                 Words{"zip", "Joining the part"}};

// Phrases of the engine, the longer ones first.
constexpr std::array kPhrases{
    Words{", or replace it by {\"disk_in\": REGION} to use the largest disk inside",
          ", such as the largest disk inside"},
    Words{", or use {\"disk_in\": REGION}", ", or drag a disk"},
    Words{"; set LAPWING_VALIDATION=1 to learn why, or run with --device cpu", ". Try again"},
    Words{", or run with --device cpu", ""},
    Words{" (--name)", ""},
    Words{"cut it open with `lapwing cut`, or give a \"region\" of it",
          "cut out a region of it under \"More parts\""},
    Words{"cut a part out of the mesh with `lapwing cut`",
          "cut a part out of the mesh under \"More parts\""},
    Words{"check \"place\", or check the part with `lapwing check`",
          "place the part again, or open it and look at its defects"},
    Words{"run `lapwing check` on the part and on the mesh",
          "look at the defects of the part and of the mesh in the Mesh tab"},
    Words{"run `lapwing check` on source and target",
          "look at the defects of source and target in the Mesh tab"},
    Words{"run `lapwing check` to find degenerate triangles",
          "look for degenerate triangles in the Mesh tab"},
    Words{"remesh both meshes around the seam with `lapwing remesh`",
          "remesh both meshes around the seam"},
    Words{"remesh the target patch with `lapwing remesh`", "remesh the target patch"},
    Words{"refine the target with `lapwing remesh` first",
          "remesh the target with shorter edges first"},
    Words{"find and repair it with `lapwing check`", "repair it in the Mesh tab"},
    Words{"Run `lapwing check --fix`", "Click \"Repair\""},
    Words{"run `lapwing check --fix`", "click \"Repair\""},
    Words{"use a loop from `boundary_loops`", "use another loop"},
    Words{", for example with \"minus\"", ""},
    Words{", or give the move as a \"matrix\"", ""},
    Words{"give the handles of one side only, or remove \"mirror\"",
          "select handles on one side only, or turn off \"Mirror\""},
    Words{"give a point of the plane, or \"auto\"", "choose another plane, or \"Shape\""},
    Words{"add \"commit_every\": ", "turn on \"commit_every\": "},
    Words{"give it another name with \"save\"", "rename it"},
    Words{"set \"domain\" to \"square\", or use \"distance_to\"",
          "set \"Domain\" to \"Square\", or choose \"Around a handle\""},
    Words{"raise or remove \"constraint_weight\" or the handle's \"weight\", or set \"hard\"",
          "raise \"Constraint weight\" or the handle's weight, or turn on \"Hold exactly\""},
    Words{"Raise \"max_iterations\" of \"settle\"",
          "Raise \"Max iterations\" in the solver settings"},
    Words{"Give the plane of symmetry, make the template symmetric, or remove \"mirror\"",
          "Choose the plane of symmetry, make the template symmetric, or turn off \"Mirror\""},
    Words{"Remove \"stiffness\", turn on", "Press Shift+P and click \"Remove stiffness\", turn on"},
    Words{"set \"response\" to \"tangent\"", "set \"Linear response\" to \"Tangent\""},
    Words{"run `lapwing check` on it, and make sure",
          "look at its defects in the Mesh tab, and make sure"},
    Words{"Run `lapwing check MESH`, repair the mesh with --fix, or remove",
          "Look at the defects in the Mesh tab, click \"Repair\", or remove"},
    Words{"/disk_in: ", ": "},
    Words{"set its \"width\" below", "set \"Transition width\" below"},
    Words{"make its \"width\" larger", "raise \"Transition width\""},
    Words{"\"keep_size\" and \"scale\" exclude each other; remove one of the two",
          "the part has both its original size and another one; choose one of the two"},
    Words{"or remove \"hard\" and \"settle\": false",
          "or turn on \"Refine\" and turn off \"Hold exactly\""},
    Words{"repair it with `lapwing check MESH --fix OUT`", "click \"Repair\""},
    Words{"fill them with `lapwing check MESH --fix OUT --fill-holes smooth`",
          "fill them under \"Holes\" in the Mesh tab"},
    Words{"`lapwing check MESH --fix OUT`", "\"Repair\""},
    Words{"`lapwing check --fix`", "\"Repair\""},
    Words{"`deform`", "an edit"},
    Words{"region of interest", "region"},
    Words{"turn on \"settle\"", "turn on \"Refine\" in the solver settings"},
    Words{"raise constraint_weight", "raise \"Constraint weight\" in the solver settings"},
    Words{"to \"none\"", "to \"Off\""},
    Words{"(\"remesh\": \"none\")", "(\"Remesh\" off)"},
    Words{"remove \"", "turn off \""},
    Words{"set \"width\" of \"transition\"", "set \"Transition width\""},
    Words{"give \"transition\" a smaller \"width\"", "lower \"Transition width\""},
    Words{"the ROI", "the region"},
    Words{"ROI", "region"},
    Words{"settling", "refining"}};

void replace_all(std::string& text, std::string_view old, std::string_view by) {
  for (std::size_t at = text.find(old); at != std::string::npos;
       at = text.find(old, at + by.size())) {
    text.replace(at, old.size(), by);
  }
}

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// Replaces whole words only, and none inside of file names.
void replace_words(std::string& text, std::string_view old, std::string_view by) {
  const auto continues_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./").find(c) != std::string_view::npos;
  };
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at)) {
    const std::size_t end = at + old.size();
    const bool begins = at == 0 || !continues_name(text[at - 1]);
    const bool is_full_stop =
        end < text.size() && text[end] == '.' && (end + 1 == text.size() || text[end + 1] == ' ');
    const bool ends = end == text.size() || !continues_name(text[end]) || is_full_stop;
    if (begins && ends) text.replace(at, old.size(), by);
    at += begins && ends ? by.size() : old.size();
  }
}

// Replaces "a/b/key: " and "key/2: " by the label of the key, because the window has no recipe to
// point into.
void replace_pointer(std::string& text, const KeyWords& words) {
  const std::string key = "/" + std::string(words.key);
  const std::size_t at = text.find(key);
  const std::size_t end = text.find(':');
  if (at == std::string::npos || end == std::string::npos || at > end) return;
  const char after = text[at + key.size()];  // a longer key begins with this one, too
  if (after != ':' && after != '/') return;
  if (text.find('.') < end) return;  // the name of a file
  if (text.find(' ') < at || end + 1 >= text.size() || text[end + 1] != ' ') return;
  text.replace(0, end, words.label);
}

// Removes the flags of the command line, such as " (or --commit-every 30)".
void remove_flags(std::string& text) {
  constexpr std::string_view kBegin = " (or --";
  for (std::size_t at = text.find(kBegin); at != std::string::npos; at = text.find(kBegin)) {
    const std::size_t end = text.find(')', at);
    if (end == std::string::npos) return;
    text.erase(at, end + 1 - at);
  }
}

// Makes the initial letter a capital, unless the message begins with the name of a file.
void capitalize(std::string& text) {
  const std::size_t end = std::min(text.find_first_of(" :,;"), text.size());
  const bool is_word = end > 0 && std::all_of(text.begin(), text.begin() + static_cast<long>(end),
                                              [](char c) { return is_letter(c); });
  if (is_word) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
}

}  // namespace

const KeyWords* words_of_key(std::string_view key, std::string_view flag) {
  const auto found = std::ranges::find_if(kKeyWords, [&](const KeyWords& each) {
    return each.key == key && (each.flag.empty() || each.flag == flag);
  });
  return found == kKeyWords.end() ? nullptr : &*found;
}

std::string choice_in_words(std::string_view name) {
  const auto found = std::ranges::find(kChoiceWords, name, &Words::first);
  std::string text(found == kChoiceWords.end() ? name : found->second);
  std::ranges::replace(text, '_', ' ');
  capitalize(text);
  return text;
}

std::string_view stage_in_words(std::string_view stage) {
  const auto found = std::ranges::find(kStageWords, stage, &Words::first);
  return found == kStageWords.end() ? stage : found->second;
}

std::string in_window_words(std::string message) {
  remove_flags(message);
  for (const KeyWords& words : kKeyWords) replace_pointer(message, words);
  for (const auto& [old, by] : kPhrases) {
    is_letter(old.front()) && is_letter(old.back()) ? replace_words(message, old, by)
                                                    : replace_all(message, old, by);
  }
  for (const KeyWords& words : kKeyWords) {
    const std::string quote = "\"";
    replace_all(message, quote + std::string(words.key) + quote,
                quote + std::string(words.label) + quote);
  }
  replace_words(message, "belt", "fixed border");
  capitalize(message);
  return message;
}

}  // namespace lapwing::viewer
