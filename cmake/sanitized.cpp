// Linked into every program that is built with sanitizers: leak checker settings for graphics drivers.

extern "C" {

// OSMesa and drivers never free the tables of their shader compilers.
const char* __lsan_default_suppressions() { return "leak:libOSMesa.so\nleak:_dri.so\nleak:libGLX\n"; }

const char* __lsan_default_options() { return "print_suppressions=0"; }

// A library that is unloaded before the check cannot be matched by name, so none is unloaded.
int dlclose(void*) { return 0; }
}
