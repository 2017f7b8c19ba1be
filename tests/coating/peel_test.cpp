// Peeling as a function of a mesh and a request.
#include "lapwing/coating/peel.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/base/errors.h"
#include "lapwing/coating/fairing.h"
#include "support/error_message.h"
#include "support/largest_distance.h"

namespace lapwing::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr double kBumpHeight = 0.02;

class PeelInMemory : public ::testing::Test {
 protected:
  static PeelRequest request() {
    PeelRequest request;
    request.detail_size = 0.4;
    return request;
  }
  // Part of the sheet, off its boundary.
  static PeelRequest of_the_middle() {
    PeelRequest request = PeelInMemory::request();
    request.region = {Box{{0.2, 0.2, -1.0}, {0.8, 0.7, 1.0}}};
    return request;
  }
  static std::vector<double> property(const Mesh& mesh, const std::string& name) {
    for (const ExtraAttribute& extra : mesh.attributes().vertex_extras) {
      if (extra.name == name) return extra.values;
    }
    return {};
  }
  static Positions vectors(const Mesh& mesh) {
    const auto x = property(mesh, "coating_x");
    const auto y = property(mesh, "coating_y");
    const auto z = property(mesh, "coating_z");
    Positions result;
    for (std::size_t v = 0; v < x.size(); ++v) result.emplace_back(x[v], y.at(v), z.at(v));
    return result;
  }

  const Mesh mesh_ = uneven_relief(24, 4.0, kBumpHeight, 7);
};

TEST_F(PeelInMemory, WhatCameOffAddedToTheSmoothMeshIsTheMesh) {
  const Peeled peeled = peel(mesh_, request());
  Positions sum = peeled.mesh.positions;
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] += peeled.displacement.at(v);
  EXPECT_LT(largest_distance(sum, mesh_.positions), 1e-15);
  EXPECT_GT(peeled.largest_coating, 0.5 * kBumpHeight);
  EXPECT_EQ(peeled.moved.size(), 23U * 23U) << "all but the sheet's boundary";
  EXPECT_THAT(peeled.warnings, IsEmpty());
}

TEST_F(PeelInMemory, ChangesNothingButThePositionsInsideTheRegion) {
  const PeelRequest middle = of_the_middle();
  const Peeled peeled = peel(mesh_, middle);
  EXPECT_EQ(peeled.mesh.face_vertices(), mesh_.face_vertices());
  const VertexSet region = resolve(middle.region, mesh_);
  EXPECT_LT(peeled.moved.size(), region.size()) << "the region's border stays";
  EXPECT_THAT(subtract(peeled.moved, region), IsEmpty());
  const auto moves = vertex_mask(mesh_.vertex_count(), peeled.moved);
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    const bool is_same = peeled.mesh.positions[v] == mesh_.positions[v];
    EXPECT_EQ(is_same, moves[v] == 0) << v;
    EXPECT_EQ(peeled.displacement[v].isZero(0.0), is_same) << v;
  }
}

TEST_F(PeelInMemory, SmoothsAsFairingDoesByTheWeightsGiven) {
  const Topology& topology = mesh_.topology();
  std::vector<Positions> smooth;
  for (const auto weights : {LaplacianWeights::uniform, LaplacianWeights::cotangent}) {
    PeelRequest weighed = request();
    weighed.weights = weights;
    smooth.push_back(peel(mesh_, weighed).mesh.positions);
    const Fairing fairing(mesh_.positions, topology, every_vertex(mesh_), weights);
    EXPECT_EQ(smooth.back(), fairing.smooth(weighed.detail_size));
  }
  EXPECT_NE(smooth[0], smooth[1]);
}

TEST_F(PeelInMemory, TakesMoreOffByALargerDetailSize) {
  PeelRequest smaller = request();
  smaller.detail_size = 0.05;
  const Peeled little = peel(mesh_, smaller);
  const Peeled much = peel(mesh_, request());
  EXPECT_GT(little.mean_coating, 0.0);
  EXPECT_GT(much.mean_coating, 3.0 * little.mean_coating);
  EXPECT_GT(much.largest_coating, much.mean_coating);
  double squares = 0.0;
  for (const Index v : much.moved) squares += much.displacement[v].squaredNorm();
  EXPECT_NEAR(much.mean_coating, std::sqrt(squares / static_cast<double>(much.moved.size())),
              1e-15);
}

TEST_F(PeelInMemory, ASmoothMeshCarriesItsCoating) {
  const Peeled peeled = peel(mesh_, request());
  const Mesh carrying = with_coating(mesh_, request(), peeled, CarriedCoating::displacement);
  EXPECT_EQ(carrying.positions, peeled.mesh.positions);
  EXPECT_EQ(vectors(carrying), peeled.displacement);
  // The smooth sheet is nearly flat, so that its normals are nearly the z axis.
  const auto height =
      property(with_coating(mesh_, request(), peeled, CarriedCoating::height), "coating_height");
  ASSERT_EQ(height.size(), mesh_.vertex_count());
  for (std::size_t v = 0; v < height.size(); ++v) {
    EXPECT_NEAR(height[v], peeled.displacement[v].z(), 0.1 * kBumpHeight) << v;
  }
}

TEST_F(PeelInMemory, CarriedLaplaciansAreThoseOfTheCoating) {
  PeelRequest uniform = request();
  uniform.weights = LaplacianWeights::uniform;
  const Peeled peeled = peel(mesh_, uniform);
  const Positions xi = vectors(with_coating(mesh_, uniform, peeled, CarriedCoating::laplacians));
  ASSERT_EQ(xi.size(), mesh_.vertex_count());
  const Topology& topology = mesh_.topology();
  for (Index v = 0; v < mesh_.vertex_count(); ++v) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Index j : topology.rings[v]) mean += peeled.displacement[j];
    mean /= static_cast<double>(topology.rings[v].size());
    EXPECT_LT((xi[v] - (peeled.displacement[v] - mean)).norm(), 1e-15) << v;
  }
}

TEST_F(PeelInMemory, ACoatingTakesThePlaceOfTheLastOneAndOfNothingElse) {
  Mesh coloured = mesh_;
  coloured.edit_attributes().vertex_extras = {
      {"quality", "float", 1, std::vector<double>(mesh_.vertex_count(), 0.5)}};
  const auto carry = [&](const Mesh& mesh) {
    return with_coating(mesh, request(), peel(mesh, request()), CarriedCoating::displacement);
  };
  const Mesh once = carry(coloured);
  const Mesh twice = carry(once);
  EXPECT_THAT(twice.attributes().vertex_extras, SizeIs(4));
  EXPECT_EQ(property(twice, "quality"), property(coloured, "quality"));
  EXPECT_EQ(vectors(twice), peel(once, request()).displacement);
}

TEST_F(PeelInMemory, NamesAVertexThatIsNotFiniteAndWorksAroundIt) {
  Mesh broken = mesh_;
  broken.positions[312].y() = std::numeric_limits<double>::quiet_NaN();
  PeelRequest whole = request();
  whole.region.where = "the whole";
  EXPECT_THAT(error_message<InputError>([&] { peel(broken, whole); }),
              AllOf(HasSubstr("at vertex 312"), HasSubstr("check --fix")));
  PeelRequest rest = request();
  rest.region = {DifferenceRegion{{{AllVertices{}}, {ListedVertices{{312}}}}}};
  const Peeled peeled = peel(broken, rest);
  EXPECT_GT(peeled.mean_coating, 0.0);
  EXPECT_TRUE(peeled.displacement[312].isZero(0.0));
}

TEST_F(PeelInMemory, NamesWhatDoesNotFit) {
  PeelRequest beyond = request();
  beyond.region = {ListedVertices{{999999}}, "bumps"};
  EXPECT_THAT(error_message<InputError>([&] { peel(mesh_, beyond); }),
              AllOf(StartsWith("bumps/vertices/0: "), HasSubstr("999999")));
  PeelRequest none;
  EXPECT_THAT(error_message<InputError>([&] { peel(mesh_, none); }),
              StartsWith("peel: expected a length above 0"));
  none.where = "the size";
  EXPECT_THAT(error_message<InputError>([&] { peel(mesh_, none); }), StartsWith("the size: "));
}

TEST_F(PeelInMemory, WarnsWhereNothingCanMove) {
  PeelRequest thin = request();
  thin.region = {ListedVertices{{0, 1, 2}}};
  const Peeled peeled = peel(mesh_, thin);
  EXPECT_EQ(peeled.mesh.positions, mesh_.positions);
  EXPECT_EQ(peeled.mean_coating, 0.0);
  EXPECT_THAT(peeled.warnings, ElementsAre(HasSubstr("no detail was removed")));
}

}  // namespace
}  // namespace lapwing::test
