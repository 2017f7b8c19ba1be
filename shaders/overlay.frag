#version 450
#extension GL_GOOGLE_include_directive : require

#include "target.glsl"

layout(location = 0) flat in vec4 color;
layout(location = 0) out vec4 written;

void main() { written = vec4(of_linear(color.rgb), color.a); }
