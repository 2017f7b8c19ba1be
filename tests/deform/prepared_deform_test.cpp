// Many results of one request.
#include "lapwing/deform/prepared_deform.h"

#include <atomic>
#include <mutex>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/bent_tube.h"
#include "support/error_message.h"

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
  EXPECT_THAT(message, HasSubstr("leaves the roi"));
  EXPECT_EQ(vertices, region_.handles[0]);
}

}  // namespace
}  // namespace lapwing
