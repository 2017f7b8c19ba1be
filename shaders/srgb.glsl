// Returns the linear light of a colour in sRGB (IEC 61966-2-1).
vec3 linear_of(vec3 encoded) {
  const vec3 c = clamp(encoded, 0.0, 1.0);
  return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

// The inverse, within a hundredth of an 8-bit step. Instead of a power, which takes a logarithm per
// channel, it uses the polynomial in the fourth root of least error for colours that are not dark.
vec3 encoded_of(vec3 light) {
  const vec3 c = clamp(light, 0.0, 1.0);
  const vec3 q = sqrt(sqrt(c));
  const vec3 curve =
      (((0.0813334 * q - 0.3355121) * q + 1.1226928) * q + 0.1961310) * q - 0.0646108;
  return mix(curve, c * 12.92, lessThanEqual(c, vec3(0.0031308)));
}
