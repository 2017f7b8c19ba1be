#include "lapwing/gpu/context.h"

#include <cctype>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/environment.h"
#include "support/error_message.h"
#include "support/gpu.h"

namespace lapwing::gpu {
namespace {

using test::Environment;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string message_of(const ContextOptions& options) {
  return error_message<GpuError>([&] { const Context context(options); });
}

ContextOptions with_device(std::string device) {
  ContextOptions options;
  options.device = std::move(device);
  return options;
}

TEST(Context, MissingLoaderIsNamedWithWhatToInstall) {
  const Environment loader("LAPWING_VULKAN_LOADER", "/nonexistent/libvulkan.so.1");
  EXPECT_THAT(message_of({}), AllOf(HasSubstr("/nonexistent/libvulkan.so.1"),
                                    HasSubstr("mesa-vulkan-drivers"), HasSubstr("--device cpu")));
  EXPECT_THROW(list_devices(), GpuError);
}

TEST(Context, LibraryThatIsNoLoaderIsNamed) {
  const Environment loader("LAPWING_VULKAN_LOADER", "libm.so.6");
  EXPECT_THAT(message_of({}), HasSubstr("libm.so.6"));
}

TEST(Context, MissingDriverIsNamedWithWhatToInstall) {
  LAPWING_NEEDS_GPU();
  const Environment files("VK_DRIVER_FILES", "/nonexistent.json");
  const Environment old_files("VK_ICD_FILENAMES", "/nonexistent.json");
  EXPECT_THAT(message_of({}), AllOf(HasSubstr("mesa-vulkan-drivers"), HasSubstr("--device cpu")));
}

TEST(Context, DeviceIsChosenByIndexAndByPartOfItsNameInAnyCase) {
  LAPWING_NEEDS_GPU();
  const DeviceDescription automatic = Context().description();
  EXPECT_EQ(Context(with_device(std::to_string(automatic.index))).description().name,
            automatic.name);
  std::string part = automatic.name.substr(0, 5);
  for (char& c : part) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_THAT(Context(with_device(part)).description().name,
              HasSubstr(automatic.name.substr(0, 5)));
}

TEST(Context, UnknownDeviceIsAnsweredWithTheDevicesFound) {
  LAPWING_NEEDS_GPU();
  const std::string name = Context().description().name;
  EXPECT_THAT(message_of(with_device("voodoo 2")),
              AllOf(HasSubstr("voodoo 2"), HasSubstr(name), HasSubstr("usable")));
  EXPECT_THAT(message_of(with_device("99")), HasSubstr(name));
}

TEST(Context, MissingExtensionIsTheReasonForARejection) {
  LAPWING_NEEDS_GPU();
  ContextOptions options;
  options.device_extensions = {"VK_LAPWING_flight"};
  EXPECT_THAT(message_of(options), HasSubstr("lacks the extension VK_LAPWING_flight"));
}

TEST(Context, ListedDevicesAreNumberedAndDescribed) {
  LAPWING_NEEDS_GPU();
  const auto devices = list_devices();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, i);
    EXPECT_FALSE(devices[i].name.empty());
    EXPECT_FALSE(devices[i].type.empty());
  }
}

TEST(Context, FailedCallIsNamedWithItsResultAndDevice) {
  LAPWING_NEEDS_GPU();
  const Context context;
  EXPECT_THAT(
      error_message<GpuError>([&] { context.check(VK_ERROR_DEVICE_LOST, "vkQueueSubmit2"); }),
      AllOf(HasSubstr("vkQueueSubmit2"), HasSubstr("VK_ERROR_DEVICE_LOST"),
            HasSubstr(context.description().name)));
}

TEST(Context, SeveralContextsLiveSideBySide) {
  LAPWING_NEEDS_GPU();
  const Context first;
  { const Context second; }
  EXPECT_EQ(first.completed(), 0U);
}

TEST(Context, EnvironmentTurnsValidationOn) {
  LAPWING_NEEDS_GPU();
  const Environment variable("LAPWING_VALIDATION", "1");
  try {
    const Context context;
    EXPECT_TRUE(context.validation_enabled());
  } catch (const GpuError& error) {
    // If the validation layers are missing, the error must name the package to install.
    EXPECT_THAT(error.what(), HasSubstr("install vulkan-validationlayers"));
  }
}

}  // namespace
}  // namespace lapwing::gpu
