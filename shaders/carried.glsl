// sRGB of what is carried along with an edited surface, meshes and points.
const vec3 kCarried = vec3(0.36, 0.68, 0.58);
