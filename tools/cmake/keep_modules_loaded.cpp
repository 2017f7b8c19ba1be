// Replaces dlclose in programs with AddressSanitizer, so that the Vulkan loader cannot unload a
// driver. The global variables of a driver own memory until the process ends. If the driver were
// unloaded, the leak checker would report this memory as leaked.
extern "C" int dlclose(void* /*module*/) { return 0; }
