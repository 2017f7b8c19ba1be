#version 450

layout(local_size_x_id = 0) in;

layout(std430, binding = 0) buffer Values { uint values[]; };

void main() { values[gl_GlobalInvocationID.x] += 1; }
