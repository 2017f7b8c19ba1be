#include "lapwing/gpu/spirv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/shaders/add_one.h"
#include "lapwing/shaders/in_place.h"

namespace lapwing::gpu {
namespace {

using ::testing::ElementsAre;

TEST(Spirv, BindingsCarryTheirQualifiers) {
  EXPECT_THAT(read_interface(shaders::add_one()).bindings,
              ElementsAre(BindingAccess::read, BindingAccess::write));
  EXPECT_THAT(read_interface(shaders::in_place()).bindings, ElementsAre(BindingAccess::read_write));
}

TEST(Spirv, CapabilitiesAreListed) {
  constexpr std::uint32_t kShader = 1;
  EXPECT_THAT(read_interface(shaders::add_one()).capabilities, ElementsAre(kShader));
}

TEST(Spirv, OtherWordsAreRefused) {
  EXPECT_THROW(read_interface({}), GpuError);
  EXPECT_THROW(read_interface(std::vector<std::uint32_t>(100, 7U)), GpuError);
  constexpr std::size_t kInsideTheThirdInstruction = 9;
  EXPECT_THROW(read_interface(shaders::add_one().first(kInsideTheThirdInstruction)), GpuError);
}

}  // namespace
}  // namespace lapwing::gpu
