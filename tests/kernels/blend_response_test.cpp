#include "lapwing/vulkan/blend_response.h"

#include <random>

#include <gtest/gtest.h>

#include "kernels/awkward_meshes.h"
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
  SurfaceInput input() const {
    return {sample.mesh.positions, sample.topology, moving, basis, columns};
  }

  const Sample& sample;
  std::size_t columns;
  std::vector<Index> moving;
  std::vector<double> basis;
  std::vector<double> parameters;
};

class BlendResponseKernel : public test::KernelTest {};

TEST_P(BlendResponseKernel, AgreesWithTheCpuTwin) {
  CpuKernels cpu;
  for (const Sample& sample : test::awkward_meshes()) {
    // Numbers of columns around the groups of four that devices read.
    for (const std::size_t columns : {0U, 1U, 4U, 5U, 12U, 13U}) {
      const Drag drag(sample, columns, 11);
      const auto expected = cpu.make_surface(drag.input());
      const auto surface = kernels->make_surface(drag.input());
      expected->blend(drag.parameters);
      surface->blend(drag.parameters);
      const double size =
          bounds_of(sample.mesh.positions).diagonal() + static_cast<double>(columns);
      EXPECT_LE(test::largest_distance(surface->positions(), expected->positions()),
                surface_tolerance() * size)
          << sample.name << " columns " << columns;
    }
  }
}

TEST_P(BlendResponseKernel, StillHandleBringsTheRestShapeBack) {
  const Sample sample("rough sphere", test::rough_sphere(2, 0.2, 12));
  Drag drag(sample, 12, 13);
  const auto surface = kernels->make_surface(drag.input());
  const Positions rest = surface->positions();
  EXPECT_LE(test::largest_distance(rest, sample.mesh.positions), surface_tolerance());
  surface->blend(drag.parameters);
  EXPECT_GT(test::largest_distance(rest, surface->positions()), 0.1);
  surface->blend(std::vector(12, 0.0));
  EXPECT_EQ(surface->positions(), rest);
}

TEST_P(BlendResponseKernel, SkippedColumnsAddNothing) {
  const Sample sample("rough sphere", test::rough_sphere(1, 0.2, 14));
  Drag drag(sample, 12, 15);
  CpuKernels cpu;
  const auto expected = cpu.make_surface(drag.input());
  const auto surface = kernels->make_surface(drag.input());
  for (std::size_t only = 0; only < drag.columns; ++only) {
    std::vector parameters(drag.columns, 0.0);
    parameters[only] = 0.7;
    expected->blend(parameters);
    surface->blend(parameters);
    EXPECT_LE(test::largest_distance(surface->positions(), expected->positions()),
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
  const auto expected = kernels->make_surface(drag.input());
  const auto surface = kernels->make_surface(
      {sample.mesh.positions, sample.topology, drag.moving, {}, drag.columns});
  surface->set_axis_basis(numbers);
  expected->blend(drag.parameters);
  surface->blend(drag.parameters);
  EXPECT_EQ(surface->positions(), expected->positions());
}

TEST_P(BlendResponseKernel, BasisMayBeGivenLaterAndAgain) {
  const Sample sample("rough sphere", test::rough_sphere(2, 0.2, 21));
  const Drag drag(sample, 13, 22);
  const Drag other(sample, 13, 23);
  const auto expected = kernels->make_surface(drag.input());
  const auto surface = kernels->make_surface(
      {sample.mesh.positions, sample.topology, drag.moving, {}, drag.columns});
  surface->set_basis(other.basis);
  surface->blend(drag.parameters);
  surface->set_basis(drag.basis);
  expected->blend(drag.parameters);
  surface->blend(drag.parameters);
  EXPECT_EQ(surface->positions(), expected->positions());
}

TEST_P(BlendResponseKernel, RepeatsBitForBit) {
  const Sample sample("rough sphere", test::rough_sphere(2, 0.2, 16));
  const Drag drag(sample, 12, 17);
  const auto surface = kernels->make_surface(drag.input());
  surface->blend(drag.parameters);
  const Positions first = surface->positions();
  surface->blend(std::vector(12, 1.0));
  surface->blend(drag.parameters);
  EXPECT_EQ(surface->positions(), first);
}

LAPWING_ON_ALL_TWINS(BlendResponseKernel);

// A blend with at most so many texels of the basis in a buffer.
class BlendResponseBuffers : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    state = std::make_unique<VulkanState>(std::make_shared<gpu::Context>(), false);
  }

  std::vector<float> blend(std::size_t most_texels, bool on_host) const {
    BlendResponse response(*state, drag.input(), Vector3d::Zero(), most_texels);
    const gpu::Buffer positions(*state->context, "positions", 16 * sample.vertices.size());
    gpu::CommandList list(*state->context, "blend");
    gpu::Recorder recorder(list);
    recorder.fill(positions, 0);
    if (!on_host) response.record(recorder, positions);
    recorder.finish();
    response.set_parameters(drag.parameters);
    list.run();
    if (on_host) response.run_on_host(positions.mapped_as<Vec4>());
    std::vector<float> values(4 * sample.vertices.size());
    state->transfer.download(positions, std::span(values));
    return values;
  }

  std::unique_ptr<VulkanState> state;
  const Sample sample{"rough sphere", test::rough_sphere(2, 0.2, 18)};
  const Drag drag{sample, 12, 19};
};

TEST_F(BlendResponseBuffers, OfASplitBasisGiveTheSameBits) {
  EXPECT_EQ(blend(100, false), blend(0, false));
}

TEST_F(BlendResponseBuffers, AreBlendedOnTheHostAsByTheShader) {
  const gpu::Buffer probe(*state->context, "probe", 16);
  if (probe.mapped().empty()) GTEST_SKIP() << "device memory is not mapped";
  for (const std::size_t most_texels : {0U, 100U}) {
    const std::vector<float> expected = blend(most_texels, false);
    const std::vector<float> values = blend(most_texels, true);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i % 4 == 3) continue;  // w, which only the surface's own positions set
      EXPECT_NEAR(values[i], expected[i], 2e-5) << "number " << i;
    }
  }
}

TEST(BlendResponse, WrongNumberOfParametersIsRefused) {
  LAPWING_NEEDS_GPU();
  const Sample sample("rough sphere", test::rough_sphere(1, 0.2, 20));
  const Drag drag(sample, 3, 21);
  VulkanKernels kernels;
  EXPECT_THROW(kernels.make_surface(drag.input())->blend(std::vector(4, 1.0)), InputError);
}

}  // namespace
}  // namespace lapwing
