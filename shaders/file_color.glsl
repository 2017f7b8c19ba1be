// Samples the texture images of a mesh's file and their mip levels (render/mip_levels.h). Filtering
// is trilinear in linear light, and images repeat.

layout(std430, binding = 9) readonly buffer Images { uint image_words[]; };

const uint kLinearWords = 256;
const uint kWordsPerImage = 4;

vec3 image_texel(uint place) {
  const uint word = image_words[place];
  return vec3(uintBitsToFloat(image_words[word & 255u]),
              uintBitsToFloat(image_words[(word >> 8) & 255u]),
              uintBitsToFloat(image_words[(word >> 16) & 255u]));
}

// Returns the colour at `place`, in [0, 1], of a mip level with `size` pixels that begins at word
// `first`.
vec3 level_color(uint first, ivec2 size, vec2 place) {
  // In pixels, relative to the centre of the first pixel.
  const vec2 middle = place * vec2(size) - 0.5;
  const vec2 cell = floor(middle);
  const vec2 share = middle - cell;
  ivec2 low = clamp(ivec2(cell), ivec2(-1), size - 1);
  if (low.x < 0) low.x += size.x;
  if (low.y < 0) low.y += size.y;
  ivec2 high = low + 1;
  if (high.x == size.x) high.x = 0;
  if (high.y == size.y) high.y = 0;
  const uint upper = first + uint(low.y * size.x);
  const uint lower = first + uint(high.y * size.x);
  return mix(mix(image_texel(upper + uint(low.x)), image_texel(upper + uint(high.x)), share.x),
             mix(image_texel(lower + uint(low.x)), image_texel(lower + uint(high.x)), share.x),
             share.y);
}

// Returns the colour of image number `image` at `place`, in linear light. `across` and `down` are
// the derivatives of `place` from one pixel to the next.
vec3 image_color(uint image, vec2 place, vec2 across, vec2 down) {
  const uint record = kLinearWords + kWordsPerImage * image;
  const ivec2 size = ivec2(image_words[record], image_words[record + 1]);
  const uint levels = image_words[record + 2];
  const uint places = image_words[record + 3];
  const vec2 texels_across = across * vec2(size);
  const vec2 texels_down = down * vec2(size);
  const float texels = max(dot(texels_across, texels_across), dot(texels_down, texels_down));
  // If `texels` is NaN, as outside a triangle, the level is 0.
  const float level = texels > 1.0 ? min(0.5 * log2(texels), float(levels - 1)) : 0.0;
  const uint fine = uint(level);
  const float share = level - float(fine);
  const vec2 inside = fract(place);
  const vec3 color =
      level_color(image_words[places + fine], max(size >> fine, ivec2(1)), inside);
  if (share == 0.0) return color;
  const uint coarse = fine + 1;
  const vec3 blurred =
      level_color(image_words[places + coarse], max(size >> coarse, ivec2(1)), inside);
  return mix(color, blurred, share);
}
