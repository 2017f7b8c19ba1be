// Many results of one request.
#include "lapwing/deform/prepared_deform.h"

#include <atomic>
#include <mutex>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deform/mirror_scenes.h"
#include "lapwing/base/errors.h"
#include "support/bent_tube.h"
#include "support/error_message.h"
#include "support/split_meshes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::Each;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ManyOfOneEdit : public ::testing::Test {
 protected:
  static Move move(std::size_t k) {
    SimilarityMove move;
    move.translate = Vector3d(0.1 * static_cast<double>(k), 0.0, 0.0);
    move.rotate = {Vector3d::UnitZ(), 9.0 * static_cast<double>(k)};
    return move;
  }

  DeformRequest request(const Move& move = {}) const { return test::moved_head(region_, move); }

  const Mesh mesh_ = test::bumpy_tube();
  const EditRegion region_ = test::foot_and_head(mesh_);
};

TEST_F(ManyOfOneEdit, EachIsWhatDeformMakes) {
  PreparedDeform prepared(mesh_, request(move(5)));
  for (const std::size_t k : {3U, 0U, 7U}) {
    const Deformed once = deform(mesh_, request(move(k)));
    const Deformed again = prepared.solve(std::vector{move(k)});
    EXPECT_EQ(again.mesh.positions, once.mesh.positions) << k;
    EXPECT_EQ(again.certificate.detail_error, once.certificate.detail_error) << k;
  }
  EXPECT_EQ(prepared.region().handles[0], region_.handles[0]);
  EXPECT_EQ(prepared.mesh().positions, mesh_.positions);
}

TEST_F(ManyOfOneEdit, AreTheSameOnAnyNumberOfThreadsAndEachComesOnce) {
  constexpr std::size_t kCount = 9;
  PreparedDeform prepared(mesh_, request());
  std::vector<Positions> alone;
  for (std::size_t k = 0; k < kCount; ++k) {
    alone.push_back(prepared.solve(std::vector{move(k)}).mesh.positions);
  }
  for (const unsigned threads : {1U, 2U, 5U, 0U}) {
    std::vector<Positions> together(kCount);
    std::vector<int> times(kCount);  // each element has one writer
    prepared.solve_many(
        kCount, [](std::size_t k) { return std::vector{move(k)}; },
        [&](std::size_t k, Deformed&& result) {
          ++times[k];
          together[k] = std::move(result.mesh.positions);
        },
        threads);
    EXPECT_THAT(together, ElementsAreArray(alone)) << threads;
    EXPECT_THAT(times, Each(1)) << threads;
  }
}

TEST_F(ManyOfOneEdit, TheFirstErrorEndsItAndNamesItsMotion) {
  PreparedDeform prepared(mesh_, request());
  const auto solve = [&](unsigned threads) {
    prepared.solve_many(
        40, [](std::size_t k) { return k == 6 ? std::vector<Move>{} : std::vector{move(1)}; },
        [](std::size_t, Deformed&&) {}, threads);
  };
  for (const unsigned threads : {1U, 3U}) {
    EXPECT_THAT(error_message<InputError>([&] { solve(threads); }),
                StartsWith("motion 6: the edit has 1 handles, but 0 moves were given"));
  }
}

TEST_F(ManyOfOneEdit, ProgressIsHeardOnTheCallersThreadAndCancelsAll) {
  PreparedDeform prepared(mesh_, request());
  const auto here = std::this_thread::get_id();
  std::atomic<bool> elsewhere = false;
  int heard = 0;
  const Progress progress = [&](std::string_view stage, double) {
    elsewhere = elsewhere || std::this_thread::get_id() != here;
    EXPECT_EQ(stage, "solve_many");
    return ++heard < 3;
  };
  const auto moves = [](std::size_t) { return std::vector{move(2)}; };
  const auto drop = [](std::size_t, Deformed&&) {};
  EXPECT_THROW(prepared.solve_many(1000, moves, drop, 2, progress), Cancelled);
  EXPECT_FALSE(elsewhere);
  EXPECT_NO_THROW(prepared.solve_many(0, moves, drop));
}

TEST_F(ManyOfOneEdit, WhatIsWrongWithTheRequestIsSaidWhenItIsPrepared) {
  DeformRequest outside = request();
  outside.roi = {ListedVertices{region_.belt}};
  std::string message;
  std::vector<Index> vertices;
  try {
    PreparedDeform(mesh_, outside);
  } catch (const InputError& error) {
    message = error.what();
    vertices = error.vertices();
  }
  EXPECT_THAT(message, HasSubstr("extends beyond the ROI"));
  EXPECT_EQ(vertices, region_.handles[0]);
}

// The vertices of a mesh where one motion for each of the response's handles takes them.
Positions followed(const Mesh& mesh, const SurfaceResponse& response,
                   const std::vector<Eigen::Affine3d>& motions) {
  Positions positions = mesh.positions;
  for (std::size_t h = 0; h < motions.size(); ++h) {
    const Vector3d& c = response.centers[h];
    const Vector3d way = motions[h] * c - c;
    for (Eigen::Index a = 0; a < 3; ++a) {
      for (Eigen::Index b = 0; b < 4; ++b) {
        const double by = b == 3 ? way[a] : motions[h].linear()(a, b) - (a == b ? 1.0 : 0.0);
        const auto column =
            response.column(h, static_cast<std::size_t>(a), static_cast<std::size_t>(b));
        for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += by * column[v];
      }
    }
  }
  return positions;
}

Eigen::Affine3d stirred(double size, double scale = 1.2) {
  return Eigen::Translation3d(0.1 * size, -0.2 * size, 0.15 * size) *
         Eigen::AngleAxisd(0.4, Vector3d(1, 2, 2).normalized()) * Eigen::Scaling(scale);
}

Move as_move(const Eigen::Affine3d& motion) {
  return MatrixMove{motion.affine()};
}

// Largest distance between what the response adds up to and a whole solve without settling, as a
// share of the diagonal. The handles without a motion rest.
double off_from_solve(const Mesh& mesh, DeformRequest request, std::vector<std::size_t> handles,
                      const std::vector<Eigen::Affine3d>& motions) {
  PreparedDeform settling(mesh, request);
  const SurfaceResponse response = settling.response(handles);
  for (MovedHandle& handle : request.handles) handle.move = as_move(Eigen::Affine3d::Identity());
  for (std::size_t k = 0; k < handles.size(); ++k) {
    request.handles[handles[k]].move = as_move(motions[k]);
  }
  request.parameters.settle.reset();
  const Deformed solved = deform(mesh, request);
  const double diagonal = bounds_of(mesh.positions).diagonal();
  EXPECT_GT(test::largest_distance(solved.mesh.positions, mesh.positions), 0.05 * diagonal);
  return test::largest_distance(followed(mesh, response, motions), solved.mesh.positions) /
         diagonal;
}

constexpr double kSameSurface = 1e-9;

TEST_F(ManyOfOneEdit, TheResponseAddsUpToAWholeSolve) {
  EXPECT_LT(off_from_solve(mesh_, request(), {0}, {stirred(1.0)}), kSameSurface);
  PreparedDeform prepared(mesh_, request());
  EXPECT_EQ(followed(mesh_, prepared.response(std::vector<std::size_t>{0}),
                     {Eigen::Affine3d::Identity()}),
            mesh_.positions);
}

TEST_F(ManyOfOneEdit, TheResponseIsTheSameAfterASolveThatLeftAnotherPose) {
  DeformRequest in_parts = request();
  in_parts.parameters.commit_every = 90.0;
  PreparedDeform prepared(mesh_, in_parts);
  const std::vector<std::size_t> handles{0};
  const SurfaceResponse before = prepared.response(handles);
  SimilarityMove far;
  far.rotate = {Vector3d::UnitZ(), 400.0};
  ASSERT_GT(prepared.solve(std::vector<Move>{far}).commits, 1U);
  EXPECT_EQ(prepared.response(handles).columns, before.columns);
}

TEST_F(ManyOfOneEdit, AResponseIsToTheHandlesThatAreAskedFor) {
  DeformRequest two = request();
  const auto middle = static_cast<Index>(mesh_.vertex_count() / 2);
  two.handles.insert(two.handles.begin(), MovedHandle{{ListedVertices{{middle, middle + 1}}}, {}});
  EXPECT_LT(off_from_solve(mesh_, two, {1}, {stirred(1.0)}), kSameSurface);
  EXPECT_LT(off_from_solve(mesh_, two, {1, 0}, {stirred(1.0), stirred(0.5)}), kSameSurface);
  PreparedDeform prepared(mesh_, two);
  EXPECT_THAT(error_message<InputError>([&] { prepared.response(std::vector<std::size_t>{2}); }),
              StartsWith("the edit has 2 handles, numbered from 0; handle 2 does not exist"));
  EXPECT_TRUE(prepared.response({}).columns.empty());
  const auto stop = [](std::string_view, double) { return false; };
  EXPECT_THROW(prepared.response(std::vector<std::size_t>{0}, stop), Cancelled);
}

TEST(AResponse, OfOneVertexIsToItsWayAlone) {
  Mesh mesh = grid(12, 12);
  for (Vector3d& p : mesh.positions) p *= 1e-12;
  DeformRequest request;
  request.roi = {AllVertices{}};
  request.handles = {{{ListedVertices{{84}}}, {}}};
  EXPECT_LT(off_from_solve(mesh, request, {0}, {stirred(1e-12)}), kSameSurface);
}

TEST(AResponse, HasTheImagesOfMirroredHandlesGoAlong) {
  for (const test::MirrorScene& scene :
       {test::sheet_scene(), test::tube_scene(), test::ball_scene()}) {
    DeformRequest request = scene.request();
    request.handles = {{scene.across, {}}, {scene.side, {}}};
    const double size = scene.diagonal();
    EXPECT_LT(off_from_solve(scene.mesh, request, {0}, {stirred(size)}), kSameSurface);
    EXPECT_LT(off_from_solve(scene.mesh, request, {1, 0}, {stirred(size), stirred(0.5 * size)}),
              kSameSurface);
  }
}

TEST(AResponse, KeepsSeamsClosed) {
  const Mesh whole = test::bumpy_tube();
  const test::SplitMesh split = test::soup(whole);
  DeformRequest request;
  request.roi = {AllVertices{}};
  request.belt = RegionSpec{Box{{-9, -9, -9}, {9, 9, 0.1}}};
  request.handles = {{{Box{{-9, -9, 2.9}, {9, 9, 9}}}, {}}};
  EXPECT_LT(off_from_solve(split.mesh, request, {0}, {stirred(1.0)}), kSameSurface);
}

}  // namespace
}  // namespace lapwing
