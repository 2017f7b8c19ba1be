// Colour of attachments, the meshes and points that follow an edited surface, in sRGB.
const vec3 kCarried = vec3(0.36, 0.68, 0.58);
