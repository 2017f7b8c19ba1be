// Tests which results and messages the program writes if a device fails during the work.
#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "support/faulty_driver.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class DeviceFaultCommands : public CommandLine {
 protected:
  // This member is not static because a static could be initialized before kLiftFlags.
  const std::string lift_ = kLiftFlags + "--frames device --save a.obj ";

  void SetUp() override {
    LAPWING_NEEDS_GPU();
    CommandLine::SetUp();
  }
  Outcome with_fault(const std::string& arguments, const std::string& fault) const {
    return lapwing(arguments, "LAPWING_VULKAN_LOADER='" +
                                  std::string(test::FaultyDriver::loader()) +
                                  "' LAPWING_DRIVER_FAULT='" + fault + "'");
  }
};

TEST_F(DeviceFaultCommands, AnEditGoesOnOnTheCpuAndTheReportSaysSo) {
  for (const char* fault : {"loss 0", "loss 9", "memory 60"}) {
    const Outcome outcome =
        with_fault(lift_ + "--report a.json --render a.png --size 64x48", fault);
    ASSERT_EQ(outcome.exit_code, 0) << fault << ": " << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("the CPU went on in its place")) << fault;
    EXPECT_THAT(outcome.output, Not(HasSubstr("drew the picture"))) << "said once";
    EXPECT_TRUE(std::filesystem::exists(file("a.png"))) << fault;
    EXPECT_EQ(read_mesh(file("a.obj")).vertex_count(), read_mesh(file("tube.obj")).vertex_count());
    const auto report = nlohmann::json::parse(read("a.json"));
    EXPECT_EQ(report["device"]["name"], "CPU") << fault;
    EXPECT_EQ(report["notes"].size(), 1U) << fault;
  }
}

TEST_F(DeviceFaultCommands, APictureThatNoDeviceDrawsDoesNotCostTheEdit) {
  const Outcome outcome =
      with_fault(lift_ + "--report a.json --render a.png --size 64x48", "loss 0 ever after");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("no picture was drawn"), HasSubstr("all other files are written")));
  EXPECT_TRUE(std::filesystem::exists(file("a.obj")));
  EXPECT_TRUE(std::filesystem::exists(file("a.json")));
  EXPECT_FALSE(std::filesystem::exists(file("a.png")));
}

TEST_F(DeviceFaultCommands, APictureIsDrawnAgain) {
  ASSERT_EQ(lapwing("render tube.obj -o a.png --size 64x48").exit_code, 0);
  const Outcome outcome = with_fault("render tube.obj -o b.png --size 64x48", "loss 0");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("drew the picture"));
  EXPECT_EQ(read("b.png"), read("a.png"));
}

TEST_F(DeviceFaultCommands, APictureThatNoDeviceDrawsIsNotThere) {
  const Outcome outcome = with_fault("render tube.obj -o a.png --size 64x48", "loss 0 ever after");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.output, HasSubstr("VK_ERROR_DEVICE_LOST"));
  EXPECT_FALSE(std::filesystem::exists(file("a.png")));
}

TEST_F(DeviceFaultCommands, ADeviceThatDoesNotOpenIsRefusedBeforeTheWork) {
  const Outcome outcome = with_fault(lift_, "memory 0 ever after");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("vkCreateDevice"), HasSubstr("--device cpu")));
  EXPECT_FALSE(std::filesystem::exists(file("a.obj")));
}

}  // namespace
}  // namespace lapwing
