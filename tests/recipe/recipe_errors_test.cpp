#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/recipe/recipe.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;

// One recipe text and all of the message that answers it.
struct Mistake {
  std::string name;
  std::string text;
  std::string message;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.text;
}

std::string recipe(const std::string& steps) {
  return R"({"lapwing": 1, "mesh": "a.obj", "steps": )" + steps + "}";
}
std::string step(const std::string& keys) {
  return recipe(R"([{"op": "deform", )" + keys + "}]");
}
std::string with_roi(const std::string& roi) {
  return step(R"("roi": )" + roi + R"(, "handles": [{"region": {"vertices": [1]}, "move": {}}])");
}
std::string with_belt(const std::string& belt) {
  return step(R"("roi": {"all": true}, "belt": )" + belt +
              R"(, "handles": [{"region": {"vertices": [1]}, "move": {}}])");
}
std::string with_move(const std::string& move) {
  return step(R"("roi": {"all": true}, "handles": [{"region": {"vertices": [1]}, "move": )" + move +
              "}]");
}
std::string with_option(const std::string& option) {
  return step(R"("roi": {"all": true}, "handles": [{"region": {"vertices": [1]}, "move": {}}], )" +
              option);
}

// A whole coat step; `keys` comes behind.
std::string with_coat(const std::string& keys) {
  return recipe(R"([{"op": "coat", "source_patch": {"all": true}, "target_patch": {"all": true},
                     "detail_size": 1, )" +
                keys + "}]");
}
std::string with_patches(const std::string& keys) {
  return recipe(R"([{"op": "coat", )" + keys + "}]");
}

// A whole mix step but for what `keys` says.
std::string with_mix(const std::string& keys) {
  return recipe(R"([{"op": "mix", "target_patch": {"all": true}, )" + keys + "}]");
}
const std::string kSource = R"({"patch": {"all": true}, "detail_size": 1})";
const std::string kSources = "\"sources\": [" + kSource + ", " + kSource + "]";
std::string with_weight(const std::string& weight) {
  return with_mix(kSources + R"(, "weight": )" + weight);
}

class RecipeMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(RecipeMistake, IsAnsweredWithThePlaceAndTheNextStep) {
  const std::string said =
      error_message<InputError>([] { parse_recipe(GetParam().text, "/data", "bend.json"); });
  EXPECT_EQ(said, "bend.json" + GetParam().message);
}

constexpr auto kName = [](const ::testing::TestParamInfo<Mistake>& mistake) {
  return mistake.param.name;
};

INSTANTIATE_TEST_SUITE_P(
    Document, RecipeMistake,
    ::testing::Values(
        Mistake{"NoObject", "[]", ": expected an object, got a list of 0"},
        Mistake{"UnknownKey", R"({"lapwing": 1, "mehs": "a.obj", "steps": []})",
                ": /mehs: unknown key; did you mean \"mesh\"? Known here: \"lapwing\", \"mesh\", "
                "\"steps\", \"save\", \"save_as\""},
        Mistake{"KeyWithASlash", R"({"a/b~c": 1})",
                ": /a~1b~0c: unknown key; Known here: \"lapwing\", \"mesh\", \"steps\", \"save\", "
                "\"save_as\""},
        Mistake{
            "MorphTargetWithASlash",
            R"({"lapwing": 1, "mesh": "a.glb", "steps": [], "save_as": {"morph_target": "a/b"}})",
            ": /save_as/morph_target: expected a name without \"/\", because some formats use "
            "it in a file name"},
        Mistake{"NoVersion", R"({"mesh": "a.obj", "steps": []})",
                ": the key \"lapwing\" is missing; add \"lapwing\": 1, the version of the format"},
        Mistake{"OtherVersion", R"({"lapwing": 2, "mesh": "a.obj", "steps": []})",
                ": /lapwing: expected version 1, which this program reads, got 2"},
        Mistake{"NoMesh", R"({"lapwing": 1, "steps": []})",
                ": the key \"mesh\" is missing; add it"},
        Mistake{"EmptyName", R"({"lapwing": 1, "mesh": "", "steps": []})",
                ": /mesh: expected the name of a file, got an empty text"},
        Mistake{"NumberForAName", R"({"lapwing": 1, "mesh": 3, "steps": []})",
                ": /mesh: expected a text in quotes, got 3"},
        Mistake{"NoSteps", R"({"lapwing": 1, "mesh": "a.obj", "steps": {}})",
                ": /steps: expected a list, got an object"},
        Mistake{"KeyTwice", R"({"lapwing": 1, "mesh": "a", "mesh": "b", "steps": []})",
                ":1:34: /mesh: the key \"mesh\" appears twice in one object; remove one of the "
                "two"},
        Mistake{"KeyTwiceWithin",
                "{\"lapwing\": 1, \"steps\": [{},\n {\"a/b\": 0,\n  \"a/b\": 1}]}",
                ":3:7: /steps/1/a~1b: the key \"a/b\" appears twice in one object; remove one "
                "of the two"},
        Mistake{"BeyondDouble", "{\"lapwing\": 1,\n \"steps\": [{\"x\": [0, 1e999]}]}",
                ":2:26: /steps/0/x/1: the number 1e999 is too large for a double; write a number "
                "below 1.8e308"}),
    kName);

INSTANTIATE_TEST_SUITE_P(
    Step, RecipeMistake,
    ::testing::Values(
        Mistake{"NoOp", recipe("[{}]"), ": /steps/0: the key \"op\" is missing; add it"},
        Mistake{
            "UnknownOp", recipe(R"([{"op": "defrom"}])"),
            ": /steps/0/op: unknown op \"defrom\"; did you mean \"deform\"? Known here: "
            "\"deform\", \"coat\", \"mix\", \"transplant\", \"peel\", \"remesh\", \"decimate\", "
            "\"subdivide\", \"fill_holes\", \"wrap\""},
        Mistake{"NoRoi", step(R"("handles": [])"),
                ": /steps/0: the key \"roi\" is missing; add it"},
        Mistake{"NoHandle", step(R"("roi": {"all": true}, "handles": [])"),
                ": /steps/0/handles: nothing is moved; give at least one handle or target"},
        Mistake{"NoMove", step(R"("roi": {"all": true}, "handles": [{"region": {"all": true}}])"),
                ": /steps/0/handles/0: the key \"move\" is missing; add it"},
        Mistake{"UnknownWeights", with_option(R"("weights": "cotan")"),
                ": /steps/0/weights: unknown weights \"cotan\"; did you mean \"cotangent\"? Known "
                "here: \"uniform\", \"cotangent\""},
        Mistake{"ZeroWeight", with_option(R"("constraint_weight": 0)"),
                ": /steps/0/constraint_weight: expected a number from 0.000001 to 1000000000000, "
                "got 0"},
        Mistake{"HardAsText", with_option(R"("hard": "yes")"),
                ": /steps/0/hard: expected true or false, got the text \"yes\""},
        Mistake{"SettleTolerance", with_option(R"("settle": {"tolerance": 0})"),
                ": /steps/0/settle/tolerance: expected a number above 0, got 0"},
        Mistake{"SettleIterations", with_option(R"("settle": {"max_iterations": 1.5})"),
                ": /steps/0/settle/max_iterations: expected a whole number from 1 to 1000000, "
                "got 1.5"},
        Mistake{"DetailLength", with_option(R"("detail_length": 0)"),
                ": /steps/0/detail_length: expected a number from 0.000001 to 1000, got 0"},
        Mistake{"CommitsOfNothing", with_option(R"("commit_every": 0)"),
                ": /steps/0/commit_every: expected a number above 0 and at most 180 (beyond half a "
                "turn the opposite direction is shorter), got 0"},
        Mistake{"MirrorInParts",
                step(R"("roi": {"all": true}, "commit_every": 90, "handles": [{"region":
                {"vertices": [1]}, "move": {"matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0]}}])"),
                ": /steps/0/handles/0/move/matrix: a matrix that mirrors cannot be divided into "
                "substeps; remove \"commit_every\""}),
    kName);

INSTANTIATE_TEST_SUITE_P(
    Region, RecipeMistake,
    ::testing::Values(
        Mistake{"NoForm", with_roi("{}"),
                ": /steps/0/roi: a region needs one of \"all\", \"vertices\", \"disk\", \"box\", "
                "\"loop\", \"union\", \"minus\", \"disk_in\""},
        Mistake{"TwoForms", with_roi(R"({"all": true, "vertices": [1]})"),
                ": /steps/0/roi: a region takes only one of \"all\", \"vertices\", \"disk\", "
                "\"box\", \"loop\", \"union\", \"minus\", \"disk_in\", got \"all\", \"vertices\""},
        Mistake{"AllFalse", with_roi(R"({"all": false})"),
                ": /steps/0/roi/all: expected true; use \"vertices\" to choose some vertices"},
        Mistake{"NegativeVertex", with_roi(R"({"vertices": [1, -1]})"),
                ": /steps/0/roi/vertices/1: expected a vertex number (whole, from 0), got -1"},
        Mistake{"HugeVertex", with_roi(R"({"vertices": [4294967295]})"),
                ": /steps/0/roi/vertices/0: expected a vertex number (whole, from 0), got "
                "4294967295"},
        Mistake{"VerticesNoList", with_roi(R"({"vertices": 3})"),
                ": /steps/0/roi/vertices: expected a list of vertex numbers, got 3"},
        Mistake{"DiskWithoutCenter", with_roi(R"({"disk": {"radius": 1}})"),
                ": /steps/0/roi/disk: a disk needs one of \"center\", \"near\""},
        Mistake{"DiskWithoutSize", with_roi(R"({"disk": {"center": 1, "radius": 0}})"),
                ": /steps/0/roi/disk/radius: expected a number above 0, got 0"},
        Mistake{"DiskMisspelt", with_roi(R"({"disk": {"centre": 1, "radius": 0}})"),
                ": /steps/0/roi/disk/centre: unknown key; did you mean \"center\"? Known here: "
                "\"center\", \"near\", \"radius\""},
        Mistake{"BoxInsideOut", with_roi(R"({"box": {"min": [0, 2, 0], "max": [1, 1, 1]}})"),
                ": /steps/0/roi/box: min is greater than max in y; swap them"},
        Mistake{"BoxOfTwo", with_roi(R"({"box": {"min": [0, 0], "max": [1, 1, 1]}})"),
                ": /steps/0/roi/box/min: expected 3 numbers, got 2"},
        Mistake{"BoxOfNull", with_roi(R"({"box": {"min": [0, null, 0], "max": [1, 1, 1]}})"),
                ": /steps/0/roi/box/min/1: expected a number, got null"},
        Mistake{"ShortLoop", with_roi(R"({"loop": [1, 2], "inside": 4})"),
                ": /steps/0/roi/loop: expected at least 3 vertices, got 2"},
        Mistake{"LoopWithoutInside", with_roi(R"({"loop": [1, 2, 3]})"),
                ": /steps/0/roi: the key \"inside\" is missing; add it"},
        Mistake{"InsideWithoutLoop", with_roi(R"({"all": true, "inside": 4})"),
                ": /steps/0/roi/inside: \"inside\" goes with \"loop\" only; remove it"},
        Mistake{"EmptyUnion", with_roi(R"({"union": []})"),
                ": /steps/0/roi/union: expected at least 1 region, got 0"},
        Mistake{"MinusOfOne", with_roi(R"({"minus": [{"all": true}]})"),
                ": /steps/0/roi/minus: expected at least 2 regions, got 1"},
        Mistake{"DiskInAList", with_roi(R"({"disk_in": [{"all": true}]})"),
                ": /steps/0/roi/disk_in: expected an object, got a list of 1"},
        Mistake{"InnerRegion", with_roi(R"({"union": [{"all": true}, {"disc": {}}]})"),
                ": /steps/0/roi/union/1/disc: unknown key; did you mean \"disk\"? Known here: "
                "\"all\", \"vertices\", \"disk\", \"box\", \"loop\", \"inside\", \"union\", "
                "\"minus\", \"disk_in\""},
        Mistake{"FractionForARoi", with_roi(R"({"fraction": 0.1})"),
                ": /steps/0/roi/fraction: unknown key; Known here: "
                "\"all\", \"vertices\", \"disk\", \"box\", \"loop\", \"inside\", \"union\", "
                "\"minus\", \"disk_in\""},
        Mistake{"FractionTooLarge", with_belt(R"({"fraction": 2})"),
                ": /steps/0/belt/fraction: expected a number from 0 to 1, got 2"},
        Mistake{"FractionAndMore", with_belt(R"({"fraction": 0.1, "all": true})"),
                ": /steps/0/belt/all: unknown key; Known here: \"fraction\""}),
    kName);

INSTANTIATE_TEST_SUITE_P(
    Move, RecipeMistake,
    ::testing::Values(
        Mistake{"AxisOfTwo", with_move(R"({"rotate": {"axis": [0, 1], "degrees": 30}})"),
                ": /steps/0/handles/0/move/rotate/axis: expected 3 numbers, got 2"},
        Mistake{"AxisNoList", with_move(R"({"rotate": {"axis": "z", "degrees": 30}})"),
                ": /steps/0/handles/0/move/rotate/axis: expected 3 numbers, got the text \"z\""},
        Mistake{"AxisOfNoLength", with_move(R"({"rotate": {"axis": [0, 0, 0], "degrees": 30}})"),
                ": /steps/0/handles/0/move/rotate/axis: the axis is zero; give a direction"},
        Mistake{"NoDegrees", with_move(R"({"rotate": {"axis": [0, 0, 1]}})"),
                ": /steps/0/handles/0/move/rotate: the key \"degrees\" is missing; add it"},
        Mistake{"NegativeScale", with_move(R"({"scale": -1})"),
                ": /steps/0/handles/0/move/scale: expected a number above 0, got -1"},
        Mistake{"MatrixOfNine", with_move(R"({"matrix": [1, 0, 0, 0, 1, 0, 0, 0, 1]})"),
                ": /steps/0/handles/0/move/matrix: expected 12 or 16 numbers, row by row, got 9"},
        Mistake{
            "ProjectiveMatrix",
            with_move(R"({"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1]})"),
            ": /steps/0/handles/0/move/matrix: expected the last row 0 0 0 1: a handle's motion "
            "is affine"},
        Mistake{"MatrixAndScale",
                with_move(R"({"scale": 2, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]})"),
                ": /steps/0/handles/0/move/scale: \"matrix\" and \"scale\" exclude each other; "
                "remove one of the two"},
        Mistake{"UnknownKey", with_move(R"({"translation": [0, 0, 1]})"),
                ": /steps/0/handles/0/move/translation: unknown key; did you mean \"translate\"? "
                "Known here: \"translate\", \"rotate\", \"scale\", \"pivot\", \"matrix\""}),
    kName);

std::string with_mirror(const std::string& mirror) {
  return with_option("\"mirror\": " + mirror);
}
std::string with_falloff(const std::string& keys) {
  return step(R"("roi": {"all": true}, "handles": [{"region": {"vertices": [1]}, "move": {}, )" +
              keys + "}]");
}

INSTANTIATE_TEST_SUITE_P(
    Mirror, RecipeMistake,
    ::testing::Values(
        Mistake{"UnknownWord", with_mirror(R"("x")"),
                ": /steps/0/mirror: unknown mirror \"x\"; Known here: \"auto\""},
        Mistake{"UnknownPlane", with_mirror(R"({"plane": "w"})"),
                ": /steps/0/mirror/plane: unknown plane \"w\"; did you mean \"x\"? Known here: "
                "\"x\", \"y\", \"z\""},
        Mistake{"PlaneAndPoint", with_mirror(R"({"plane": "x", "point": [0, 0, 0]})"),
                ": /steps/0/mirror/plane: \"plane\" names a coordinate plane; remove \"point\" "
                "and \"normal\""},
        Mistake{"NoNormal", with_mirror(R"({"point": [0, 0, 0]})"),
                ": /steps/0/mirror: the key \"normal\" is missing; add it"},
        Mistake{"NormalWithoutLength", with_mirror(R"({"point": [0, 0, 0], "normal": [0, 0, 0]})"),
                ": /steps/0/mirror/normal: the normal is zero; give a direction"},
        Mistake{"Number", with_mirror("3"), ": /steps/0/mirror: expected an object, got 3"}),
    kName);

std::string with_stiffness(const std::string& factor) {
  return with_option(R"("stiffness": [{"region": {"all": true}, "factor": )" + factor + "}]");
}

INSTANTIATE_TEST_SUITE_P(
    Stiffness, RecipeMistake,
    ::testing::Values(
        Mistake{"TooStiff", with_stiffness("101"),
                ": /steps/0/stiffness/0/factor: expected a factor from 0.01 to 100, or \"rigid\", "
                "got 101"},
        Mistake{"UnknownWord", with_stiffness("\"hard\""),
                ": /steps/0/stiffness/0/factor: unknown factor \"hard\"; Known here: \"rigid\""},
        Mistake{"InAField", with_stiffness(R"({"field": [1, 0]})"),
                ": /steps/0/stiffness/0/factor/field/1: expected a factor from 0.01 to 100, or "
                "\"rigid\", got 0"}),
    kName);

INSTANTIATE_TEST_SUITE_P(
    Falloff, RecipeMistake,
    ::testing::Values(
        Mistake{"FalloffAsNumber", with_falloff(R"("falloff": 2)"),
                ": /steps/0/handles/0/falloff: expected an object, got 2"},
        Mistake{"WidthBelowZero", with_falloff(R"("falloff": {"width": -2})"),
                ": /steps/0/handles/0/falloff/width: expected a number above 0, got -2"},
        Mistake{"UnknownProfile", with_falloff(R"("falloff": {"width": 2, "profile": "step"})"),
                ": /steps/0/handles/0/falloff/profile: unknown profile \"step\"; Known here: "
                "\"smooth\", \"linear\""},
        Mistake{
            "ZeroWeight", with_falloff(R"("weight": 0)"),
            ": /steps/0/handles/0/weight: expected a weight from 0.000001 to 1000000000000, got 0"},
        Mistake{"FieldAboveOne", with_falloff(R"("weight": {"field": [0, 1.5]})"),
                ": /steps/0/handles/0/weight/field/1: expected a number from 0 to 1, the handle "
                "weight of the vertex"},
        Mistake{"FieldAndFalloff",
                with_falloff(R"("falloff": {"width": 2}, "weight": {"field": [1]})"),
                ": /steps/0/handles/0/weight: a painted weight and \"falloff\" exclude each other; "
                "remove one of the two"},
        Mistake{"FalloffOfAMix", with_mix(kSources + R"(, "weight": {"field": []}, "handles": [
                    {"region": {"vertices": [1]}, "move": {}, "falloff": {"width": 1}}])"),
                ": /steps/0/handles/0/falloff: unknown key; Known here: \"region\", \"move\""}),
    kName);

const char* const kCoatKeys =
    "Known here: \"op\", \"source\", \"source_patch\", \"target_patch\", \"detail_size\", "
    "\"smooth_target\", \"weights\", \"domain\", \"boundary_pairs\", \"inner_pairs\", "
    "\"sampling\", \"scale\", \"amplitude\", \"transition\", \"remesh\"";

INSTANTIATE_TEST_SUITE_P(
    Coat, RecipeMistake,
    ::testing::Values(
        Mistake{"UnknownKey", with_coat(R"("smooth_taget": 1)"),
                std::string(": /steps/0/smooth_taget: unknown key; did you mean "
                            "\"smooth_target\"? ") +
                    kCoatKeys},
        Mistake{"KeyOfADeform", with_coat(R"("handles": [])"),
                std::string(": /steps/0/handles: unknown key; ") + kCoatKeys},
        Mistake{"NoSourcePatch", with_patches(R"("target_patch": {"all": true}, "detail_size": 1)"),
                ": /steps/0: the key \"source_patch\" is missing; add it"},
        Mistake{"DetailOfNoSize", with_patches(R"("source_patch": {"all": true},
                "target_patch": {"all": true}, "detail_size": 0)"),
                ": /steps/0/detail_size: expected a number above 0, got 0"},
        Mistake{"SmoothTargetBelowZero", with_coat(R"("smooth_target": -1)"),
                ": /steps/0/smooth_target: expected 0 or more, got -1"},
        Mistake{"UnknownRemesh", with_coat(R"("remesh": "non")"),
                ": /steps/0/remesh: unknown remesh \"non\"; did you mean \"none\"? Known here: "
                "\"auto\", \"none\""},
        Mistake{"RemeshAsBool", with_coat(R"("remesh": false)"),
                ": /steps/0/remesh: expected a text in quotes, got false"}),
    kName);

INSTANTIATE_TEST_SUITE_P(
    CoatPairs, RecipeMistake,
    ::testing::Values(
        Mistake{"NoList", with_coat(R"("boundary_pairs": 3)"),
                ": /steps/0/boundary_pairs: expected a list, got 3"},
        Mistake{"NotInABracket", with_coat(R"("boundary_pairs": [3, 4])"),
                ": /steps/0/boundary_pairs/0: expected a list of vertex numbers, got 3"},
        Mistake{"OfOne", with_coat(R"("boundary_pairs": [[3]])"),
                ": /steps/0/boundary_pairs/0: expected two vertices, one of the source and one of "
                "the target, got 1"},
        Mistake{"TwoForTheDisk", with_coat(R"("boundary_pairs": [[3, 4], [5, 6]])"),
                ": /steps/0/boundary_pairs: the disk needs one pair of boundary vertices, got 2"},
        Mistake{"OneForTheSquare", with_coat(R"("domain": "square", "boundary_pairs": [[3, 4]])"),
                ": /steps/0/boundary_pairs: the square needs four pairs of boundary vertices in "
                "order around it, got 1"}),
    kName);

INSTANTIATE_TEST_SUITE_P(
    CoatSize, RecipeMistake,
    ::testing::Values(
        Mistake{"ScaleOtherText", with_coat(R"("scale": "automatic")"),
                ": /steps/0/scale: unknown scale \"automatic\"; Known here: \"auto\""},
        Mistake{"ScaleOfNothing", with_coat(R"("scale": 0)"),
                ": /steps/0/scale: expected a number above 0, got 0"},
        Mistake{"AmplitudeAsText", with_coat(R"("amplitude": "high")"),
                ": /steps/0/amplitude: expected a number, got the text \"high\""},
        Mistake{"TransitionWithoutWidth", with_coat(R"("transition": {"profile": "linear"})"),
                ": /steps/0/transition: the key \"width\" is missing; add it"},
        Mistake{"TransitionBelowZero", with_coat(R"("transition": {"width": -1})"),
                ": /steps/0/transition/width: expected 0 or more, got -1"}),
    kName);

INSTANTIATE_TEST_SUITE_P(
    Mix, RecipeMistake,
    ::testing::Values(
        Mistake{"UnknownKey", with_mix(kSources + R"(, "weigth": {})"),
                ": /steps/0/weigth: unknown key; did you mean \"weight\"? Known here: \"op\", "
                "\"target_patch\", \"sources\", \"take\", \"weight\", \"profile\", "
                "\"handles\", \"smooth_target\", \"weights\", \"domain\", \"transition\", "
                "\"remesh\""},
        Mistake{"UnknownKeyOfASource", with_mix(R"("sources": [{"pach": {"all": true}}, {}])"),
                ": /steps/0/sources/0/pach: unknown key; did you mean \"patch\"? Known here: "
                "\"mesh\", \"patch\", \"detail_size\", \"boundary_pairs\", "
                "\"inner_pairs\", \"sampling\", \"scale\", \"amplitude\""},
        Mistake{"OneSource", with_mix("\"sources\": [" + kSource + "]"),
                ": /steps/0/sources: expected two sources, got 1; {\"op\": \"coat\"} takes one"},
        Mistake{"ThreeSources",
                with_mix("\"sources\": [" + kSource + ", " + kSource + ", " + kSource + "]"),
                ": /steps/0/sources: expected two sources, got 3"},
        Mistake{"SourceWithoutADetailSize",
                with_mix("\"sources\": [" + kSource + R"(, {"patch": {"all": true}}])"),
                ": /steps/0/sources/1: the key \"detail_size\" is missing; add it"},
        Mistake{"PairsThatDoNotFitTheDomain",
                with_mix(R"("domain": "square", "sources": [)" + kSource +
                         R"(, {"patch": {"all": true}, "detail_size": 1,
                               "boundary_pairs": [[3, 4]]}],
                         "weight": {"domain_v": [0, 1]})"),
                ": /steps/0/sources/1/boundary_pairs: the square needs four pairs of boundary "
                "vertices in order around it, got 1"}),
    kName);

INSTANTIATE_TEST_SUITE_P(
    MixWeights, RecipeMistake,
    ::testing::Values(
        Mistake{"UnknownForm", with_weight(R"({"distance": 1})"),
                ": /steps/0/weight/distance: unknown key; did you mean \"distance_to\"? Known "
                "here: \"domain_v\", \"distance_to\", \"width\", \"field\""},
        Mistake{"DistanceWithoutAWidth", with_weight(R"({"distance_to": {"all": true}})"),
                ": /steps/0/weight: the key \"width\" is missing; add it"},
        Mistake{"WidthOfAField", with_weight(R"({"field": [1], "width": 1})"),
                ": /steps/0/weight/width: \"width\" goes with \"distance_to\" only; remove it"},
        Mistake{"OneEnd", with_weight(R"({"domain_v": [1]})"),
                ": /steps/0/weight/domain_v: expected two numbers, the start and the end of "
                "the ramp, got 1"},
        Mistake{"NoExtent", with_weight(R"({"domain_v": [0.5, 0.5]})"),
                ": /steps/0/weight/domain_v: the ramp has no extent; give two different numbers"},
        Mistake{"DiskHasNoV", with_weight(R"({"domain_v": [0, 1]})"),
                ": /steps/0/weight/domain_v: only the square domain has a coordinate v; add "
                "\"domain\": \"square\", or use \"distance_to\""},
        Mistake{"FieldBeyondOne", with_weight(R"({"field": [0, 1.5]})"),
                ": /steps/0/weight/field/1: expected a number from 0 to 1, the second source's "
                "share"},
        Mistake{"ProfileOfAField",
                with_mix(kSources + R"(, "weight": {"field": [1]}, "profile": "smooth")"),
                ": /steps/0/profile: a painted field has no profile; remove \"profile\""}),
    kName);

std::string error_of(const std::string& text) {
  return error_message<InputError>([&] { parse_recipe(text, "/data", "bend.json"); });
}

TEST(RecipeSyntax, ErrorHasLineAndColumn) {
  const std::string said = error_of("{\n  \"lapwing\": 1,\n  \"mesh\" \"a.obj\"\n}");
  EXPECT_THAT(said, HasSubstr("bend.json:3:16: syntax error"));
  EXPECT_THAT(said, HasSubstr("check commas, quotes and brackets before this place"));
}

TEST(RecipeSyntax, EndsTooEarlyOrTooLate) {
  EXPECT_THAT(error_of(""), HasSubstr("bend.json:1:1: syntax error"));
  EXPECT_THAT(error_of("{\n"), HasSubstr("bend.json:2:1: syntax error"));
  EXPECT_THAT(error_of("{} {}"), HasSubstr("bend.json:1:4: syntax error"));
}

TEST(RecipeSyntax, BytesThatAreNotUtf8AreRefused) {
  EXPECT_THAT(error_of("{\"mesh\": \"caf\xe9\"}"), HasSubstr("bend.json:1:"));
}

TEST(RecipeSyntax, RegionsNestedWithoutEndAreRefused) {
  std::string roi = R"({"all": true})";
  for (int depth = 0; depth < 100; ++depth) roi = R"({"union": [)" + roi + "]}";
  EXPECT_THAT(error_of(with_roi(roi)), HasSubstr("regions are nested more than 64 levels deep"));
}

TEST(RecipeSyntax, ListsNestedWithoutEndAreRefused) {
  EXPECT_THAT(error_of(std::string(100'000, '[')),
              HasSubstr(":1:501: lists and objects are nested more than 500 levels deep"));
}

}  // namespace
}  // namespace lapwing
