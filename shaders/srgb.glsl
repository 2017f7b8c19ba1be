// Converts a colour from sRGB (IEC 61966-2-1) to linear light.
vec3 linear_of(vec3 encoded) {
  const vec3 c = clamp(encoded, 0.0, 1.0);
  return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

// Converts a colour from linear light to sRGB, with an error below a hundredth of an 8-bit step. A
// power would need a logarithm per channel. Except for dark colours, uses the best polynomial
// approximation in the fourth root instead.
vec3 encoded_of(vec3 light) {
  const vec3 c = clamp(light, 0.0, 1.0);
  const vec3 q = sqrt(sqrt(c));
  const vec3 curve =
      (((0.0813334 * q - 0.3355121) * q + 1.1226928) * q + 0.1961310) * q - 0.0646108;
  return mix(curve, c * 12.92, lessThanEqual(c, vec3(0.0031308)));
}
