#include "lapwing/kernels/timed_kernels.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/stopwatch.h"

namespace lapwing {

template <class Call>
void TimedKernels::time(const char* kernel, const Call& call) {
  const Stopwatch watch;
  call();
  const double ms = watch.elapsed_ms();
  // Read the device after the call, because the CPU takes over if the device fails during it.
  const std::string& device = kernels_.device().name;
  auto found = std::ranges::find_if(times_, [&](const KernelTime& time) {
    return time.kernel == kernel && time.device == device;
  });
  if (found == times_.end()) found = times_.insert(found, {kernel, device});
  ++found->calls;
  found->milliseconds += ms;
}

class TimedKernels::Rotations final : public RingRotations {
 public:
  Rotations(TimedKernels& timed, std::unique_ptr<RingRotations> rotations)
      : timed_(timed), rotations_(std::move(rotations)) {}

  void set_rest_stretch(std::span<const Eigen::Matrix3d> stretch) override {
    rotations_->set_rest_stretch(stretch);
  }
  void fit_rotations(std::span<const Eigen::Vector3d> displacement,
                     std::span<double> energies) override {
    timed_.time("fit_rotations", [&] { rotations_->fit_rotations(displacement, energies); });
  }
  void energy_gradient(std::span<double> g) override {
    timed_.time("energy_gradient", [&] { rotations_->energy_gradient(g); });
  }
  std::vector<Eigen::Matrix3d> transforms() const override { return rotations_->transforms(); }

 private:
  TimedKernels& timed_;
  std::unique_ptr<RingRotations> rotations_;
};

void TimedKernels::assemble_rsi(const RingProblem& problem, std::span<double> blocks) {
  time("assemble_rsi", [&] { kernels_.assemble_rsi(problem, blocks); });
}

void TimedKernels::assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) {
  time("assemble_tangent", [&] { kernels_.assemble_tangent(problem, blocks); });
}

void TimedKernels::sample_laplacians(const RingProblem& problem,
                                     std::span<Eigen::Vector3d> laplacians) {
  time("sample_laplacians", [&] { kernels_.sample_laplacians(problem, laplacians); });
}

void TimedKernels::sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                            std::span<const Eigen::Vector3d> source,
                                            std::span<Eigen::Vector3d> laplacians) {
  time("sample_mapped_laplacians",
       [&] { kernels_.sample_mapped_laplacians(rings, sampling, source, laplacians); });
}

void TimedKernels::rotate_frames(const MappedRings& rings, const FramedSurface& source,
                                 const FramedSurface& target,
                                 std::span<Eigen::Matrix3d> transforms) {
  time("rotate_frames", [&] { kernels_.rotate_frames(rings, source, target, transforms); });
}

std::unique_ptr<RingRotations> TimedKernels::make_ring_rotations(
    std::shared_ptr<const RegionRings> rings) {
  return std::make_unique<Rotations>(*this, kernels_.make_ring_rotations(std::move(rings)));
}

}  // namespace lapwing
