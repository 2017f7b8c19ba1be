#include "lapwing/vulkan/blend_response.h"

#include <random>

#include <gtest/gtest.h>

#include "kernels/awkward_meshes.h"
#include "kernels/moved_mesh.h"
#include "kernels/twins.h"
#include "lapwing/base/errors.h"
#include "support/largest_distance.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using test::Sample;

std::vector<double> random_numbers(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> numbers(count);
  for (double& number : numbers) number = uniform(generator);
  return numbers;
}

// Every third vertex moves, by `columns` random columns.
struct Drag {
  Drag(const Sample& on, std::size_t column_count, unsigned seed)
      : sample(on), columns(column_count) {
    for (Index v = 0; v < on.vertices.size(); v += 3) moving.push_back(v);
    basis = random_numbers(3 * moving.size() * columns, seed);
    parameters = random_numbers(columns, seed + 1);
  }
  ResponseColumns response() const { return {moving, columns, basis}; }

  const Sample& sample;
  std::size_t columns;
  std::vector<Index> moving;
  std::vector<double> basis;
  std::vector<double> parameters;
};

class BlendResponseKernel : public test::KernelTest {
 protected:
  test::MovedMesh mesh_of(const Drag& drag) { return mesh_of(drag, drag.response()); }
  test::MovedMesh mesh_of(const Drag& drag, const ResponseColumns& response) {
    return {context, drag.sample.mesh.positions, drag.sample.topology, response};
  }
  static test::MovedMesh expected_of(const Drag& drag) {
    return {nullptr, drag.sample.mesh.positions, drag.sample.topology, drag.response()};
  }
};

TEST_P(BlendResponseKernel, AgreesWithTheCpuTwin) {
  for (const Sample& sample : test::awkward_meshes()) {
    // These counts include multiples of four and others, because devices read four columns at once.
    for (const std::size_t columns : {0U, 1U, 4U, 5U, 12U, 13U}) {
      const Drag drag(sample, columns, 11);
      auto expected = expected_of(drag);
      auto surface = mesh_of(drag);
      expected.blend(drag.parameters);
      surface.blend(drag.parameters);
      const double size =
          bounds_of(sample.mesh.positions).diagonal() + static_cast<double>(columns);
      EXPECT_LE(test::largest_distance(surface.positions(), expected.positions()),
                surface_tolerance() * size)
          << sample.name << " columns " << columns;
    }
  }
}

TEST_P(BlendResponseKernel, StillHandleBringsTheRestShapeBack) {
  const Sample sample("rough sphere", test::rough_sphere(2, 0.2, 12));
  Drag drag(sample, 12, 13);
  auto surface = mesh_of(drag);
  const Positions rest = surface.positions();
  EXPECT_LE(test::largest_distance(rest, sample.mesh.positions), surface_tolerance());
  surface.blend(drag.parameters);
  EXPECT_GT(test::largest_distance(rest, surface.positions()), 0.1);
  surface.blend(std::vector(12, 0.0));
  EXPECT_EQ(surface.positions(), rest);
}

TEST_P(BlendResponseKernel, SkippedColumnsAddNothing) {
  const Sample sample("rough sphere", test::rough_sphere(1, 0.2, 14));
  Drag drag(sample, 12, 15);
  auto expected = expected_of(drag);
  auto surface = mesh_of(drag);
  for (std::size_t only = 0; only < drag.columns; ++only) {
    std::vector parameters(drag.columns, 0.0);
    parameters[only] = 0.7;
    expected.blend(parameters);
    surface.blend(parameters);
    EXPECT_LE(test::largest_distance(surface.positions(), expected.positions()),
              4 * surface_tolerance())
        << "column " << only;
  }
}

TEST_P(BlendResponseKernel, BasisAlongAxesIsOneWithZerosAcross) {
  const Sample sample("rough sphere", test::rough_sphere(2, 0.2, 18));
  Drag drag(sample, 24, 19);
  const std::size_t n = drag.moving.size();
  const std::vector<double> numbers = random_numbers(8 * n, 20);
  std::fill(drag.basis.begin(), drag.basis.end(), 0.0);
  for (std::size_t column = 0; column < drag.columns; ++column) {
    const std::size_t axis = column % 12 / 4;
    const std::size_t from = 4 * (column / 12) + column % 4;
    for (std::size_t m = 0; m < n; ++m) {
      drag.basis[3 * (column * n + m) + axis] = numbers[from * n + m];
    }
  }
  auto expected = mesh_of(drag);
  auto surface = mesh_of(drag, {drag.moving, drag.columns, numbers, true});
  expected.blend(drag.parameters);
  surface.blend(drag.parameters);
  EXPECT_EQ(surface.positions(), expected.positions());
}

TEST_P(BlendResponseKernel, RepeatsBitForBit) {
  const Sample sample("rough sphere", test::rough_sphere(2, 0.2, 16));
  const Drag drag(sample, 12, 17);
  auto surface = mesh_of(drag);
  surface.blend(drag.parameters);
  const Positions first = surface.positions();
  surface.blend(std::vector(12, 1.0));
  surface.blend(drag.parameters);
  EXPECT_EQ(surface.positions(), first);
}

LAPWING_ON_ALL_TWINS(BlendResponseKernel);

// Splits the columns into buffers of at most `most_bytes` bytes.
class BlendResponseBuffers : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    context = std::make_shared<gpu::Context>();
  }

  std::vector<float> blend(std::size_t most_bytes, bool on_host) const {
    gpu::Transfer transfer(*context);
    BlendResponse response(context, transfer, drag.response(), sample.topology, most_bytes);
    response.set_rest(transfer, sample.mesh.positions, {}, Vector3d::Zero());
    const gpu::Kernel kernel = BlendResponse::kernel(*context);
    const gpu::Buffer positions(*context, "positions", 16 * sample.vertices.size());
    gpu::CommandList list(*context, "blend");
    gpu::Recorder recorder(list);
    recorder.fill(positions, 0);
    if (!on_host) response.record(recorder, kernel, positions);
    recorder.finish();
    response.set_parameters(drag.parameters);
    list.run();
    if (on_host) response.run_on_host(positions.mapped_as<Vec4>());
    std::vector<float> values(4 * sample.vertices.size());
    transfer.download(positions, std::span(values));
    return values;
  }

  std::shared_ptr<gpu::Context> context;
  const Sample sample{"rough sphere", test::rough_sphere(2, 0.2, 18)};
  const Drag drag{sample, 12, 19};
};

TEST_F(BlendResponseBuffers, OfASplitBasisGiveTheSameBits) {
  EXPECT_EQ(blend(1600, false), blend(0, false));
}

TEST_F(BlendResponseBuffers, AreBlendedOnTheHostAsByTheShader) {
  const gpu::Buffer probe(*context, "probe", 16);
  if (probe.mapped().empty()) GTEST_SKIP() << "device memory is not mapped";
  for (const std::size_t most_bytes : {0U, 1600U}) {
    const std::vector<float> expected = blend(most_bytes, false);
    const std::vector<float> values = blend(most_bytes, true);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i % 4 == 3) continue;  // blending does not set w
      EXPECT_NEAR(values[i], expected[i], 2e-5) << "number " << i;
    }
  }
}

TEST(BlendResponse, WrongNumberOfParametersIsRefused) {
  LAPWING_NEEDS_GPU();
  const Sample sample("rough sphere", test::rough_sphere(1, 0.2, 20));
  const Drag drag(sample, 3, 21);
  test::MovedMesh mesh(std::make_shared<gpu::Context>(), sample.mesh.positions, sample.topology,
                       drag.response());
  EXPECT_THROW(mesh.blend(std::vector(4, 1.0)), InputError);
}

}  // namespace
}  // namespace lapwing
