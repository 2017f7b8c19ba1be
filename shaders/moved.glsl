// New displacements (binding 1), in the format of place.glsl. Include this file after place.glsl.

layout(std430, binding = 1) writeonly buffer Moved { real moved[]; };

#ifdef LAPWING_FLOAT64
void set_moved(uint v, dvec3 value) {
  moved[3 * v] = value.x;
  moved[3 * v + 1] = value.y;
  moved[3 * v + 2] = value.z;
}
#else
void set_moved(uint v, vec3 value) {
  moved[6 * v] = value.x;
  moved[6 * v + 1] = value.y;
  moved[6 * v + 2] = value.z;
  moved[6 * v + 3] = 0;
  moved[6 * v + 4] = 0;
  moved[6 * v + 5] = 0;
}
#endif
