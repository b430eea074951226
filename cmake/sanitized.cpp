// Part of every program that is built with sanitizers: what their leak check has to know of graphics drivers.

extern "C" {

// OSMesa keeps its compiler's tables to the end of the program, drivers keep theirs.
const char* __lsan_default_suppressions() { return "leak:libOSMesa.so\nleak:_dri.so\nleak:libGLX\n"; }

const char* __lsan_default_options() { return "print_suppressions=0"; }

// A library that is gone by the time of the check has no name to be recognised by: none goes.
int dlclose(void*) { return 0; }
}
