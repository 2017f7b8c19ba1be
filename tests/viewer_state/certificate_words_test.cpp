#include "work/certificate_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "work/window_words.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

class CertificateWords : public ::testing::Test {
 protected:
  std::vector<CertificateWarning> warnings() const { return warnings_of(certificate_, topology_); }
  CertificateWarning only_warning() const {
    const auto all = warnings();
    EXPECT_EQ(all.size(), 1U);
    return all.empty() ? CertificateWarning{} : all.front();
  }

  Topology topology_ = build_topology(grid(4, 4));
  Certificate certificate_;
};

TEST_F(CertificateWords, AllIsWellWithoutAny) {
  EXPECT_THAT(warnings(), IsEmpty());
}

TEST_F(CertificateWords, NotSettledSaysHowFarAndWhatToDo) {
  certificate_.settled = false;
  certificate_.settle_iterations = 100;
  certificate_.settle_last_step = 0.02;
  const auto warning = only_warning();
  EXPECT_THAT(warning.text, HasSubstr("after 100 iterations"));
  EXPECT_THAT(warning.text, HasSubstr("0.02 mean edge lengths"));
  EXPECT_THAT(warning.text, HasSubstr("Enlarge the region, move the handle in smaller steps"));
  EXPECT_THAT(warning.vertices, IsEmpty());
  certificate_.settle_iterations = 1;
  EXPECT_THAT(only_warning().text, HasSubstr("after 1 iteration:"));
}

TEST_F(CertificateWords, FoldedTrianglesNameTheirCorners) {
  certificate_.flipped_triangles = 12;
  certificate_.first_flipped_triangles = {0};
  const Triangle& corners = topology_.triangles[0];
  EXPECT_THAT(only_warning().text, HasSubstr("12 triangles are folded over"));
  EXPECT_THAT(only_warning().vertices, ::testing::UnorderedElementsAreArray(corners));
  certificate_.flipped_triangles = 1;
  EXPECT_THAT(only_warning().text, HasSubstr("A triangle is folded over"));
}

TEST_F(CertificateWords, RingThatGrewOrShrankIsFramedWithItsNeighbours) {
  certificate_.largest_scale = 2.5;
  certificate_.largest_scale_vertex = 12;
  EXPECT_THAT(only_warning().text, HasSubstr("grew to 2.5 times"));
  EXPECT_THAT(only_warning().vertices, IsSupersetOf(topology_.rings[12]));
  certificate_.largest_scale = 1.0;
  certificate_.smallest_scale = 0.4;
  certificate_.smallest_scale_vertex = 6;
  EXPECT_THAT(only_warning().text, HasSubstr("shrank to 40%"));
  EXPECT_THAT(only_warning().vertices, IsSupersetOf(topology_.rings[6]));
}

TEST_F(CertificateWords, LostDetailsAreSaidAboveAQuarter) {
  certificate_.detail_error = 0.24;
  EXPECT_THAT(warnings(), IsEmpty());
  certificate_.detail_error = 0.31;
  EXPECT_THAT(only_warning().text, HasSubstr("31% of the detail"));
}

TEST_F(CertificateWords, EdgeLongerThanThreeTimesNamesItsEnds) {
  certificate_.largest_edge_stretch = kLongEdge - 1.1;
  certificate_.largest_edge_stretch_vertices = {4, 3};
  EXPECT_THAT(warnings(), IsEmpty());
  certificate_.largest_edge_stretch = 2.5;
  EXPECT_THAT(only_warning().text, HasSubstr("3.5 times as long. Enlarge the region"));
  EXPECT_THAT(only_warning().vertices, ElementsAre(3, 4));
}

TEST_F(CertificateWords, HandleIsJudgedByTheSizeOfTheMesh) {
  certificate_.rest_diagonal = 2.0;
  certificate_.prescribed_motion = 1.0;
  certificate_.handle_error = 0.015;
  EXPECT_THAT(warnings(), IsEmpty());
  certificate_.handle_error = 0.05;
  EXPECT_THAT(only_warning().text, HasSubstr("2.5% of the mesh's size"));
}

TEST_F(CertificateWords, WhatNeverSettledComesFirst) {
  certificate_.settled = false;
  certificate_.detail_error = 0.5;
  certificate_.flipped_triangles = 2;
  certificate_.first_flipped_triangles = {0, 1};
  ASSERT_EQ(warnings().size(), 3U);
  EXPECT_THAT(warnings()[0].text, HasSubstr("Not fully refined"));
  certificate_.lacks_hessian = true;
  EXPECT_THAT(warnings()[0].text, HasSubstr("not enough memory"));
}

// No text quotes a recipe or the command line, and each problem has a button.
void expect_window_words(const CertificateWarning& warning) {
  EXPECT_THAT(warning.text, Not(HasSubstr("{")));
  EXPECT_THAT(warning.text, Not(HasSubstr("--")));
  EXPECT_THAT(warning.text, Not(HasSubstr("`")));
  EXPECT_THAT(warning.text, Not(ContainsRegex("\"[a-z_]"))) << "labels begin with a capital";
  EXPECT_EQ(in_window_words(warning.text), warning.text);
  EXPECT_THAT(warning.remedies, Not(IsEmpty())) << warning.text;
  for (const Remedy remedy : warning.remedies) {
    EXPECT_STRNE(label_of(remedy), "");
    EXPECT_STRNE(explanation_of(remedy), "");
  }
}

TEST_F(CertificateWords, EveryWarningIsInPlainWordsAndHasAButton) {
  certificate_.detail_error = 0.5;
  certificate_.rest_diagonal = 2.0;
  certificate_.prescribed_motion = 1.0;
  certificate_.handle_error = 0.05;
  certificate_.largest_scale = 2.5;
  certificate_.smallest_scale = 0.4;
  certificate_.largest_edge_stretch = 2.5;
  certificate_.largest_edge_stretch_vertices = {4, 3};
  certificate_.largest_scale_vertex = 12;
  certificate_.smallest_scale_vertex = 6;
  certificate_.inside_out_vertex = 7;
  certificate_.settled = false;
  for (const bool whole : {false, true}) {
    certificate_.region_is_whole = whole;
    for (const bool lacks_hessian : {false, true}) {
      certificate_.lacks_hessian = lacks_hessian;
      for (const double inside_out : {0.0, 0.5}) {
        certificate_.inside_out_share = inside_out;
        certificate_.flipped_triangles = 2;
        certificate_.first_flipped_triangles = {0, 1};
        const auto all = warnings();
        EXPECT_EQ(all.size(), 7U);
        for (const CertificateWarning& warning : all) {
          expect_window_words(warning);
          const bool enlarges = std::ranges::count(warning.remedies, Remedy::enlarge_region) > 0;
          EXPECT_EQ(enlarges, warning.text.find("Enlarge the region") != std::string::npos);
        }
      }
    }
  }
}

TEST_F(CertificateWords, WarningsOfTheEngineAreTranslated) {
  certificate_.rest_diagonal = 2.0;
  certificate_.prescribed_motion = 1.0;
  certificate_.handle_error = 0.05;
  certificate_.settled = false;
  certificate_.flipped_triangles = 2;
  certificate_.first_flipped_triangles = {0, 1};
  certificate_.largest_edge_stretch = 2.5;
  certificate_.largest_edge_stretch_vertices = {4, 3};
  for (const std::string& warning : lapwing::warnings_of(certificate_)) {
    const std::string words = in_window_words(warning);
    EXPECT_THAT(words, Not(ContainsRegex("\"[a-z_]"))) << words;
  }
}

}  // namespace
}  // namespace lapwing::viewer::test
