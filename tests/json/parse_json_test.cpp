#include "lapwing/json/parse_json.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using std::string_literals::operator""s;
using ::testing::HasSubstr;

TEST(ParseJson, AByteOrderMarkIsSkipped) {
  EXPECT_EQ(parse_json("\xEF\xBB\xBF{\"a\": [1, 2]}", "a.json").dump(), R"({"a":[1,2]})");
}

struct NoJson {
  std::string text;
  std::string message;  ///< end of the message, after the name
};

class RefusedJson : public ::testing::TestWithParam<NoJson> {};

TEST_P(RefusedJson, IsNamedWithItsPlace) {
  EXPECT_THAT(error_message<InputError>([] { parse_json(GetParam().text, "a.json"); }),
              HasSubstr("a.json" + GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, RefusedJson,
    ::testing::Values(
        NoJson{"\xFF\xFE{\0}\0"s,
               ":1:1: expected UTF-8 text, found UTF-16; save the file as UTF-8"},
        NoJson{"\xFE\xFF\0{\0}"s, ":1:1: expected UTF-8 text, found UTF-16"},
        NoJson{"{\0}\0"s, ":1:2: expected UTF-8 text, found a NUL byte"},
        NoJson{"{}\n\0{\"steps\": []}"s, ":2:1: expected UTF-8 text, found a NUL byte"},
        NoJson{"\xEF\xBB\xBF\xEF\xBB\xBF{}", ":1:4: syntax error"},
        NoJson{" \xEF\xBB\xBF{}", ":1:2: syntax error"}, NoJson{"{} {}", ":1:4: syntax error"},
        NoJson{"{\n // no\n \"a\": 1}", ":2:2: syntax error"},
        NoJson{"[1,\n2,]", ":2:3: syntax error"}, NoJson{"{'a': 1}", ":1:2: syntax error"},
        NoJson{"[NaN]", ":1:2: syntax error"}, NoJson{"[01]", ":1:3: syntax error"},
        NoJson{R"(["\ud800"])", ":1:9: syntax error"},
        NoJson{"[\"\xC0\xAF\"]", ":1:3: syntax error"},
        NoJson{"[-1e999]", ":1:7: /0: the number -1e999 is too large for a double"},
        NoJson{R"({"a": 1, "\u0061": 2})", ":1:17: /a: the key \"a\" appears twice in one object"},
        NoJson{std::string(501, '['),
               ":1:501: lists and objects are nested more than 500 levels"}));

}  // namespace
}  // namespace lapwing
