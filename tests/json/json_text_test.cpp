#include "lapwing/json/json_text.h"

#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/json/parse_json.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Json = nlohmann::ordered_json;

std::string_view at(const JsonText& text, JsonPlace place) {
  return text.text().substr(place.begin, place.end - place.begin);
}

// Expects that the text at `place`, and at the places of all nested values, parses to `json`.
void expect_same(const JsonText& text, JsonPlace place, const Json& json) {
  EXPECT_EQ(parse_json(at(text, place), "value"), json) << at(text, place);
  if (json.is_object()) {
    EXPECT_FALSE(text.find(place, "no such key"));
    for (const auto& [key, value] : json.items()) expect_same(text, text.at(place, key), value);
  }
  if (json.is_array()) {
    const std::vector<JsonPlace> elements = text.elements(place);
    ASSERT_EQ(elements.size(), json.size());
    for (std::size_t k = 0; k < elements.size(); ++k) expect_same(text, elements[k], json[k]);
  }
}

class JsonTextOf : public ::testing::TestWithParam<std::string> {};

TEST_P(JsonTextOf, HasTheValuesThatTheParserReads) {
  const JsonText text(GetParam(), "a.json");
  expect_same(text, text.root(), parse_json(GetParam(), "a.json"));
}

INSTANTIATE_TEST_SUITE_P(
    Documents, JsonTextOf,
    ::testing::Values("\xEF\xBB\xBF{\"a\":1}", "\xEF\xBB\xBF \n[1]\n ", "{}", "[]", " [ ] ", "7",
                      "-0.5e-3", "null", "\"[{\"",
                      R"({"a":{"b":[{},[],{"c":[[1,2],3]}]},"d":true})",
                      "{ \"a\" :\t1\r\n,\n\"b\" : [ 1 , 2 ]\n}",
                      R"({"\"":1,"\\":2,"\\\"":3,"a]":4,"{":5,"":6})",
                      R"({"\u0061":1,"\u00e9":2,"\ud83d\ude00":3,"\u0000":4,"\/":5})",
                      "{\"\xC3\xA9\":1,\"\xF0\x9F\x98\x80\":[2]}", R"(["a\\","\\\"]",{"x":"}"}])",
                      R"([1e-5,-2,0,1E+3,false,null,true,"x"])"));

TEST(JsonText, ASurrogatePairAndItsCharacterAreTheSameKey) {
  const JsonText text(R"({"\ud83d\ude00":3})", "a.json");
  EXPECT_EQ(at(text, text.at(text.root(), "\xF0\x9F\x98\x80")), "3");
}

TEST(JsonText, ValuesOfAnotherTypeAreRefusedWithTheirPlace) {
  const JsonText text("{\"views\": 5,\n \"nodes\": {\"a\": [1]}}", "a.gltf");
  const auto message = [&](auto act) { return error_message<InputError>(act); };
  EXPECT_EQ(message([&] { (void)text.elements(text.at(text.root(), "views")); }),
            "a.gltf:1:11: expected a list; export the file again");
  EXPECT_EQ(message([&] { (void)text.element("nodes", 0); }),
            "a.gltf:2:11: expected a list; export the file again");
  EXPECT_EQ(message([&] { (void)text.find(text.at(text.root(), "views"), "a"); }),
            "a.gltf:1:11: expected an object; export the file again");
  EXPECT_EQ(message([&] { (void)text.at(text.at(text.root(), "nodes"), "b"); }),
            "a.gltf:2:11: the key \"b\" is missing; export the file again");
}

TEST(JsonText, AnElementBeyondTheListIsRefused) {
  const JsonText text(R"({"nodes": [{}, {}]})", "a.gltf");
  EXPECT_EQ(at(text, text.element("nodes", 1)), "{}");
  EXPECT_EQ(
      error_message<InputError>([&] { (void)text.element("nodes", 2); }),
      "a.gltf:1:11: element 2 of \"nodes\" is missing; the list has 2; export the file again");
}

}  // namespace
}  // namespace lapwing
