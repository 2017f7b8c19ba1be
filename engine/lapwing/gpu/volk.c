/* The one place that compiles volk, which opens the Vulkan loader at run time. */
#include <volk.c>
