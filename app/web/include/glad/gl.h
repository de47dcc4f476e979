// GL as WebGL 2 has it, by the name under which the program includes it.
#pragma once

#include <GLES3/gl3.h>

using GLADapiproc = void (*)();
using GLADloadfunc = GLADapiproc (*)(const char* name);
