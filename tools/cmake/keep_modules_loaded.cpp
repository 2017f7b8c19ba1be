// Programs under AddressSanitizer link this file, so that the Vulkan loader cannot unload a driver.
// A driver's globals own tables until the process ends. After unloading, the leak checker would
// report these tables as leaks.
extern "C" int dlclose(void* /*module*/) { return 0; }
