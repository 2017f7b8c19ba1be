#version 450
#extension GL_GOOGLE_include_directive : require

// A vertical gradient between two sRGB colours, dithered against banding.

#include "target.glsl"

layout(push_constant) uniform Push {
  vec4 top;
  vec4 bottom;
};

layout(location = 0) in float height;
layout(location = 0) out vec4 color;

// Interleaved gradient noise (J. Jimenez, 2014), in [-0.5, 0.5).
float noise(vec2 pixel) {
  return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5;
}

void main() {
  const vec4 encoded = mix(top, bottom, height);
  const float step_of_8_bits = top == bottom ? 0.0 : 1.0 / 255.0;
  color = vec4(of_encoded(encoded.rgb + step_of_8_bits * noise(gl_FragCoord.xy)), encoded.a);
}
