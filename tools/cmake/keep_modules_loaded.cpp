// Linked into programs under AddressSanitizer. A driver holds tables in its own globals until the
// process ends; once the Vulkan loader has unloaded it, the leak checker can no longer see those
// globals and takes the tables for leaks. So nothing is unloaded, and leaks keep their names.
extern "C" int dlclose(void* /*module*/) { return 0; }
