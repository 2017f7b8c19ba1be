#include "lapwing/wrap/landmarks.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class LandmarkFile : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  LandmarkSpec read(const std::string& file, const std::string& scan_file = "") {
    notes_.clear();
    return with_rows({.file = file, .scan_file = scan_file}, folder_.path(), notes_);
  }
  std::string refusal(const std::string& file, const std::string& scan_file = "") {
    return error_message<InputError>([&] { read(file, scan_file); });
  }

  TemporaryFolder folder_;
  std::vector<std::string> notes_;
};

// Returns the positions of a row; there are no vertices in it.
Vector3d on_template(const Landmark& row) {
  return std::get<Vector3d>(row.on_template);
}
Vector3d on_scan(const Landmark& row) {
  return std::get<Vector3d>(row.on_scan);
}

std::string fcsv(const std::string& system, const std::string& rows) {
  return "# Markups fiducial file version = 4.11\n# CoordinateSystem = " + system +
         "\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n" + rows;
}

std::string markups(const std::string& system, const std::string& points) {
  return R"({"markups": [{"type": "Fiducial", "coordinateSystem": ")" + system +
         R"(", "controlPoints": [)" + points + "]}]}";
}

TEST_F(LandmarkFile, OfATableHasVerticesOrPointsAndWeights) {
  write("a.csv", "vertex,x,y,z\n7,1,2,3\n8,4,5,6,0.5\n");
  EXPECT_THAT(read("a.csv").rows, ElementsAre(Landmark{Index{7}, Vector3d(1, 2, 3)},
                                              Landmark{Index{8}, Vector3d(4, 5, 6), 0.5}));
  write("b.csv", "nose,0,0,1,1,2,3\n");
  EXPECT_THAT(read("b.csv").rows, ElementsAre(Landmark{Vector3d(0, 0, 1), Vector3d(1, 2, 3)}));
  write("c.csv", "7,90\n");
  EXPECT_THAT(read("c.csv").rows, ElementsAre(Landmark{Index{7}, Index{90}}));
}

TEST_F(LandmarkFile, IsReadBackAsItWasWritten) {
  const Mesh ball = icosphere(1);
  const std::vector<TargetRow> rows{{Index{7}, {0.1, 2, -3}, 1.0}, {Index{8}, {1e-9, 5, 6}, 0.5}};
  write_landmarks(rows, ball, folder_ / "a.csv");
  EXPECT_EQ(targets_of(read("a.csv"), ball, ball).rows, rows);
  const std::vector<TargetRow> mixed{{Index{7}, {0.1, 2, -3}}, {ball.positions[3], {4, 5, 6}}};
  write_landmarks(mixed, ball, folder_ / "b.csv");
  EXPECT_EQ(targets_of(read("b.csv"), ball, ball).rows,
            (std::vector<TargetRow>{{ball.positions[7], {0.1, 2, -3}}, mixed[1]}));
}

TEST_F(LandmarkFile, OfJsonNamesBothSides) {
  write("a.json", R"([{"vertex": 7, "position": [1, 2, 3]},
    {"point": [0, 0, 1], "scan_vertex": 90, "weight": 2, "label": "nose"}, [8, 4, 5, 6]])");
  EXPECT_THAT(read("a.json").rows, ElementsAre(Landmark{Index{7}, Vector3d(1, 2, 3)},
                                               Landmark{Vector3d(0, 0, 1), Index{90}, 2.0},
                                               Landmark{Index{8}, Vector3d(4, 5, 6)}));
  EXPECT_EQ(read("a.json").rows[1].label, "nose");
}

TEST_F(LandmarkFile, IsRefusedWithItsNameAndTheRow) {
  write("a.csv", "vertex,x,y,z\n7,1,2,3\n8,1,2\n");
  EXPECT_THAT(refusal("a.csv"),
              AllOf(HasSubstr("a.csv:3: expected 4 numbers"), HasSubstr("got 3")));
  write("b.csv", "1.5,2\n");
  EXPECT_THAT(refusal("b.csv"), HasSubstr("b.csv:1: a row of two numbers contains a vertex"));
  write("a.json", R"([{"vertex": 7, "place": [1, 2, 3]}])");
  EXPECT_THAT(refusal("a.json"), HasSubstr("a.json: /0/place: unknown key"));
  write("b.json", R"([{"vertex": 7}])");
  EXPECT_THAT(refusal("b.json"), HasSubstr("a landmark on the scan"));
  write("a.fcsv", fcsv("LPS", "1,1,2,3,0,0,0,1,1,1,0,nose\n"));
  EXPECT_THAT(refusal("a.fcsv"), HasSubstr("give two files"));
}

TEST_F(LandmarkFile, OfPointsIsPairedByLabels) {
  write("a.fcsv", fcsv("LPS", "1,1,2,3,0,0,0,1,1,1,0,nose\n2,4,5,6,0,0,0,1,1,1,0,chin\n"));
  write("b.mrk.json", markups("LPS", R"({"label": "chin", "position": [40, 50, 60]},
    {"label": "ear", "position": ""}, {"label": "nose", "position": [10, 20, 30]})"));
  const LandmarkSpec both = read("a.fcsv", "b.mrk.json");
  EXPECT_THAT(both.rows, ElementsAre(Landmark{Vector3d(1, 2, 3), Vector3d(10, 20, 30)},
                                     Landmark{Vector3d(4, 5, 6), Vector3d(40, 50, 60)}));
  EXPECT_THAT(notes_, IsEmpty());
  write("c.csv", "label,x,y,z\nnose,7,8,9\near,0,0,0\n");
  EXPECT_THAT(read("c.csv", "a.fcsv").rows,
              ElementsAre(Landmark{Vector3d(7, 8, 9), Vector3d(1, 2, 3)}));
  EXPECT_THAT(notes_, ElementsAre(HasSubstr("a.fcsv has no points labeled \"ear\""),
                                  HasSubstr("c.csv has no points labeled \"chin\"")));
}

TEST_F(LandmarkFile, OfPointsWithoutLabelsIsPairedInOrder) {
  write("a.csv", "x,y,z\n1,2,3\n4,5,6\n");
  write("b.mrk.json", markups("LPS", R"({"position": [7, 8, 9]}, {"position": [0, 1, 2]})"));
  EXPECT_THAT(read("a.csv", "b.mrk.json").rows,
              ElementsAre(Landmark{Vector3d(1, 2, 3), Vector3d(7, 8, 9)},
                          Landmark{Vector3d(4, 5, 6), Vector3d(0, 1, 2)}));
  write("c.csv", "x,y,z\n1,2,3\n");
  EXPECT_THAT(refusal("a.csv", "c.csv"), AllOf(HasSubstr("contains 2 points"), HasSubstr(" 1.")));
}

TEST_F(LandmarkFile, OfSlicerIsConvertedToLps) {
  const std::string row = "1,1,2,3,0,0,0,1,1,1,0,nose\n";
  write("lps.fcsv", fcsv("LPS", row));
  write("ras.fcsv", fcsv("0", row));
  write("ras.mrk.json", markups("RAS", R"({"label": "nose", "position": [1, 2, 3]})"));
  write("ras.csv", "label,r,a,s\nnose,1,2,3\n");
  EXPECT_EQ(on_template(read("lps.fcsv", "ras.fcsv").rows[0]), Vector3d(1, 2, 3));
  for (const char* file : {"ras.fcsv", "ras.mrk.json", "ras.csv"}) {
    EXPECT_EQ(on_scan(read("lps.fcsv", file).rows[0]), Vector3d(-1, -2, 3)) << file;
  }
  write("ijk.mrk.json", markups("IJK", R"({"label": "nose", "position": [1, 2, 3]})"));
  EXPECT_THAT(refusal("lps.fcsv", "ijk.mrk.json"),
              HasSubstr("ijk.mrk.json: /markups/0/coordinateSystem: expected the coordinate "
                        "system LPS or RAS, got \"IJK\""));
}

TEST_F(LandmarkFile, OfPointsThatCannotBePairedIsRefused) {
  write("a.csv", "label,x,y,z\nnose,1,2,3\nchin,4,5,6\n");
  write("twice.csv", "label,x,y,z\nnose,1,2,3\nnose,4,5,6\n");
  EXPECT_THAT(refusal("a.csv", "twice.csv"),
              AllOf(HasSubstr("twice.csv:3: the label \"nose\" is also that of another point"),
                    HasSubstr("twice.csv:2")));
  write("without.csv", "label,x,y,z\nnose,1,2,3\n,4,5,6\n");
  EXPECT_THAT(refusal("a.csv", "without.csv"), HasSubstr("without.csv:3: the point has no label"));
  write("other.csv", "label,x,y,z\nNose,1,2,3\n");
  EXPECT_THAT(refusal("a.csv", "other.csv"), HasSubstr("no label in common (\"nose\", \"Nose\")"));
  write("none.mrk.json", R"({"markups": [{"type": "Plane"}]})");
  EXPECT_THAT(refusal("a.csv", "none.mrk.json"), HasSubstr("contains no points"));
}

TEST(Landmarks, TakePositionsFromVerticesOfTheScan) {
  const Mesh ball = icosphere(2);
  Mesh scan = icosphere(3);
  for (Vector3d& p : scan.positions) p *= 2.0;
  const TargetSpec targets = targets_of(
      {.rows = {{Index{3}, Index{5}}, {ball.positions[7], Vector3d(9, 9, 9), 0.5}}}, ball, scan);
  ASSERT_THAT(targets.rows, SizeIs(2));
  EXPECT_EQ(targets.rows[0], (TargetRow{Index{3}, scan.positions[5]}));
  EXPECT_EQ(targets.rows[1], (TargetRow{ball.positions[7], Vector3d(9, 9, 9), 0.5}));
}

TEST(Landmarks, MustBeVerticesOrNearTheTemplate) {
  const Mesh ball = icosphere(2);
  const auto refusal = [&](const Landmark& row) {
    return error_message<InputError>([&] { targets_of({.rows = {row}}, ball, icosphere(3)); });
  };
  EXPECT_THAT(refusal({Index{4000}, Index{0}, 1.0, "a.csv:2"}),
              HasSubstr("a.csv:2: the template has no vertex 4000, only 0 to 161"));
  EXPECT_THAT(refusal({Index{0}, Index{4000}, 1.0, "a.csv:2"}),
              HasSubstr("a.csv:2: the scan has no vertex 4000"));
  const Vector3d p = ball.positions[0];
  EXPECT_EQ(refusal({Vector3d(1.02 * p), Index{0}}), "");
  EXPECT_THAT(refusal({Vector3d(1.5 * p), Index{0}, 1.0, "a.fcsv:4", "nose"}),
              AllOf(HasSubstr("a.fcsv:4: point \"nose\": the position ("),
                    HasSubstr("0.5 away from the template"), HasSubstr("LPS")));
}

}  // namespace
}  // namespace lapwing
