#include "viewer_panels/screen_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

namespace lapwing::viewer::test {
namespace {

using Rgb = std::array<double, 3>;

// Between the places of the pen that wrote two letters, in parts of the font's size: a space is
// wider than nothing, and narrower than the gap between two items.
constexpr float kSpace = 0.15F;
constexpr float kGap = 0.45F;
// In pixels.
constexpr float kEdge = 0.25F;

double linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

struct Paint {
  Rgb color;  // in linear light
  double opacity;
};

Paint paint_of(ImU32 packed) {
  Paint paint{};
  for (int c = 0; c < 3; ++c) {
    paint.color[static_cast<std::size_t>(c)] = linear(((packed >> (8 * c)) & 255U) / 255.0);
  }
  paint.opacity = ((packed >> 24) & 255U) / 255.0;
  return paint;
}

Rgb over(const Rgb& below, const Paint& paint) {
  Rgb mixed{};
  for (std::size_t c = 0; c < 3; ++c) {
    mixed[c] = below[c] + paint.opacity * (paint.color[c] - below[c]);
  }
  return mixed;
}

double luminance(const Rgb& color) {
  return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

double contrast_of(const Rgb& a, const Rgb& b) {
  const double first = luminance(a) + 0.05;
  const double second = luminance(b) + 0.05;
  return std::max(first, second) / std::min(first, second);
}

// What is drawn, in order: a triangle of one colour, or a letter.
struct Drawn {
  std::array<ImVec2, 3> corners;  // of a letter: upper left, lower right
  ImVec4 clip;
  ImU32 color;
  bool is_letter;
  const ImFontGlyph* glyph;  // null where only the middle of a letter shows
  bool is_cut;               // the letter's picture is
};

bool holds(const ImVec4& clip, const ImVec2& p) {
  return p.x >= clip.x && p.x < clip.z && p.y >= clip.y && p.y < clip.w;
}

bool covers(const Drawn& drawn, const ImVec2& p) {
  if (!holds(drawn.clip, p)) return false;
  const auto side = [&](int a, int b) {
    const ImVec2& from = drawn.corners[static_cast<std::size_t>(a)];
    const ImVec2& to = drawn.corners[static_cast<std::size_t>(b)];
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  };
  const float s0 = side(0, 1);
  const float s1 = side(1, 2);
  const float s2 = side(2, 0);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

// Letters by the place of their upper left corner in the font's picture, and by the lower right.
class Letters {
 public:
  explicit Letters(const ImFontAtlas& atlas) {
    for (const ImFontGlyph& glyph : atlas.Fonts[0]->Glyphs) {
      if (!glyph.Visible) continue;
      first_[{glyph.U0, glyph.V0}] = &glyph;
      last_[{glyph.U1, glyph.V1}] = &glyph;
    }
  }
  /// Null where there is none.
  const ImFontGlyph* beginning_at(const ImVec2& uv) const { return found(first_, uv); }
  const ImFontGlyph* ending_at(const ImVec2& uv) const { return found(last_, uv); }

 private:
  using Places = std::map<std::pair<float, float>, const ImFontGlyph*>;
  static const ImFontGlyph* found(const Places& places, const ImVec2& uv) {
    const auto at = places.find({uv.x, uv.y});
    return at == places.end() ? nullptr : at->second;
  }

  Places first_;
  Places last_;
};

class Reader {
 public:
  explicit Reader(const ImDrawData& frame) : letters_(*ImGui::GetIO().Fonts) {
    for (const ImDrawList* list :
         std::span(frame.CmdLists, static_cast<std::size_t>(frame.CmdListsCount))) {
      for (const ImDrawCmd& command : list->CmdBuffer) take(*list, command);
    }
  }

  std::vector<ShownText> texts() const {
    std::vector<ShownText> texts;
    ShownText text;
    const Drawn* last = nullptr;
    for (std::size_t k = 0; k < drawn_.size(); ++k) {
      const Drawn& letter = drawn_[k];
      if (!letter.is_letter) continue;
      const ImVec2 from = letter.corners[0];
      const ImVec2 to = letter.corners[1];
      const bool below_or_beyond = to.y <= letter.clip.y || from.y >= letter.clip.w;
      if (below_or_beyond || is_hidden(k)) continue;
      if (last == nullptr || !continues(*last, letter)) {
        if (last != nullptr) texts.push_back(text);
        text = {};
        text.min = from;
      } else if (pen_before(letter) - pen_after(*last) > kSpace * ImGui::GetFontSize()) {
        text.words += ' ';
      }
      add(k, text);
      last = &letter;
    }
    if (last != nullptr) texts.push_back(text);
    return texts;
  }

 private:
  void take(const ImDrawList& list, const ImDrawCmd& command) {
    const bool is_picture = command.GetTexID() != nullptr;
    for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
      const ImDrawIdx* index = list.IdxBuffer.Data + command.IdxOffset + i;
      const auto vertex = [&](int k) -> const ImDrawVert& {
        return list.VtxBuffer[static_cast<int>(index[k] + command.VtxOffset)];
      };
      // A letter is two triangles: corners 0 1 2 and 0 2 3, of which the first two lie across.
      const bool textured = vertex(0).uv.x != vertex(2).uv.x && vertex(0).uv.y != vertex(2).uv.y;
      const bool is_letter = !is_picture && textured && i + 5 < command.ElemCount &&
                             vertex(0).pos.y == vertex(1).pos.y &&
                             is_letter_place(vertex(0).uv, vertex(2).uv);
      Drawn drawn{{vertex(0).pos, vertex(1).pos, vertex(2).pos},
                  command.ClipRect,
                  vertex(0).col,
                  is_letter,
                  nullptr,
                  false};
      if (is_letter) {
        drawn.corners = {vertex(0).pos, vertex(2).pos, vertex(2).pos};
        const ImFontGlyph* first = letters_.beginning_at(vertex(0).uv);
        const ImFontGlyph* last = letters_.ending_at(vertex(2).uv);
        drawn.glyph = first != nullptr ? first : last;
        // Cut above or below it is where a panel scrolls. A letter that would begin beyond the
        // right edge is not drawn at all: what ends just there goes on.
        drawn.is_cut = drawn.corners[0].x < command.ClipRect.x - 1.0F ||
                       pen_after(drawn) > command.ClipRect.z - kEdge ||
                       (first != last && is_cut_across(vertex(0), vertex(2)));
        i += 3;
      }
      drawn_.push_back(drawn);
    }
  }

  // Returns the glyph that covers this rectangle of the font atlas, or null if there is none.
  static const ImFontGlyph* letter_around(const ImVec2& from, const ImVec2& to) {
    for (const ImFontGlyph& glyph : ImGui::GetIO().Fonts->Fonts[0]->Glyphs) {
      const bool inside = glyph.Visible && from.x >= glyph.U0 && to.x <= glyph.U1 &&
                          from.y >= glyph.V0 && to.y <= glyph.V1;
      if (inside) return &glyph;
    }
    return nullptr;
  }

  bool is_letter_place(const ImVec2& from, const ImVec2& to) const {
    return letters_.beginning_at(from) || letters_.ending_at(to) || letter_around(from, to);
  }

  // Whether it is narrower than the letter that it is a part of.
  static bool is_cut_across(const ImDrawVert& from, const ImDrawVert& to) {
    const ImFontGlyph* whole = letter_around(from.uv, to.uv);
    return whole == nullptr || to.pos.x - from.pos.x < whole->X1 - whole->X0 - 1.0F;
  }

  // Where the pen stood that wrote the letter.
  static float pen_before(const Drawn& letter) {
    return letter.corners[0].x - (letter.glyph != nullptr ? letter.glyph->X0 : 0.0F);
  }
  static float pen_after(const Drawn& letter) {
    return letter.glyph != nullptr ? pen_before(letter) + letter.glyph->AdvanceX
                                   : letter.corners[1].x;
  }

  static bool continues(const Drawn& last, const Drawn& next) {
    const float size = ImGui::GetFontSize();
    const float gap = pen_before(next) - pen_after(last);
    const bool same_line = next.corners[0].y < last.corners[1].y + 0.25F * size &&
                           next.corners[1].y > last.corners[0].y - 0.25F * size;
    return same_line && last.color == next.color && gap > -0.4F * size && gap < kGap * size;
  }

  // By something drawn later that lets nothing through.
  bool is_hidden(std::size_t k) const {
    const ImVec2 middle{0.5F * (drawn_[k].corners[0].x + drawn_[k].corners[1].x),
                        0.5F * (drawn_[k].corners[0].y + drawn_[k].corners[1].y)};
    for (std::size_t later = k + 1; later < drawn_.size(); ++later) {
      const Drawn& drawn = drawn_[later];
      if (drawn.is_letter || (drawn.color >> 24) < 200) continue;
      if (covers(drawn, middle)) return true;
    }
    return false;
  }

  void add(std::size_t k, ShownText& text) const {
    const Drawn& letter = drawn_[k];
    const ImVec2 from = letter.corners[0];
    const ImVec2 to = letter.corners[1];
    const bool is_ascii = letter.glyph != nullptr && letter.glyph->Codepoint < 128;
    text.words += is_ascii ? static_cast<char>(letter.glyph->Codepoint) : '?';
    text.min = {std::min(text.min.x, from.x), std::min(text.min.y, from.y)};
    text.max = {std::max(text.max.x, to.x), std::max(text.max.y, to.y)};
    text.is_cut = text.is_cut || letter.is_cut;
    const ImVec2 middle{0.5F * (from.x + to.x), 0.5F * (from.y + to.y)};
    for (const double scene : {0.0, 1.0}) {
      Rgb ground{scene, scene, scene};
      for (std::size_t below = 0; below < k; ++below) {
        const Drawn& drawn = drawn_[below];
        if (!drawn.is_letter && covers(drawn, middle)) ground = over(ground, paint_of(drawn.color));
      }
      const Rgb ink = over(ground, paint_of(letter.color));
      text.contrast = std::min(text.contrast, contrast_of(ink, ground));
    }
  }

  Letters letters_;
  std::vector<Drawn> drawn_;
};

}  // namespace

std::vector<ShownText> read_screen(const ImDrawData& frame) {
  return Reader(frame).texts();
}

std::optional<ShownText> find_text(const std::vector<ShownText>& texts, const std::string& words) {
  for (auto text = texts.rbegin(); text != texts.rend(); ++text) {
    if (text->words == words) return *text;
  }
  return {};
}

}  // namespace lapwing::viewer::test
