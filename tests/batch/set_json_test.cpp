#include "lapwing/batch/set_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string with(const std::string& document, const std::string& pointer, const Json& value) {
  Json json = Json::parse(document);
  set_json(json, pointer, value, "jobs:1: /set");
  return json.dump();
}

std::string message(const std::string& document, const std::string& pointer) {
  return error_message<InputError>([&] { with(document, pointer, 1); });
}

TEST(SetJson, ReplacesWhatIsThere) {
  EXPECT_EQ(with(R"({"a":[{"b":1},2]})", "/a/0/b", 3), R"({"a":[{"b":3},2]})");
  EXPECT_EQ(with(R"({"a":[1,2]})", "/a/1", Json::array()), R"({"a":[1,[]]})");
  EXPECT_EQ(with(R"({"a":1})", "", 2), "2");
}

TEST(SetJson, AddsAKeyToAnObjectOrAnElementToTheEndOfAList) {
  EXPECT_EQ(with(R"({"a":{}})", "/a/b", 3), R"({"a":{"b":3}})");
  EXPECT_EQ(with(R"({"a":[1]})", "/a/-", 3), R"({"a":[1,3]})");
  EXPECT_EQ(with(R"({"a":[]})", "/a/-", 3), R"({"a":[3]})");
}

TEST(SetJson, KnowsKeysWithSlashesTildesAndNothing) {
  EXPECT_EQ(with(R"({"a/b":1,"c~d":2,"":{"":3}})", "/a~1b", 9), R"({"a/b":9,"c~d":2,"":{"":3}})");
  EXPECT_EQ(with(R"({"a/b":1,"c~d":2,"":{"":3}})", "/c~0d", 9), R"({"a/b":1,"c~d":9,"":{"":3}})");
  EXPECT_EQ(with(R"({"a/b":1,"c~d":2,"":{"":3}})", "//", 9), R"({"a/b":1,"c~d":2,"":{"":9}})");
}

TEST(SetJson, SaysWhichPartOfAPointerIsNotThereAndWhatIs) {
  EXPECT_THAT(message(R"({"steps":[{"handles":[]}]})", "/steps/0/handels/0"),
              AllOf(StartsWith("jobs:1: /set: \"/steps/0/handels/0\": /steps/0 has no \"handels\""),
                    HasSubstr("did you mean \"handles\"")));
  EXPECT_THAT(message(R"({"a":[1,2]})", "/a/2"), HasSubstr("use 0 to 1, or \"-\""));
  EXPECT_THAT(message(R"({"a":[]})", "/a/0"), HasSubstr("use \"-\""));
  for (const char* const pointer :
       {"/a/01", "/a/-1", "/a/x", "/a/", "/a/-/b", "/a/99999999999999999999"}) {
    EXPECT_THAT(message(R"({"a":[1,2]})", pointer), HasSubstr("is a list of 2")) << pointer;
  }
  EXPECT_THAT(message(R"({"a":1})", "/a/b"), HasSubstr("neither an object nor a list"));
  EXPECT_THAT(message(R"({"a":1})", "a"), HasSubstr("begins with \"/\""));
  EXPECT_THAT(message(R"({"a":1})", "/a~2"), HasSubstr("~0"));
  EXPECT_THAT(message(R"({"a":1})", "/a~"), HasSubstr("~0"));
}

}  // namespace
}  // namespace lapwing
