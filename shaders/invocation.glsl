// The host sets the size of work groups. If their number exceeds the device's limit for one
// dimension, they form several rows.

layout(local_size_x_id = 0) in;

uint invocation() {
  const uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  return group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}
