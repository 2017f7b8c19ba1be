// Linear light of a colour encoded in sRGB (IEC 61966-2-1).
vec3 linear_of(vec3 encoded) {
  const vec3 c = clamp(encoded, 0.0, 1.0);
  return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}
