#version 450
#extension GL_GOOGLE_include_directive : require

// Matte clay under a key, a fill and a rim light that move with the camera, or a matcap.

#include "file_color.glsl"
#include "surface.glsl"
#include "target.glsl"

layout(std430, binding = 6) readonly buffer ColorMaps { vec4 color_maps[]; };

layout(location = 0) in vec3 view_position;
layout(location = 0, component = 3) in float scalar;
layout(location = 1) in vec3 view_normal;
layout(location = 1, component = 3) in float held;
layout(location = 2) in vec3 barycentric;
layout(location = 3) in vec4 class_weights;
layout(location = 4) flat in uint shown_edges;
layout(location = 4, component = 1) flat in uint file_source;
layout(location = 5) in vec3 file_value;

layout(location = 0) out vec4 written;

// In sRGB.
const vec3 kClay = vec3(0.77, 0.73, 0.68);
const vec3 kClassColors[4] =
    vec3[](vec3(0.76, 0.76, 0.76), vec3(0.64, 0.75, 0.88), vec3(0.80, 0.20, 0.17),
           vec3(0.97, 0.77, 0.16));
const vec3 kNoNumber = vec3(0.55, 0.55, 0.55);
const vec3 kBackTint = vec3(0.62, 0.55, 0.60);  // factor of the colour on back faces
const vec3 kLine = vec3(0.10, 0.11, 0.13);
const float kTint = 0.65;      // fraction of a class's colour when mixed with the file's colours
const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
// Factor of the file's colours, so that white facing the key light is rendered as white.
const float kExposure = 0.85;
// Opacity of an X-ray surface that faces the eye, and of its edges. Silhouettes are denser.
const float kXrayFacing = 0.15;
const float kXrayEdge = 0.7;

const int kColorMapEntries = 256;  // per colour map; must equal the constant in render/renderer.cpp

// Returns the colour from the file, or the colour of clay if the file has none.
vec3 file_color() {
  // Computed outside all branches, because derivatives need the values of neighbouring pixels.
  const vec2 across = dFdx(file_value.xy);
  const vec2 down = dFdy(file_value.xy);
  const uint kind = file_source >> 24;
  if (kind == kSourceImage) {
    return kExposure * image_color(file_source & 0xFFFFFFu, file_value.xy, across, down);
  }
  return kind == kSourceColor ? kExposure * file_value : linear_of(kClay);
}

// Each pixel has the colour of the class with the largest weight. Borders are one pixel wide. The
// first class has the colours of the file, if there are any. The other classes are mixed only with
// the luminance of these colours, so that a red belt is visible on red skin.
vec3 class_color() {
  const vec3 base = has(kFileColor) ? file_color() : linear_of(kClassColors[0]);
  const float tint = has(kFileColor) ? kTint : 1.0;
  const vec3 under = vec3(dot(base, kLuminance));
  vec3 sum = vec3(0);
  float total = 0;
  for (int c = 0; c < 4; ++c) {
    vec4 others = class_weights;
    others[c] = 0;
    const float lead =
        class_weights[c] - max(max(others.x, others.y), max(others.z, others.w));
    const float covered = clamp(lead / max(fwidth(lead), 1e-6) + 0.5, 0.0, 1.0);
    sum += covered * (c == 0 ? base : mix(under, linear_of(kClassColors[c]), tint));
    total += covered;
  }
  return mix(sum / max(total, 1e-6), mix(under, linear_of(kClassColors[3]), tint), held);
}

vec3 map_color() {
  if (isnan(scalar) || isinf(scalar)) return linear_of(kNoNumber);
  const float at = clamp(scalar, 0.0, 1.0) * float(kColorMapEntries - 1);
  const int first = min(int(at), kColorMapEntries - 2);
  const int map = has(kDiverging) ? kColorMapEntries : 0;
  return mix(color_maps[map + first].rgb, color_maps[map + first + 1].rgb, at - float(first));
}

vec3 surface_color() {
  const vec3 tint = gl_FrontFacing ? vec3(1) : linear_of(kBackTint);
  if (has(kRegions)) return class_color() * tint;
  if (has(kScalar)) return map_color() * tint;
  if (has(kCarriedColor)) return linear_of(kCarried) * tint;
  if (has(kFileColor)) return file_color() * tint;
  return linear_of(kClay) * tint;
}

// Returns the curvature of the surface over a few points, in [-1, 1]; positive values are convex.
// It is used to darken hollows and lighten ridges, which makes details more visible.
float bend(vec3 normal) {
  const float pixels = 6.0 * pixels_per_point;
  const vec3 px = dFdx(view_position);
  const vec3 py = dFdy(view_position);
  const float along_x = dot(dFdx(normal), px) / max(length(px), 1e-20);
  const float along_y = dot(dFdy(normal), py) / max(length(py), 1e-20);
  const float angle = pixels * (along_x + along_y);
  return angle / (0.6 + abs(angle));
}

// Powers by multiplication, which is faster than pow().
float square(float x) { return x * x; }
float fourth(float x) { return square(square(x)); }

// These functions return the light of each matcap. `albedo` is the colour of the surface.
vec3 clay_matcap(vec3 albedo, vec3 normal, vec3 eye) {
  // Light that also reaches behind the horizon of the surface makes shadows soft and warm.
  const float light = dot(normal, normalize(vec3(-0.45, 0.70, 0.55))) * 0.5 + 0.5;
  const vec3 tone = mix(vec3(0.09, 0.03, 0.02), vec3(1.30, 0.95, 0.74), square(light) * light);
  const float rim = fourth(1.0 - max(dot(normal, eye), 0.0));
  return albedo * (tone + 0.30 * rim * vec3(0.9, 0.6, 0.5));
}

vec3 metal_matcap(vec3 albedo, vec3 normal, vec3 eye) {
  // The metal reflects a bright sky, a dark horizon, a lit floor and two long lamps.
  const vec3 mirrored = reflect(-eye, normal);
  const float sky = smoothstep(-0.05, 0.9, mirrored.y);
  const float ground = smoothstep(0.0, 0.8, -mirrored.y);
  const float before = smoothstep(-0.5, 0.1, mirrored.z);
  const float lamp = before * (1.0 - smoothstep(0.0, 0.12, abs(mirrored.x + 0.55)));
  const float strip = before * (1.0 - smoothstep(0.0, 0.07, abs(mirrored.x - 0.70)));
  const float light = 0.06 + 0.80 * sky + 0.30 * ground + 0.75 * lamp + 0.45 * strip;
  const float edge = fourth(1.0 - max(dot(normal, eye), 0.0));
  return mix(albedo, vec3(1), 0.15 + 0.5 * edge) * light;
}

vec3 pearl_matcap(vec3 albedo, vec3 normal, vec3 eye) {
  const vec3 key = normalize(vec3(-0.45, 0.65, 0.62));
  const float light = dot(normal, key) * 0.5 + 0.5;
  const float facing = max(dot(normal, eye), 0.0);
  // Thin layers reflect a different colour at each angle.
  const vec3 phase = 6.2831853 * (1.3 * facing + vec3(0.0, 0.33, 0.67));
  const vec3 sheen = 0.5 + 0.5 * cos(phase);
  const float half_way = max(dot(normal, normalize(key + eye)), 0.0);
  const float gloss = fourth(fourth(fourth(half_way)));  // to the power of 64
  const float rim = square(1.0 - facing);
  return mix(albedo, vec3(0.9), 0.35) * (0.14 + 0.68 * square(light)) + 0.12 * sheen * (0.3 + rim) +
         0.55 * gloss;
}

vec3 shade(vec3 albedo, vec3 normal, vec3 eye) {
  const float relief = 1.0 + 0.30 * bend(normal);
  if (has(kClayMatcap)) return relief * clay_matcap(albedo, normal, eye);
  if (has(kMetalMatcap)) return relief * metal_matcap(albedo, normal, eye);
  if (has(kPearlMatcap)) return relief * pearl_matcap(albedo, normal, eye);
  const vec3 key = normalize(vec3(-0.50, 0.62, 0.60));
  const vec3 fill = normalize(vec3(0.85, 0.05, 0.45));
  const float key_light = max(dot(normal, key), 0.0);
  const float fill_light = max(dot(normal, fill), 0.0);
  const float height = normal.y * 0.5 + 0.5;
  const vec3 ambient = mix(vec3(0.10, 0.085, 0.08), vec3(0.22, 0.24, 0.28), height);
  const vec3 light = 1.0 * key_light * vec3(1.0, 0.965, 0.91) +
                     0.22 * fill_light * vec3(0.75, 0.87, 1.0) + ambient;
  const float facing = max(dot(normal, normalize(key + eye)), 0.0);
  const float gloss = fourth(square(facing * fourth(facing)));  // facing to the power of 40
  const float rim = fourth(1.0 - max(dot(normal, eye), 0.0)) * height;
  return albedo * light * relief + 0.05 * gloss + 0.20 * rim * vec3(0.85, 0.93, 1.0);
}

// Returns the fraction of the pixel that the shown edges cover. If triangles are only a few points
// high, lines fade; otherwise a dense mesh would be black.
float line_coverage() {
  const vec3 gradient = sqrt(dFdx(barycentric) * dFdx(barycentric) +
                             dFdy(barycentric) * dFdy(barycentric));
  // Height of the triangle above each edge, in pixels.
  const vec3 height = 1.0 / max(gradient, vec3(1e-6));
  const vec3 pixels = barycentric * height;
  const float width = pixels_per_point;  // one point
  const vec3 covered = clamp(0.5 * width + 0.5 - pixels, 0.0, 1.0) *
                       clamp(height / (6.0 * width), 0.25, 1.0);
  // Edge e joins corners e and e + 1: the weight of the third corner is 0 on it.
  float most = 0;
  for (int e = 0; e < 3; ++e) {
    if ((shown_edges & (1u << e)) != 0) most = max(most, covered[(e + 2) % 3]);
  }
  return most;
}

void main() {
  const vec3 eye = has(kOrthographic) ? vec3(0, 0, 1) : normalize(-view_position);
  const vec3 normal = normalize(gl_FrontFacing ? view_normal : -view_normal);
  vec3 color = shade(surface_color(), normal, eye);
  const float line = has(kWireframe) ? line_coverage() : 0.0;
  color = mix(color, linear_of(kLine), 0.75 * line);
  float opacity = 1;
  if (has(kXray)) {
    const float face = kXrayFacing + 0.45 * square(1.0 - abs(dot(normal, eye)));
    opacity = mix(face, kXrayEdge, line);
  }
  written = vec4(of_linear(color), opacity);
}
