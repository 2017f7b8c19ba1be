#include "lapwing/kernels/fallback_kernels.h"

#include <string>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {

/// The device, until it fails, and the CPU.
class FallbackKernels::Devices {
 public:
  explicit Devices(const std::function<std::unique_ptr<Kernels>()>& make) {
    try {
      device_ = make();
    } catch (const GpuError& error) {
      give_up(error);
    }
  }

  bool device_works() const { return device_ != nullptr; }
  Kernels& now() { return device_ != nullptr ? *device_ : cpu_; }
  const DeviceInfo& info() const { return device_ != nullptr ? device_->device() : after_; }

  void give_up(const GpuError& error) {
    device_.reset();
    if (!after_.took_over.empty()) return;
    after_ = cpu_.device();
    after_.took_over =
        std::string("the device failed, and the CPU went on in its place: ") + error.what();
  }

  /// Runs `call` on the device, and again on the CPU if the device fails.
  template <class Call>
  auto run(const Call& call) {
    if (device_works()) {
      try {
        return call(now());
      } catch (const GpuError& error) {
        give_up(error);
      }
    }
    return call(now());
  }

 private:
  std::unique_ptr<Kernels> device_;  ///< null after the device has failed
  CpuKernels cpu_;
  DeviceInfo after_;
};

class FallbackKernels::Rotations final : public RingRotations {
 public:
  Rotations(std::shared_ptr<Devices> devices, std::shared_ptr<const RegionRings> rings)
      : state_(std::make_unique<State>(std::move(devices), std::move(rings))) {
    state_->make();
  }

  void set_rest_stretch(std::span<const Eigen::Matrix3d> stretch) override {
    state_->stretch.assign(stretch.begin(), stretch.end());
    state_->run([&](RingRotations& on) { on.set_rest_stretch(stretch); });
  }
  void fit_rotations(std::span<const Eigen::Vector3d> displacement,
                     std::span<double> energies) override {
    state_->run([&](RingRotations& on) { on.fit_rotations(displacement, energies); });
    if (state_->is_on_device) state_->fitted.assign(displacement.begin(), displacement.end());
  }
  void energy_gradient(std::span<double> g) override {
    state_->run([&](RingRotations& on) { on.energy_gradient(g); });
  }
  std::vector<Eigen::Matrix3d> transforms() const override {
    std::vector<Eigen::Matrix3d> all;
    state_->run([&](const RingRotations& on) { all = on.transforms(); });
    return all;
  }

 private:
  struct State {
    State(std::shared_ptr<Devices> on, std::shared_ptr<const RegionRings> of)
        : devices(std::move(on)), rings(std::move(of)) {}

    void make() {
      rotations = devices->run([&](Kernels& on) { return on.make_ring_rotations(rings); });
      is_on_device = devices->device_works();
      if (!is_on_device) rings.reset();
    }

    // Recreates the state of the device on the CPU.
    void move_to_cpu() {
      rotations.reset();
      make();
      if (!stretch.empty()) rotations->set_rest_stretch(stretch);
      if (fitted.empty()) return;
      std::vector<double> energies(row_count);
      rotations->fit_rotations(fitted, energies);
      fitted = {};
    }

    template <class Call>
    void run(const Call& call) {
      if (is_on_device) {
        try {
          if (devices->device_works()) return call(*rotations);
        } catch (const GpuError& error) {
          devices->give_up(error);
        }
        move_to_cpu();
      }
      call(*rotations);
    }

    std::shared_ptr<Devices> devices;
    std::shared_ptr<const RegionRings> rings;  ///< needed only while on the device, like `fitted`
    std::size_t row_count = rings->row_count();
    std::vector<Eigen::Matrix3d> stretch;
    std::vector<Eigen::Vector3d> fitted;  ///< the displacement of the last fit
    std::unique_ptr<RingRotations> rotations;
    bool is_on_device = false;
  };
  std::unique_ptr<State> state_;
};

FallbackKernels::FallbackKernels(const std::function<std::unique_ptr<Kernels>()>& make)
    : devices_(std::make_shared<Devices>(make)) {}

const DeviceInfo& FallbackKernels::device() const {
  return devices_->info();
}

void FallbackKernels::assemble_rsi(const RingProblem& problem, std::span<double> blocks) {
  devices_->run([&](Kernels& on) { on.assemble_rsi(problem, blocks); });
}

void FallbackKernels::assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) {
  devices_->run([&](Kernels& on) { on.assemble_tangent(problem, blocks); });
}

void FallbackKernels::sample_laplacians(const RingProblem& problem,
                                        std::span<Eigen::Vector3d> laplacians) {
  devices_->run([&](Kernels& on) { on.sample_laplacians(problem, laplacians); });
}

void FallbackKernels::sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                               std::span<const Eigen::Vector3d> source,
                                               std::span<Eigen::Vector3d> laplacians) {
  devices_->run(
      [&](Kernels& on) { on.sample_mapped_laplacians(rings, sampling, source, laplacians); });
}

void FallbackKernels::rotate_frames(const MappedRings& rings, const FramedSurface& source,
                                    const FramedSurface& target,
                                    std::span<Eigen::Matrix3d> transforms) {
  devices_->run([&](Kernels& on) { on.rotate_frames(rings, source, target, transforms); });
}

std::unique_ptr<RingRotations> FallbackKernels::make_ring_rotations(
    std::shared_ptr<const RegionRings> rings) {
  return std::make_unique<Rotations>(devices_, std::move(rings));
}

}  // namespace lapwing
