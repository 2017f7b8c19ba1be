#version 450

layout(location = 0) flat in uint triangle;
layout(location = 0) out uint written;  // 0 is the background

void main() { written = triangle + 1; }
