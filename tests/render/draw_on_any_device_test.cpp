#include "lapwing/render/draw_on_any_device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/render/render_image.h"
#include "lapwing/render/surface.h"
#include "support/error_message.h"
#include "support/faulty_driver.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

using test::DriverFault;

class DrawOnAnyDevice : public ::testing::TestWithParam<DriverFault> {
 protected:
  void SetUp() override { LAPWING_NEEDS_GPU(); }

  Image draw(const std::shared_ptr<gpu::Context>& context) const {
    Surface surface(context, mesh.positions, mesh.topology());
    const SurfacePaint paint(surface);
    RenderOptions options;
    options.width = options.height = 32;
    return render_image(surface, paint, fit(mesh.positions, view_axes(View::front), 1.0), options);
  }
  struct Drawn {
    Image image;
    std::string said;
    int begun = 0;  ///< number of calls of `draw`
  };
  Drawn drawn(const std::shared_ptr<gpu::Context>& first) const {
    Drawn result;
    result.said = draw_on_any_device(first, [&](const auto& context) {
      ++result.begun;
      result.image = draw(context);
    });
    return result;
  }

  const test::FaultyDriver driver;
  const Mesh mesh = icosphere(1);
};

// Each call fails in one run. In every eighth run, draw_on_any_device draws again on a new context.
// The other runs check only the failure, because opening a device is slow.
TEST_P(DrawOnAnyDevice, ThePictureIsTheSameWhereverADeviceFails) {
  const Drawn undisturbed = drawn(nullptr);
  EXPECT_EQ(undisturbed.said, "");
  std::shared_ptr<gpu::Context> first;
  const auto prepare = [&] {
    if (first != nullptr && GetParam() == DriverFault::memory) return;
    first.reset();
    first = std::make_shared<gpu::Context>();
  };
  long number = 0;
  long failures = 0;
  const auto act = [&] {
    if (number++ % 8 == 0) {
      const Drawn result = drawn(first);
      EXPECT_EQ(result.image.rgba, undisturbed.image.rgba);
      EXPECT_EQ(result.said.empty(), result.begun == 1);
      if (result.begun > 1) ++failures;
      return;
    }
    try {
      EXPECT_EQ(draw(first).rgba, undisturbed.image.rgba);
    } catch (const GpuError&) {
      ++failures;
    }
  };
  const long calls = test::for_every_call(driver, GetParam(), prepare, act);
  // The last waits happen after the image is complete, so losing the device there changes nothing.
  // Unmapped memory needs more of these waits.
  constexpr long kWaitsAtTheEnd = 4;
  EXPECT_GT(failures, 2);
  EXPECT_GE(failures, calls - (GetParam() == DriverFault::loss ? kWaitsAtTheEnd : 0));
}

TEST_P(DrawOnAnyDevice, SaysWhatWentWrongOnTheFirstWhereNoneCanDraw) {
  const auto first = std::make_shared<gpu::Context>();
  driver.fail(GetParam(), 1, true);
  const std::string said = error_message<GpuError>([&] { drawn(first); });
  EXPECT_THAT(
      said, ::testing::HasSubstr(GetParam() == DriverFault::loss ? "VK_ERROR_DEVICE_LOST"
                                                                 : "VK_ERROR_OUT_OF_HOST_MEMORY"));
}

TEST_P(DrawOnAnyDevice, OpensADeviceThatFailsToOpenAgain) {
  driver.fail(DriverFault::memory, 0);
  const Drawn result = drawn(nullptr);
  EXPECT_THAT(result.said, ::testing::HasSubstr("vkCreateDevice"));
  driver.work();
  EXPECT_EQ(result.image.rgba, drawn(nullptr).image.rgba);
}

INSTANTIATE_TEST_SUITE_P(Each, DrawOnAnyDevice,
                         ::testing::Values(DriverFault::loss, DriverFault::memory),
                         [](const auto& fault) { return test::name_of(fault.param); });

}  // namespace
}  // namespace lapwing
