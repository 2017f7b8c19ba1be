// Compares the inner loops of every instruction set with plain loops.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "lapwing/elastic/embedding_loops.h"
#include "lapwing/elastic/history_loops.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

double number(std::size_t k) {
  return std::sin(1.0 + 3.7 * static_cast<double>(k));
}

// Ten vertices of a mesh with twenty, and nine coarse vertices with different motions.
class EmbeddedVertices : public ::testing::Test {
 protected:
  static constexpr std::size_t kCarried = 10;
  static constexpr std::size_t kCoarse = 9;

  void SetUp() override {
    for (std::size_t c = 0; c < kCoarse; ++c) {
      RowsOfMotion& motion = motions_.emplace_back();
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t k = 0; k < 4; ++k) motion.row[a][k] = number(12 * c + 4 * a + k);
      }
    }
    for (std::size_t k = 0; k < kCarried; ++k) {
      vertices_.push_back(static_cast<std::uint32_t>(2 * k + 1));
      EmbeddedVertex& embedded = embedded_.emplace_back();
      // The last ones have fewer nodes.
      for (std::size_t node = 0; node < std::min(kEmbeddingNodes, kCarried - k); ++node) {
        embedded.nodes[node] = static_cast<std::uint32_t>((k + node) % kCoarse);
        embedded.weights[node] = 0.1 + std::abs(number(8 * k + node));
      }
    }
    for (std::size_t k = 0; k < 6 * kCarried; ++k) {
      rest_.push_back(number(k + 500));
      u_.push_back(0.1 * number(k + 900));
    }
  }
  Vector3d moved(std::size_t k) const {
    const std::size_t at = 3 * vertices_[k];
    Vector3d u = Eigen::Map<const Vector3d>(u_.data() + at);
    const Vector3d place = Eigen::Map<const Vector3d>(rest_.data() + at) + u - kOrigin;
    for (std::size_t node = 0; node < kEmbeddingNodes; ++node) {
      using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
      const Eigen::Map<const Rows> motion(motions_[embedded_[k].nodes[node]].row[0]);
      u += embedded_[k].weights[node] * (motion.leftCols<3>() * place + motion.col(3));
    }
    return u;
  }

  const Vector3d kOrigin{0.5, -2.0, 1.0};
  std::vector<RowsOfMotion> motions_;
  std::vector<std::uint32_t> vertices_;
  std::vector<EmbeddedVertex> embedded_;
  std::vector<double> rest_;
  std::vector<double> u_;
};

TEST_F(EmbeddedVertices, EveryInstructionSetMovesVerticesByTheirWeightedMotions) {
  constexpr std::size_t kFirst = 1;
  constexpr std::size_t kLast = 9;
  const CarriedVertices carried{vertices_.data(),
                                embedded_.data(),
                                motions_.data(),
                                rest_.data(),
                                {kOrigin.x(), kOrigin.y(), kOrigin.z()}};
  for (const InstructionSet set : available_instruction_sets()) {
    std::vector<double> u = u_;
    embedding_loops(set).carry(carried, kFirst, kLast, u.data());
    for (std::size_t v = 0; v < 2 * kCarried; ++v) {
      const Vector3d is(&u[3 * v]);
      if (v % 2 == 1 && v / 2 >= kFirst && v / 2 < kLast) {
        EXPECT_LT((is - moved(v / 2)).norm(), 1e-12) << v << " by " << instruction_set_name(set);
      } else {
        EXPECT_EQ(is, Vector3d(&u_[3 * v])) << v << " by " << instruction_set_name(set);
      }
    }
  }
}

// Counts that are no whole number of registers among them.
TEST(HistoryLoops, EveryInstructionSetComesToTheSumsAsTheyRead) {
  for (const std::size_t count : {0, 1, 7, 16, 37, 1024}) {
    std::vector<float> a;
    std::vector<float> b;
    std::vector<double> x;
    double a_x = 0.0;
    double a_b = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      a.push_back(static_cast<float>(number(k)));
      b.push_back(static_cast<float>(number(k + 2000)));
      x.push_back(number(k + 4000));
      a_x += static_cast<double>(a[k]) * x[k];
      a_b += static_cast<double>(a[k]) * static_cast<double>(b[k]);
    }
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(std::string(instruction_set_name(set)) + ", " + std::to_string(count));
      const HistoryLoops& loops = history_loops(set);
      EXPECT_NEAR(loops.multiply(a.data(), x.data(), count), a_x, 1e-12);
      EXPECT_NEAR(loops.dot(a.data(), b.data(), count), a_b, 1e-12);
      std::vector<double> y = x;
      loops.subtract(0.3, a.data(), y.data(), count);
      for (std::size_t k = 0; k < count; ++k) {
        EXPECT_NEAR(y[k], x[k] - 0.3 * static_cast<double>(a[k]), 1e-15) << k;
      }
    }
  }
}

}  // namespace
}  // namespace lapwing
