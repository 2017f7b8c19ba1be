#include "report/theme.h"

#include <array>

namespace lapwing::bench {
namespace {

struct Colors {
  const char* paper;
  const char* ink;
  const char* quiet;
  const char* grid;
  // Of bars and lines, and of text on such a bar.
  std::array<std::array<const char*, 2>, kColors> pairs;
};

constexpr Colors kLight{"#ffffff",
                        "#1b1f24",
                        "#59616b",
                        "#e3e6ea",
                        {{{"#332288", "#ffffff"},
                          {"#55a9d6", "#000000"},
                          {"#44aa99", "#000000"},
                          {"#117733", "#ffffff"},
                          {"#8f8f2c", "#000000"},
                          {"#d0aa3a", "#000000"},
                          {"#cc6677", "#000000"},
                          {"#882255", "#ffffff"},
                          {"#aa4499", "#ffffff"},
                          {"#8a8f96", "#000000"}}}};

constexpr Colors kDark{"#14171b",
                       "#e8eaed",
                       "#a3abb5",
                       "#30363d",
                       {{{"#8f86e6", "#000000"},
                         {"#7cc8f2", "#000000"},
                         {"#4dbdaa", "#000000"},
                         {"#3aa75f", "#000000"},
                         {"#b3b34a", "#000000"},
                         {"#e3c766", "#000000"},
                         {"#e08492", "#000000"},
                         {"#cc6294", "#000000"},
                         {"#cf74bf", "#000000"},
                         {"#9aa1aa", "#000000"}}}};

std::string class_name(const char* kind, std::size_t color) {
  return kind + std::to_string(color % kColors);
}

std::string colors_css(const Colors& colors) {
  const std::string paper = colors.paper;
  const std::string ink = colors.ink;
  const std::string quiet = colors.quiet;
  std::string css = ".paper{fill:" + paper + "} .ink,.heading{fill:" + ink +
                    "} .quiet{fill:" + quiet + "}\n.grid{stroke:" + colors.grid +
                    "} .axis{stroke:" + quiet + "} .mark{stroke:" + ink + "} .bar{stroke:" + paper +
                    "}\n";
  for (std::size_t k = 0; k < kColors; ++k) {
    const std::string color = colors.pairs[k][0];
    css += "." + class_name("s", k) + "{stroke:" + color + "} ." + class_name("f", k) +
           "{fill:" + color + "} ." + class_name("t", k) + "{fill:" + colors.pairs[k][1] + "}\n";
  }
  return css;
}

}  // namespace

std::string line_class(std::size_t color) {
  return "line " + class_name("s", color);
}

std::string dashed_class(std::size_t color) {
  return line_class(color) + " dashed";
}

std::string marker_class(std::size_t color) {
  return class_name("f", color);
}

std::string bar_class(std::size_t color) {
  return "bar " + class_name("f", color);
}

std::string on_bar_class(std::size_t color) {
  return class_name("t", color);
}

std::string light_theme() {
  return ".plot{font:12px system-ui,\"Segoe UI\",Helvetica,Arial,sans-serif}\n"
         ".heading{font-weight:600} .line{fill:none;stroke-width:1.8} .dashed{stroke-dasharray:5 "
         "4}\n"
         ".error{stroke-width:1.2} .leader{stroke-width:.8;opacity:.7} .mark{stroke-width:1.4}\n" +
         colors_css(kLight);
}

std::string dark_theme() {
  return colors_css(kDark);
}

}  // namespace lapwing::bench
