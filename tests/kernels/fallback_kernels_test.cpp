#include "lapwing/kernels/fallback_kernels.h"

#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/awkward_meshes.h"
#include "kernels/turned_rings.h"
#include "lapwing/base/errors.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/kernels/timed_kernels.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// The number of calls until the device fails. All later calls also fail.
struct Life {
  long calls_left = 0;

  void call() {
    if (calls_left-- <= 0) throw GpuError("the test's device is gone");
  }
};

class MortalRotations final : public RingRotations {
 public:
  MortalRotations(std::shared_ptr<const RegionRings> rings, std::shared_ptr<Life> life)
      : twin_(CpuKernels().make_ring_rotations(std::move(rings))), life_(std::move(life)) {}

  void set_rest_stretch(std::span<const Eigen::Matrix3d> stretch) override {
    life_->call();
    twin_->set_rest_stretch(stretch);
  }
  void fit_rotations(std::span<const Vector3d> displacement, std::span<double> energies) override {
    life_->call();
    twin_->fit_rotations(displacement, energies);
  }
  void energy_gradient(std::span<double> g) override {
    life_->call();
    twin_->energy_gradient(g);
  }
  std::vector<Eigen::Matrix3d> transforms() const override {
    life_->call();
    return twin_->transforms();
  }

 private:
  std::unique_ptr<RingRotations> twin_;
  std::shared_ptr<Life> life_;
};

class MortalKernels final : public Kernels {
 public:
  explicit MortalKernels(long calls_left) { life_->calls_left = calls_left; }

  const DeviceInfo& device() const override { return info_; }
  void assemble_rsi(const RingProblem& problem, std::span<double> blocks) override {
    life_->call();
    twin_.assemble_rsi(problem, blocks);
  }
  void assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) override {
    life_->call();
    twin_.assemble_tangent(problem, blocks);
  }
  void sample_laplacians(const RingProblem& problem, std::span<Vector3d> laplacians) override {
    life_->call();
    twin_.sample_laplacians(problem, laplacians);
  }
  void sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                std::span<const Vector3d> source,
                                std::span<Vector3d> laplacians) override {
    life_->call();
    twin_.sample_mapped_laplacians(rings, sampling, source, laplacians);
  }
  void rotate_frames(const MappedRings& rings, const FramedSurface& source,
                     const FramedSurface& target, std::span<Eigen::Matrix3d> transforms) override {
    life_->call();
    twin_.rotate_frames(rings, source, target, transforms);
  }
  std::unique_ptr<RingRotations> make_ring_rotations(
      std::shared_ptr<const RegionRings> rings) override {
    life_->call();
    return std::make_unique<MortalRotations>(std::move(rings), life_);
  }

 private:
  CpuKernels twin_;
  DeviceInfo info_{"mortal", "discrete GPU", "of the test", true, true};
  std::shared_ptr<Life> life_ = std::make_shared<Life>();
};

FallbackKernels lives_for(long calls) {
  return FallbackKernels([calls] { return std::make_unique<MortalKernels>(calls); });
}

// Returns all kernel results that settling needs, for two displacements.
std::vector<double> turn(Kernels& on, const test::TurnedRings& turned) {
  const std::size_t rows = turned.rings.row_count();
  const auto rotations = on.make_ring_rotations(std::make_shared<RegionRings>(turned.rings));
  rotations->set_rest_stretch(
      std::vector<Eigen::Matrix3d>(rows, 1.25 * Eigen::Matrix3d::Identity()));
  std::vector<double> numbers;
  for (const double share : {0.5, 1.0}) {
    std::vector<Vector3d> displacement = turned.displacement;
    for (Vector3d& u : displacement) u *= share;
    std::vector<double> energies(rows);
    rotations->fit_rotations(displacement, energies);
    std::vector<double> gradient(3 * turned.rings.unknown_rows.size());
    rotations->energy_gradient(gradient);
    numbers.insert(numbers.end(), energies.begin(), energies.end());
    numbers.insert(numbers.end(), gradient.begin(), gradient.end());
  }
  for (const Eigen::Matrix3d& t : rotations->transforms()) {
    numbers.insert(numbers.end(), t.data(), t.data() + t.size());
  }
  return numbers;
}

TEST(FallbackKernels, RotationsAreTheSameWhereverTheDeviceFails) {
  const test::Sample sample = test::awkward_meshes().back();
  const test::TurnedRings turned = test::turned_rings(sample, 40.0, 0.1, 0.3, 5);
  CpuKernels cpu;
  const std::vector<double> expected = turn(cpu, turned);
  constexpr long kCalls = 7;
  for (long calls = 0; calls <= kCalls; ++calls) {
    FallbackKernels kernels = lives_for(calls);
    EXPECT_EQ(turn(kernels, turned), expected) << "after " << calls << " calls";
    EXPECT_EQ(kernels.device().name, calls < kCalls ? "CPU" : "mortal");
  }
}

TEST(FallbackKernels, ACallInWhichTheDeviceFailsIsDoneAgain) {
  const test::Sample sample = test::awkward_meshes().back();
  const auto weights =
      laplacian_weights(sample.topology, sample.mesh.positions, LaplacianWeights::uniform);
  const RingProblem problem{sample.mesh.positions, sample.topology.rings, weights, sample.vertices};
  const auto sampled = [&](Kernels& on) {
    std::vector<Vector3d> laplacians(sample.vertices.size(), Vector3d::Constant(7.0));
    on.sample_laplacians(problem, laplacians);
    return laplacians;
  };
  CpuKernels cpu;
  FallbackKernels kernels = lives_for(0);
  EXPECT_EQ(sampled(kernels), sampled(cpu));
}

TEST(FallbackKernels, SaysWhatFailed) {
  const test::Sample sample = test::awkward_meshes().back();
  FallbackKernels kernels = lives_for(1);
  EXPECT_EQ(kernels.device().name, "mortal");
  EXPECT_EQ(kernels.device().took_over, "");
  const test::TurnedRings turned = test::turned_rings(sample, 40.0, 0.1, 0.3, 5);
  turn(kernels, turned);
  EXPECT_EQ(kernels.device().type, "cpu");
  EXPECT_THAT(kernels.device().took_over, ::testing::HasSubstr("the test's device is gone"));
}

TEST(FallbackKernels, ADeviceThatCannotBeMadeIsTheCpuFromTheStart) {
  FallbackKernels kernels([]() -> std::unique_ptr<Kernels> { throw GpuError("no memory"); });
  EXPECT_EQ(kernels.device().name, "CPU");
  EXPECT_THAT(kernels.device().took_over, ::testing::HasSubstr("no memory"));
}

TEST(TimedKernels, CountEachKernelOnTheDeviceWhereItRan) {
  const test::Sample sample = test::awkward_meshes().back();
  const test::TurnedRings turned = test::turned_rings(sample, 40.0, 0.1, 0.3, 5);
  CpuKernels cpu;
  const std::vector<double> expected = turn(cpu, turned);
  // The device creates the rotations, sets their stretch, fits them and evaluates once. Then it
  // fails.
  FallbackKernels kernels = lives_for(4);
  TimedKernels timed(kernels);
  EXPECT_EQ(turn(timed, turned), expected);
  std::vector<std::tuple<std::string, std::string, std::size_t>> uses;
  for (const KernelTime& time : timed.times()) {
    uses.emplace_back(time.kernel, time.device, time.calls);
    EXPECT_GE(time.milliseconds, 0.0);
  }
  EXPECT_THAT(uses, ::testing::ElementsAre(std::tuple("fit_rotations", "mortal", 1U),
                                           std::tuple("energy_gradient", "mortal", 1U),
                                           std::tuple("fit_rotations", "CPU", 1U),
                                           std::tuple("energy_gradient", "CPU", 1U)));
}

}  // namespace
}  // namespace lapwing
